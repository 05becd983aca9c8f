//! Contacts between robots: how often and for how long they touched.

use serde::Serialize;

use crate::ids::{RobotId, Team};

/// How often and for how long robots have touched each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ContactTotal {
    /// Touches that are apart by [`APART`] at least.
    pub number: u32,
    /// The sum of the times of all pairs, s.
    pub seconds: f64,
}

/// Two touches of a pair with less time between them are one, s: bodies that push each other part for moments.
pub const APART: f64 = 0.25;

/// The contacts of all pairs of robots in play.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RobotContacts {
    /// The pairs that have ever touched, in order.
    pairs: Vec<PairContacts>,
    /// The pairs that touch, in order.
    now: Vec<[RobotId; 2]>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct PairContacts {
    pair: [RobotId; 2],
    total: ContactTotal,
    /// Until when they touched last, s of play.
    until: f64,
}

impl RobotContacts {
    /// These pairs touch, each in order and once, for `dt` seconds from `now` on, in seconds of play.
    pub(crate) fn update(&mut self, touching: &[[RobotId; 2]], now: f64, dt: f64) {
        self.now.clear();
        self.now.extend_from_slice(touching);
        for pair in touching {
            let place = self.pairs.binary_search_by_key(pair, |known| known.pair);
            let place = place.unwrap_or_else(|place| {
                let fresh =
                    PairContacts { pair: *pair, total: ContactTotal::default(), until: f64::NEG_INFINITY };
                self.pairs.insert(place, fresh);
                place
            });
            let known = &mut self.pairs[place];
            known.total.number += u32::from(now - known.until > APART);
            known.total.seconds += dt;
            known.until = now + dt;
        }
    }

    /// Play is interrupted: what comes after is another contact.
    pub(super) fn interrupt(&mut self) {
        self.now.clear();
        self.pairs.iter_mut().for_each(|pair| pair.until = f64::NEG_INFINITY);
    }

    /// Whether two robots touch.
    pub fn touch(&self, a: RobotId, b: RobotId) -> bool {
        self.now.binary_search(&[a.min(b), a.max(b)]).is_ok()
    }

    /// Between robots of one team.
    pub fn of_mates(&self, team: Team) -> ContactTotal {
        self.total(|[a, b]| a.team == team && b.team == team)
    }

    /// Between robots of different teams.
    pub fn of_opponents(&self) -> ContactTotal {
        self.total(|[a, b]| a.team != b.team)
    }

    fn total(&self, counts: impl Fn([RobotId; 2]) -> bool) -> ContactTotal {
        let counted = self.pairs.iter().filter(|known| counts(known.pair));
        counted.fold(ContactTotal::default(), |sum, known| ContactTotal {
            number: sum.number + known.total.number,
            seconds: sum.seconds + known.total.seconds,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::play_tick::stage::*;
    use super::*;

    /// Contacts after these pairs touched, each for so many tenths of a second one after the other.
    fn after(times: &[(&[[RobotId; 2]], usize)]) -> RobotContacts {
        let (mut contacts, mut now) = (RobotContacts::default(), 0.0);
        for (touching, tenths) in times {
            run(&mut now, *tenths, &tick(&[]), |tick| contacts.update(touching, tick.now, tick.dt));
        }
        contacts
    }

    #[track_caller]
    fn assert_total(total: ContactTotal, number: u32, seconds: f64) {
        assert!(total.number == number && (total.seconds - seconds).abs() < 1e-9, "{total:?}");
    }

    #[test]
    fn a_contact_goes_on_over_a_moment_apart_and_ends_with_a_longer_one() {
        let mates: &[[RobotId; 2]] = &[[HOME_1, HOME_2]];
        let contacts = after(&[(mates, 5), (&[], 2), (mates, 1), (&[], 3), (mates, 4)]);
        assert_total(contacts.of_mates(Team::Home), 2, 1.0);
        assert_total(contacts.of_mates(Team::Away), 0, 0.0);
        assert_total(contacts.of_opponents(), 0, 0.0);
    }

    #[test]
    fn mates_and_opponents_are_told_apart_and_pairs_are_added_up() {
        let all: &[[RobotId; 2]] = &[[HOME_1, HOME_2], [HOME_1, AWAY_1], [HOME_2, AWAY_1]];
        let contacts = after(&[(all, 3)]);
        assert_total(contacts.of_mates(Team::Home), 1, 0.3);
        assert_total(contacts.of_opponents(), 2, 0.6);
        assert!(contacts.touch(AWAY_1, HOME_2) && contacts.touch(HOME_1, HOME_2));
        assert!(!after(&[(all, 3), (&[], 1)]).touch(HOME_1, HOME_2));
    }

    #[test]
    fn an_interruption_ends_a_contact() {
        let mut contacts = after(&[(&[[HOME_1, HOME_2]], 2)]);
        contacts.interrupt();
        assert!(!contacts.touch(HOME_1, HOME_2));
        contacts.update(&[[HOME_1, HOME_2]], 0.2, 0.1);
        assert_total(contacts.of_mates(Team::Home), 2, 0.3);
    }
}
