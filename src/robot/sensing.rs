//! How well a robot sees and remembers, as data: the named presets in `assets/sensing/*.ron`.
//!
//! Lengths are metres, times seconds, angles degrees; noise values are standard deviations.

use serde::{Deserialize, Serialize};

use crate::data::{Bound, Fault, Validate, check_all};

/// Eyes, localisation, odometry and memory of a robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sensing {
    /// Its name for people.
    pub name: String,
    /// What the robot sees.
    pub eyes: Eyes,
    /// How long beliefs last.
    pub memory: MemorySpans,
}

/// Perfect sensing is a switch: everything, at once, without noise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Eyes {
    /// The truth, at every tick.
    Perfect,
    /// A camera and what goes with it.
    Real { camera: Camera, localisation: Localisation, odometry: OdometryNoise },
}

/// A colour-blob camera that looks ahead.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// Degrees, from edge to edge.
    pub field_of_view: f32,
    /// Frames a second.
    pub frame_hz: f32,
    /// From the shutter to the percept.
    pub latency: f32,
    /// Farthest usable reading of the ball.
    pub ball_range: f32,
    /// Farthest usable reading of a robot's marker.
    pub robot_range: f32,
    /// Noise of a range r is this times r², 1/m: a pixel means more metres farther away.
    pub range_noise: f32,
    /// Added to the above, m.
    pub range_floor: f32,
    /// Standard deviation, degrees.
    pub bearing_noise: f32,
    /// Chance that a frame shows what is in full view and near; falls to 0.3 of it at the end of the range.
    pub detection: f32,
    /// Least visible share of a thing that is still recognised.
    pub visible_share: f32,
    /// Chance per frame to take something else for the ball.
    pub false_positive: f32,
}

/// Self-localisation that is wrong by a slowly drifting amount.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Localisation {
    /// Of each coordinate.
    pub position: f32,
    /// Standard deviation, degrees.
    pub heading: f32,
    /// How long an error lasts: the time in which it falls to a third, left alone.
    pub drift_time: f32,
    /// Mean time between two jumps to another error.
    pub jump_time: f32,
}

/// Dead reckoning from the wheels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OdometryNoise {
    /// After one metre; grows with the root of the distance.
    pub distance: f32,
    /// After half a metre; grows with the root of the distance, degrees.
    pub heading: f32,
}

/// How long things are believed that are not seen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MemorySpans {
    /// s.
    pub ball: f32,
    /// s.
    pub robots: f32,
}

impl Validate for Sensing {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("memory.ball", self.memory.ball, Bound::SECONDS),
            ("memory.robots", self.memory.robots, Bound::SECONDS),
        ])?;
        match &self.eyes {
            Eyes::Perfect => Ok(()),
            Eyes::Real { camera, localisation, odometry } => check_all([
                ("eyes.camera.field_of_view", camera.field_of_view, Bound::ANGLE.positive()),
                ("eyes.camera.frame_hz", camera.frame_hz, Bound::RATE.positive()),
                ("eyes.camera.latency", camera.latency, Bound::DELAY),
                ("eyes.camera.ball_range", camera.ball_range, Bound::LENGTH.positive()),
                ("eyes.camera.robot_range", camera.robot_range, Bound::LENGTH.positive()),
                ("eyes.camera.range_noise", camera.range_noise, Bound::COEFFICIENT),
                ("eyes.camera.range_floor", camera.range_floor, Bound::LENGTH),
                ("eyes.camera.bearing_noise", camera.bearing_noise, Bound::ANGLE),
                ("eyes.camera.detection", camera.detection, Bound::SHARE),
                ("eyes.camera.visible_share", camera.visible_share, Bound::SHARE),
                ("eyes.camera.false_positive", camera.false_positive, Bound::SHARE),
                ("eyes.localisation.position", localisation.position, Bound::LENGTH),
                ("eyes.localisation.heading", localisation.heading, Bound::ANGLE),
                ("eyes.localisation.drift_time", localisation.drift_time, Bound::SECONDS.positive()),
                ("eyes.localisation.jump_time", localisation.jump_time, Bound::SECONDS.positive()),
                ("eyes.odometry.distance", odometry.distance, Bound::LENGTH),
                ("eyes.odometry.heading", odometry.heading, Bound::ANGLE),
            ]),
        }
    }
}
