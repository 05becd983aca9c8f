//! What a robot's senses tell it. The Sense stage writes it, and a mind knows nothing else of the world.

use crate::geometry::unit;
use std::f32::consts::PI;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::bump::BumpSensor;
use super::sensing::{Camera, Eyes};
use crate::geometry::{Pose, Sighting, wrap_angle};
use crate::ids::{RobotId, Team};
use crate::rng::{Dice, DiceStirred, Seed};

/// What a robot's sensors say: the newest camera frame that has arrived.
#[derive(Component, Clone, Debug, Default, Reflect)]
#[reflect(Component)]
pub struct Percepts {
    /// The newest frame of the camera, if one has come.
    pub frame: Option<Frame>,
}

/// One camera frame, worked out: egocentric sightings, and where the robot was by its own localisation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Reflect)]
pub struct Frame {
    /// The tick in which the shutter opened.
    pub taken: u64,
    /// The ball, if it was seen.
    pub ball: Option<Sighting>,
    /// Markers tell the team, not the number.
    pub robots: Vec<(Team, Sighting)>,
    /// The localised pose, if landmarks in view gave one.
    pub fix: Option<Fix>,
    /// Where the camera looked: rad to the left of the body's heading.
    pub pan: f32,
    /// Whether the robot's own chin was on the ball.
    pub chin_down: bool,
}

/// A pose that a robot has worked out from one camera frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Reflect)]
pub struct Fix {
    /// In the team frame.
    pub pose: Pose,
    /// How much of a full fix the landmarks in view give, 0 to 1.
    pub share: f32,
}

/// What wheels or legs report: a dead-reckoned pose in a frame of its own, what they are told, and whether they are blocked.
#[derive(Component, Clone, Debug, Reflect)]
#[reflect(Component, from_reflect = false)]
pub struct Odometry {
    /// Where the robot is by its own wheels or steps since the match began.
    pub pose: Pose,
    /// Speed ahead in m/s.
    pub speed: f32,
    /// rad/s
    pub turn_rate: f32,
    /// The fastest that a wheel or the legs are told to move, m/s.
    pub told: f32,
    /// Whether the drive is blocked, as far as it notices.
    #[reflect(ignore)]
    pub bump: BumpSensor,
    /// Distance since the last error was drawn, m.
    pub unjudged: f32,
    /// The dice of its errors.
    #[reflect(ignore)]
    pub dice: Dice,
}

impl Odometry {
    /// A robot that has not moved.
    pub fn new(seed: Seed, robot: RobotId) -> Odometry {
        Odometry {
            pose: Pose::default(),
            speed: 0.0,
            turn_rate: 0.0,
            told: 0.0,
            bump: BumpSensor::new(seed, robot),
            unjudged: 0.0,
            dice: Dice::new(seed, "odometry", Some(robot)),
        }
    }

    pub(super) fn stir(&mut self, stirred: DiceStirred) {
        self.dice.stir(stirred);
        self.bump.dice.stir(stirred);
    }
}

/// Whether a point at this sighting would be well inside the view of a frame, so that not seeing it means something.
pub fn should_be_seen(eyes: &Eyes, frame: &Frame, sighting: Sighting) -> bool {
    eyes.camera().is_none_or(|camera| {
        !frame.chin_down
            && sighting.range < 0.7 * camera.ball_range
            && wrap_angle(sighting.bearing - frame.pan).abs()
                < 0.4 * camera.field_of_view.to_radians().min(2.0 * PI)
    })
}

/// Moves a dead-reckoned pose by what wheels or legs report: a way ahead and to the left in metres, and a turn in radians.
pub fn reckon(pose: Pose, way: Vec2, turn: f32) -> Pose {
    let middle = pose.heading + turn / 2.0;
    Pose { position: pose.position + unit(middle).rotate(way), heading: wrap_angle(pose.heading + turn) }
}

/// The standard deviation of a measured range, m.
pub fn range_deviation(camera: &Camera, range: f32) -> f32 {
    camera.range_floor + camera.range_noise * range * range
}
