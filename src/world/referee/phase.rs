//! The phases of a match.

use std::fmt;

/// The phases of a match in their order, named as in the league's game controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Phase {
    /// A kick-off is owed. It never outlasts the call that owes it, so it is seen only before the first one.
    Initial,
    /// The robots have been put on their kick-off positions, or walk there.
    Ready,
    /// All stand still.
    Set,
    /// The ball is in play and the clock runs.
    Playing,
    /// Over for good.
    Finished,
}

impl fmt::Display for Phase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Phase::Initial => "initial",
            Phase::Ready => "ready",
            Phase::Set => "set",
            Phase::Playing => "playing",
            Phase::Finished => "finished",
        })
    }
}
