//! How long robots keep what they have, a role or a state of their machine, and how often they go back and forth.

use serde::Serialize;
use smallvec::SmallVec;

use crate::ids::PlayerNumber;

/// How long the robots of a team have kept their roles or their states. Times are seconds of play.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(bound = "")]
pub struct HoldFigures<T> {
    /// How often a robot has changed.
    pub changes: u64,
    /// The mean time until a robot changes, those that have not changed yet included, s: the time of all robots in play over the
    /// number of times that any began to hold something.
    pub mean: f64,
    /// The shortest time between two changes of a robot, s; 0 if there were none.
    pub shortest: f64,
    /// Changes from A to B and back to A within [`BACK_WITHIN`].
    pub oscillations: u64,
    #[serde(skip)]
    seconds: f64,
    #[serde(skip)]
    begun: u64,
    #[serde(skip)]
    /// By the number of the robot.
    holders: SmallVec<[Option<Holder<T>>; 8]>,
}

/// A robot that is back within this time after it left oscillates, s.
pub const BACK_WITHIN: f64 = 3.0;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Holder<T> {
    has: T,
    /// s of play
    since: f64,
    /// When it was seen in play last, s of play. A robot that was away begins anew.
    seen: f64,
    /// Whether it changed to what it has, so that the time since is that of a whole hold.
    changed: bool,
    /// What it had before, if play was not interrupted since.
    before: Option<T>,
}

impl<T> Default for HoldFigures<T> {
    fn default() -> HoldFigures<T> {
        HoldFigures {
            changes: 0,
            mean: 0.0,
            shortest: 0.0,
            oscillations: 0,
            seconds: 0.0,
            begun: 0,
            holders: SmallVec::new(),
        }
    }
}

impl<T: Copy + PartialEq> HoldFigures<T> {
    /// What the playing robots of the team have in this tick.
    pub(super) fn update(&mut self, robots: impl Iterator<Item = (PlayerNumber, T)>, now: f64, dt: f64) {
        for (number, has) in robots {
            let place = usize::from(number);
            if self.holders.len() <= place {
                self.holders.resize(place + 1, None);
            }
            self.seconds += dt;
            match self.holders[place].as_mut().filter(|holder| now - holder.seen < 1.5 * dt) {
                Some(holder) if holder.has == has => holder.seen = now,
                Some(holder) => {
                    let before = *holder;
                    self.holders[place] = Some(self.change(before, has, now));
                }
                None => {
                    self.begun += 1;
                    self.holders[place] =
                        Some(Holder { has, since: now, seen: now, changed: false, before: None });
                }
            }
        }
        self.mean = if self.begun > 0 { self.seconds / self.begun as f64 } else { 0.0 };
    }

    fn change(&mut self, holder: Holder<T>, has: T, now: f64) -> Holder<T> {
        let held = now - holder.since;
        if holder.changed {
            self.shortest = if self.shortest > 0.0 { self.shortest.min(held) } else { held };
        }
        let is_back = holder.before == Some(has) && held < BACK_WITHIN;
        self.oscillations += u64::from(is_back);
        self.changes += 1;
        self.begun += 1;
        Holder { has, since: now, seen: now, changed: true, before: Some(holder.has) }
    }

    /// Play is interrupted: a change after it is no way back.
    pub(super) fn interrupt(&mut self) {
        self.holders.iter_mut().flatten().for_each(|holder| holder.before = None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Figures after one robot had these, each for so many seconds.
    fn after(times: &[(char, u32)]) -> HoldFigures<char> {
        let (mut figures, mut now) = (HoldFigures::default(), 0.0);
        for (has, seconds) in times {
            for _ in 0..*seconds {
                figures.update([(1, *has)].into_iter(), now, 1.0);
                now += 1.0;
            }
        }
        figures
    }

    #[test]
    fn there_and_back_within_three_seconds_is_an_oscillation() {
        assert_eq!(after(&[('a', 9), ('b', 2), ('a', 1)]).oscillations, 1);
        assert_eq!(after(&[('a', 9), ('b', 2), ('a', 2), ('b', 1)]).oscillations, 2);
        assert_eq!(after(&[('a', 9), ('b', 3), ('a', 1)]).oscillations, 0, "too late");
        assert_eq!(after(&[('a', 9), ('b', 1), ('c', 1), ('a', 1)]).oscillations, 0, "on to a third");
    }

    #[test]
    fn holds_are_measured_between_changes() {
        let figures = after(&[('a', 9), ('b', 4), ('a', 7)]);
        assert_eq!((figures.changes, figures.shortest), (2, 4.0));
        assert!((figures.mean - 20.0 / 3.0).abs() < 1e-9, "{}", figures.mean);
    }

    #[test]
    fn who_never_changes_holds_for_as_long_as_it_plays() {
        let mut figures = HoldFigures::default();
        for second in 0..5 {
            figures.update([(1, 'a'), (2, 'b')].into_iter(), f64::from(second), 1.0);
        }
        assert_eq!((figures.changes, figures.mean, figures.shortest), (0, 5.0, 0.0));
    }

    #[test]
    fn a_break_is_no_way_back() {
        let mut figures = after(&[('a', 2), ('b', 1)]);
        figures.interrupt();
        figures.update([(1, 'a')].into_iter(), 3.0, 1.0);
        assert_eq!((figures.changes, figures.oscillations), (2, 0));
        let mut figures = after(&[('a', 2), ('b', 1)]);
        figures.update([].into_iter(), 3.0, 1.0);
        figures.update([(1, 'a')].into_iter(), 4.0, 1.0);
        assert_eq!((figures.changes, figures.oscillations), (1, 0), "it was off the pitch");
    }
}
