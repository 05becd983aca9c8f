//! Invariants that were broken: how often, for how long, and what led there.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

use bevy::prelude::*;
use serde::Serialize;
use smallvec::SmallVec;

use super::invariant::{EVERY, Invariant};
use crate::clock::Clock;
use crate::comms::radio::{RadioRecord, Transmission, TransmissionState};
use crate::ids::{RobotId, Team};
use crate::strategy::Strategies;

/// The robots that something is about, in order.
pub(super) type Robots = SmallVec<[RobotId; 8]>;

/// Something that must not be, in one tick.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Failing {
    pub invariant: Invariant,
    /// Nothing, if it is of no team.
    pub team: Option<Team>,
    pub robots: Robots,
}

/// What a match has broken, and what fails to hold now.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct Invariants {
    /// What was broken, each with how often and for how long.
    pub broken: BTreeMap<(Invariant, Option<Team>), BreachCount>,
    /// The first few breaches of each.
    pub breaches: Vec<Breach>,
    failing: Vec<FailingSince>,
    /// The robots that are off, with the packets that had reached them when they were seen to be.
    pub(super) off: SmallVec<[(RobotId, u64); 4]>,
}

#[derive(Clone, Debug, PartialEq)]
struct FailingSince {
    invariant: Invariant,
    team: Option<Team>,
    /// The first tick.
    since: u64,
    /// Those that it has been about since.
    robots: Robots,
    broken: bool,
}

/// How often and for how long an invariant was broken: the time beyond its bound.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct BreachCount {
    /// How often.
    pub times: u32,
    /// In all, s.
    pub seconds: f64,
}

/// The moment in which an invariant counted as broken.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Breach {
    /// Which.
    pub invariant: Invariant,
    /// Whose, if it is of a team.
    pub team: Option<Team>,
    /// When it counted as broken.
    pub tick: u64,
    /// The first tick in which it did not hold.
    pub since: u64,
    /// The robots that it is about.
    pub robots: Vec<RobotId>,
    /// The last steps of a protocol between them and their team mates before, oldest first.
    pub messages: Vec<String>,
}

/// So many breaches of each invariant are kept whole.
const KEPT: usize = 3;
/// So many messages are told of each.
const MESSAGES: usize = 8;

impl Invariants {
    /// Whether something was broken that holds whatever the radio does.
    pub fn is_unsafe(&self) -> bool {
        self.broken.keys().any(|(invariant, _)| invariant.is_safety())
    }

    /// Since when an invariant fails to hold, of a team or of anybody, if it has for longer than its bound.
    pub fn broken_now(&self, invariant: Invariant, team: Option<Team>) -> Option<u64> {
        let is_meant = |known: &&FailingSince| {
            known.broken && known.invariant == invariant && (team.is_none() || known.team == team)
        };
        self.failing.iter().filter(is_meant).map(|known| known.since).min()
    }

    /// What fails to hold in the tick that is just over.
    pub(super) fn note(
        &mut self,
        failing: Vec<Failing>,
        clock: &Clock,
        strategies: &Strategies,
        radio: &RadioRecord,
    ) {
        let is_of =
            |known: &FailingSince, it: &Failing| (known.invariant, known.team) == (it.invariant, it.team);
        self.failing.retain_mut(|known| {
            let Some(it) = failing.iter().find(|it| is_of(known, it)) else { return false };
            known.robots.retain(|robot| it.robots.contains(robot));
            known.robots.len() >= known.invariant.same_robots()
        });
        for it in failing {
            let place = self.failing.iter().position(|known| is_of(known, &it)).unwrap_or_else(|| {
                let Failing { invariant, team, robots } = it.clone();
                self.failing.push(FailingSince { invariant, team, since: clock.tick, robots, broken: false });
                self.failing.len() - 1
            });
            let known = &mut self.failing[place];
            let bound = it.invariant.bound(&strategies.of(it.team.unwrap_or(Team::Home)).teamwork);
            if clock.tick - known.since < clock.ticks(bound) {
                continue;
            }
            let count = self.broken.entry((it.invariant, it.team)).or_default();
            count.seconds += f64::from(EVERY);
            if !std::mem::replace(&mut known.broken, true) {
                count.times += 1;
                if count.times as usize <= KEPT {
                    let since = known.since;
                    self.breaches.push(Breach::new(it, since, clock.tick, radio));
                }
            }
        }
    }
}

impl Breach {
    fn new(it: Failing, since: u64, tick: u64, radio: &RadioRecord) -> Breach {
        let concerns = |sent: &&Transmission| {
            [sent.packet.from, sent.packet.to].iter().any(|robot| it.robots.contains(robot))
        };
        let sent = radio.transmissions().rev().filter(concerns);
        let mut messages: Vec<String> = sent.filter_map(step_in_words).take(MESSAGES).collect();
        messages.reverse();
        Breach { invariant: it.invariant, team: it.team, tick, since, robots: it.robots.into_vec(), messages }
    }
}

