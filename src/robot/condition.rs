//! What is wrong with a robot: crashed, frozen, deaf or mute.

use serde::{Deserialize, Serialize};

/// A robot's condition; all is well by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Condition {
    /// Its computer is off: it stands still, hears nothing, says nothing and decides nothing.
    pub crashed: bool,
    /// Its wheels are off, while its computer and its radio go on.
    pub frozen: bool,
    /// It hears nothing.
    pub deaf: bool,
    /// Nothing that it says goes on air.
    pub mute: bool,
}

impl Condition {
    /// Whether it receives messages.
    pub fn hears(&self) -> bool {
        !self.crashed && !self.deaf
    }

    /// Whether its wheels or legs move.
    pub fn drives(&self) -> bool {
        !self.crashed && !self.frozen
    }

    /// Whether nothing is wrong with it.
    pub fn is_well(&self) -> bool {
        *self == Condition::default()
    }

    /// This condition with one more ailment.
    pub fn with(mut self, ailment: Ailment) -> Condition {
        match ailment {
            Ailment::Crashed => self.crashed = true,
            Ailment::Frozen => self.frozen = true,
            Ailment::Deaf => self.deaf = true,
            Ailment::Mute => self.mute = true,
        }
        self
    }
}

/// How a robot can fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Ailment {
    /// It neither moves nor thinks nor talks.
    Crashed,
    /// Its wheels or legs stand still.
    Frozen,
    /// It receives nothing.
    Deaf,
    /// Nothing that it sends leaves it.
    Mute,
}

/// What a robot still knows when it is switched on again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Recall {
    /// Its role and its counters; what it was in the middle of is gone.
    Kept,
    /// Nothing: it is as new.
    Lost,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crashed_robot_neither_hears_nor_drives_and_a_frozen_one_hears() {
        let crashed = Condition::default().with(Ailment::Crashed);
        assert!(!crashed.hears() && !crashed.drives() && !crashed.is_well());
        let frozen = Condition::default().with(Ailment::Frozen);
        assert!(frozen.hears() && !frozen.drives());
        assert!(!Condition::default().with(Ailment::Deaf).hears());
        assert!(Condition::default().with(Ailment::Mute).hears());
    }
}
