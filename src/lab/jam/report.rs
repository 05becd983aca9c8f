//! What the search for the worst radio has found, in words.

use std::fmt::{self, Display, Formatter};

use serde::Serialize;

use super::harm::Harm;
use super::search::{Interfered, JamEnd, JamSearch};
use crate::comms::radio::Act;

/// What was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JamReport {
    /// The scenario.
    pub scenario: String,
    /// What counted as harm.
    pub harm: Harm,
    /// How many packets could be interfered with.
    pub budget: usize,
    /// How it ended.
    pub end: JamEnd,
    /// How many losses it bears, as far as all sets of so many were tried; none if harm comes without any.
    pub resilience: Option<usize>,
    /// Matches that were played.
    pub played: usize,
}

impl JamReport {
    pub(super) fn new(scenario: String, harm: Harm, budget: usize, searched: JamSearch) -> JamReport {
        let JamSearch { end, played, exhausted } = searched;
        JamReport { scenario, harm, budget, end, resilience: exhausted, played }
    }
}

impl Display for JamReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {} matches played", self.scenario, self.played)?;
        match &self.end {
            JamEnd::Harmed { packets, tick } if packets.is_empty() => {
                writeln!(f, "{} at tick {tick}, with no message lost", self.harm)?;
            }
            JamEnd::Harmed { packets, tick } => {
                writeln!(
                    f,
                    "{} at tick {tick}, by {} of {} packets:",
                    self.harm,
                    packets.len(),
                    self.budget
                )?;
                packets.iter().try_for_each(|packet| writeln!(f, "  {packet}"))?;
            }
            JamEnd::Stopped => writeln!(f, "no harm was found until it was interrupted")?,
            JamEnd::Unharmed => writeln!(f, "no harm was found with {} packets", self.budget)?,
        }
        match self.resilience {
            Some(resilience) => write!(f, "bears whatever was tried with any {resilience} packets"),
            None => write!(f, "bears nothing"),
        }
    }
}

impl Display for Interfered {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Interfered { kind, from, to, nth, act, sent } = self;
        write!(f, "tick {sent}: {kind} number {nth} from {from} to {to} ")?;
        match act {
            Act::Drop => f.write_str("is lost"),
            Act::Delay(seconds) => write!(f, "is {seconds} s late"),
            Act::Duplicate(seconds) => write!(f, "comes again after {seconds} s"),
        }
    }
}
