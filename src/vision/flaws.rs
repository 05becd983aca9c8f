//! What is wrong with a camera on its robot, and the robot's program does not allow for.

use serde::{Deserialize, Serialize};

use crate::data::{Bound, Fault, Validate, check_all};

/// How a camera differs from what its robot takes it to be. Without any it is a pinhole on a rigid mount, read at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CameraFlaws {
    /// Radial distortion of the lens: Brown's k1 and k2, of the square and the fourth power of the tangent of the angle off its
    /// axis. Below 0 a lens draws the edges of a picture together.
    pub distortion: (f32, f32),
    /// From reading the first row of a picture to reading the last one, s: what moves meanwhile is drawn askew.
    pub read_out: f32,
    /// How the camera sways while the robot moves.
    pub sway: GaitSway,
    /// How far joints and mount are off.
    pub play: MountPlay,
}

/// How a camera sways with a robot that moves at full speed, and by so much less as it moves slower. Legs roll and turn a body once
/// with each stride, and pitch and lift it twice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GaitSway {
    /// Strides a second, or turns of a wheel that is not round.
    pub rate: f32,
    /// Amplitude about the robot's long axis, degrees.
    pub roll: f32,
    /// Amplitude about its axis across, degrees.
    pub pitch: f32,
    /// Amplitude about the upright axis, degrees.
    pub yaw: f32,
    /// Amplitude upwards, m.
    pub rise: f32,
}

/// Errors of a camera's direction about each axis that stay for some time: an Ornstein-Uhlenbeck process.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MountPlay {
    /// Standard deviation, degrees.
    pub deviation: f32,
    /// The time in which an error falls to a third, s.
    pub time: f32,
}

impl Default for MountPlay {
    fn default() -> MountPlay {
        MountPlay { deviation: 0.0, time: 1.0 }
    }
}

impl Validate for CameraFlaws {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("distortion.0", self.distortion.0, Bound::COEFFICIENT.signed()),
            ("distortion.1", self.distortion.1, Bound::COEFFICIENT.signed()),
            ("read_out", self.read_out, Bound::SECONDS),
            ("sway.rate", self.sway.rate, Bound::RATE),
            ("sway.roll", self.sway.roll, Bound::SWAY),
            ("sway.pitch", self.sway.pitch, Bound::SWAY),
            ("sway.yaw", self.sway.yaw, Bound::SWAY),
            ("sway.rise", self.sway.rise, Bound::SIZE),
            ("play.deviation", self.play.deviation, Bound::SWAY),
            ("play.time", self.play.time, Bound::SECONDS.positive()),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flaw_out_of_its_bounds_is_a_fault_at_its_field() {
        let sway = GaitSway { pitch: 50.0, ..GaitSway::default() };
        let fault = CameraFlaws { sway, ..CameraFlaws::default() }.validate().unwrap_err();
        assert_eq!(fault.field.to_string(), "sway.pitch");
    }
}