/// "tick 120: LOCK 5 from home 1 to home 2, lost: by chance"; nothing for other messages than those of a protocol.
fn step_in_words(sent: &Transmission) -> Option<String> {
    let Transmission { packet, sent: tick, state, .. } = sent;
    if !packet.message()?.is_step() {
        return None;
    }
    let what = sent.label();
    let fate = match state {
        TransmissionState::InFlight(due) => format!("to arrive at tick {due}"),
        TransmissionState::Arrived(at) => format!("arrived at tick {at}"),
        TransmissionState::Lost(reason) => format!("lost: {reason}"),
    };
    Some(format!("tick {tick}: {what} from {} to {}, {fate}", packet.from, packet.to))
}

impl Display for Breach {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "tick {}: {}", self.tick, self.invariant)?;
        if let Some(team) = self.team {
            write!(f, " ({team})")?;
        }
        for (place, robot) in self.robots.iter().enumerate() {
            write!(f, "{}{robot}", if place == 0 { ", " } else { " and " })?;
        }
        if self.since < self.tick {
            write!(f, ", since tick {}", self.since)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROBOT: RobotId = RobotId::new(Team::Away, 2);

    /// What is known after looks ten times a second at a time in which something failed or not.
    fn after(invariant: Invariant, looks: &[bool]) -> Invariants {
        let looks: Vec<&[RobotId]> =
            looks.iter().map(|fails| if *fails { [ROBOT].as_slice() } else { &[] }).collect();
        after_robots(invariant, &looks)
    }

    /// The same, with the robots that it is about in each look.
    fn after_robots(invariant: Invariant, looks: &[&[RobotId]]) -> Invariants {
        let strategy = std::sync::Arc::new(crate::testing::idle());
        let strategies = Strategies([strategy.clone(), strategy]);
        let (mut invariants, mut clock) = (Invariants::default(), Clock::new(60.0));
        for robots in looks {
            let failing = Failing { invariant, team: Some(Team::Away), robots: (*robots).into() };
            let failing = if robots.is_empty() { Vec::new() } else { vec![failing] };
            invariants.note(failing, &clock, &strategies, &RadioRecord::default());
            clock.tick += clock.ticks(EVERY);
        }
        invariants
    }

    #[test]
    fn what_fails_for_longer_than_its_bound_is_broken_once_and_its_time_beyond_counts() {
        let bound = [true; 100];
        assert!(after(Invariant::SomebodyGoes, &bound).broken.is_empty());
        let broken = after(Invariant::SomebodyGoes, &[true; 103]);
        let count = broken.broken[&(Invariant::SomebodyGoes, Some(Team::Away))];
        assert_eq!((count.times, (count.seconds * 10.0).round()), (1, 3.0));
        let [breach] = broken.breaches.as_slice() else { panic!("{:?}", broken.breaches) };
        assert_eq!((breach.since, breach.tick, breach.robots.as_slice()), (0, 600, [ROBOT].as_slice()));
        assert_eq!(
            breach.to_string(),
            "tick 600: nobody drives at a ball that is seen (away), away 2, since tick 0"
        );
    }

    #[test]
    fn a_break_begins_the_bound_anew_and_the_first_few_breaches_are_kept() {
        let often: Vec<bool> = (0..5).flat_map(|_| [true; 101].into_iter().chain([false])).collect();
        let broken = after(Invariant::SomebodyGoes, &often);
        assert_eq!(broken.broken[&(Invariant::SomebodyGoes, Some(Team::Away))].times, 5);
        assert_eq!(broken.breaches.len(), KEPT);
        let never: Vec<bool> = (0..5).flat_map(|_| [true; 99].into_iter().chain([false])).collect();
        assert!(after(Invariant::SomebodyGoes, &never).broken.is_empty());
    }

    #[test]
    fn two_that_defend_one_after_the_other_beside_a_third_do_not_defend_for_long() {
        let [one, two, three] = [1, 2, 3].map(|number| RobotId::new(Team::Away, number));
        let [first, second, all]: [&[RobotId]; 3] = [&[one, two], &[one, three], &[one, two, three]];
        let broken = |parts: [&[RobotId]; 3]| {
            let looks: Vec<&[RobotId]> = parts.iter().flat_map(|robots| [*robots; 60]).collect();
            !after_robots(Invariant::OneDefender, &looks).broken.is_empty()
        };
        assert!(!broken([first, second, first]));
        assert!(broken([first, all, first]), "the third comes and goes");
    }

    #[test]
    fn safety_is_what_no_radio_may_break() {
        assert!(after(Invariant::LockIsGivenBack, &[true; 11]).is_unsafe());
        assert!(!after(Invariant::LockIsGivenBack, &[true; 10]).is_unsafe());
        assert!(!after(Invariant::SomebodyGoes, &[true; 200]).is_unsafe());
    }
}
