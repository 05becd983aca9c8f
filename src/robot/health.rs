//! What is wrong with a robot: crashed, frozen, deaf or mute.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

/// A robot's health: what works of it; all is well by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Reflect)]
pub struct Health {
    /// Its computer is off: it stands still, hears nothing, says nothing and decides nothing.
    pub crashed: bool,
    /// Its wheels are off, while its computer and its radio go on.
    pub frozen: bool,
    /// It hears nothing.
    pub deaf: bool,
    /// Nothing that it says goes on air.
    pub mute: bool,
}

impl Health {
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
        *self == Health::default()
    }

    /// This health with one more failure.
    pub fn with(mut self, failure: RobotFailure) -> Health {
        match failure {
            RobotFailure::Crashed => self.crashed = true,
            RobotFailure::Frozen => self.frozen = true,
            RobotFailure::Deaf => self.deaf = true,
            RobotFailure::Mute => self.mute = true,
        }
        self
    }
}

/// How a robot can fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum RobotFailure {
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
pub enum Restart {
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
        let crashed = Health::default().with(RobotFailure::Crashed);
        assert!(!crashed.hears() && !crashed.drives() && !crashed.is_well());
        let frozen = Health::default().with(RobotFailure::Frozen);
        assert!(frozen.hears() && !frozen.drives());
        assert!(!Health::default().with(RobotFailure::Deaf).hears());
        assert!(Health::default().with(RobotFailure::Mute).hears());
    }
}
