//! What a robot is doing to the ball: its chin holds it, its kicks send it away. Pure: time and dice are arguments.

mod chin;
mod kick;

use bevy::prelude::*;

pub use chin::{Catch, Grip, NearBall};
pub use kick::{Glance, Kicking, kicked_together, launch};

use crate::ids::RobotId;
use crate::rng::{Dice, Seed};

/// What a robot is doing to the ball.
#[derive(Component, Clone, Debug)]
pub struct Handling {
    /// What the chin does.
    pub grip: Grip,
    /// The kick that is under way.
    pub kicking: Option<Kicking>,
    /// The dice of catches and kicks.
    pub dice: Dice,
}

impl Handling {
    /// A robot that neither holds nor kicks.
    pub fn new(seed: Seed, robot: RobotId) -> Handling {
        Handling { grip: Grip::Open, kicking: None, dice: Dice::new(seed, "kick", Some(robot)) }
    }

    /// Whether the ball is under the chin.
    pub fn holds(&self) -> bool {
        self.grip.holds()
    }

    /// Whether it kicks or catches, so that its legs are not free to walk.
    pub fn is_busy(&self) -> bool {
        self.kicking.is_some() || matches!(self.grip, Grip::Lowering { .. } | Grip::Raising { .. })
    }

    /// Whether the head is down, with the camera on the carpet.
    pub fn hides_ball(&self) -> bool {
        self.holds() || matches!(self.grip, Grip::Lowering { .. })
    }

    /// The robot was put down somewhere.
    pub fn let_go(&mut self) {
        (self.grip, self.kicking) = (Grip::Open, None);
    }
}
