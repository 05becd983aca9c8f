//! A person at the controls of a robot: one more way to command its motors, within the same limits.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use crate::robot::KickIntent;

/// Put on a robot that a person drives; the keys are read by the window and written in the Script stage.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Reflect)]
#[reflect(Component)]
pub struct Pilot {
    /// Share of the top speed, -1 to 1.
    pub throttle: f32,
    /// Share of the fastest step to the side, -1 to 1, positive to the left; nothing that wheels can do.
    pub aside: f32,
    /// Share of the fastest turn, -1 to 1, positive to the left.
    pub turn: f32,
    /// Share of the farthest turn of the head, -1 to 1, positive to the left; without it the head looks for the ball itself.
    pub head: Option<f32>,
    /// What to do to the ball.
    pub kick: KickIntent,
}

impl Pilot {
    /// These controls within their stops; what is no number counts as let go.
    pub fn limited(self) -> Pilot {
        let stop = |lever: f32| if lever.is_finite() { lever.clamp(-1.0, 1.0) } else { 0.0 };
        Pilot {
            throttle: stop(self.throttle),
            aside: stop(self.aside),
            turn: stop(self.turn),
            head: self.head.map(stop),
            kick: self.kick,
        }
    }
}
