//! What a mind wants of its body. The Motor stage writes it, the Drive stage follows it within the robot's limits.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

/// Where a robot wants to go. Headings are in the odometry's frame, so that the drive can follow them between decisions.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Reflect)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum SteeringIntent {
    /// Stand still.
    #[default]
    Stop,
    /// A heading in radians, and a share of the top speed from -1 to 1; 0 turns on the spot, negative drives in reverse.
    /// Legs can walk along one heading and face another meanwhile; wheels cannot.
    Steer { heading: f32, facing: f32, speed: f32 },
    /// Turn on the spot, rad/s.
    Spin(f32),
}

impl SteeringIntent {
    /// Whether all its numbers are finite.
    pub fn is_finite(self) -> bool {
        match self {
            SteeringIntent::Stop => true,
            SteeringIntent::Steer { heading, facing, speed } => {
                heading.is_finite() && facing.is_finite() && speed.is_finite()
            }
            SteeringIntent::Spin(rate) => rate.is_finite(),
        }
    }
}

/// What a robot wants to do to the ball besides walking into it; written by the Motor stage.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, Reflect)]
pub enum KickIntent {
    /// No kick.
    #[default]
    Nothing,
    /// Catch the ball under the chin, and keep it there.
    Hold,
    /// Kick, by the index of the kick among the robot's own.
    Kick(usize),
}

/// Where a head should look, rad to the left of the body's heading; written by the Motor stage.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Reflect)]
pub struct HeadIntent {
    /// rad, counter-clockwise from straight ahead.
    pub pan: f32,
    /// How fast it should turn there, rad/s.
    pub speed: f32,
}

impl HeadIntent {
    /// Whether both numbers are finite.
    pub fn is_finite(self) -> bool {
        self.pan.is_finite() && self.speed.is_finite()
    }
}

/// Where a head looks; always straight ahead without a neck. Written by the Drive stage.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Reflect)]
pub struct Head {
    /// rad to the left of the body's heading
    pub pan: f32,
}
