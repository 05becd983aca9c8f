//! What can be set of a running camera.

use serde::{Deserialize, Serialize};

use crate::data::{Bound, Fault, Validate, check_all};

/// How a camera is set. Changed while the robot runs (TeamChaos, section 1).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraSettings {
    /// How long light falls on the sensor, as a multiple of what suits the hall. A longer one blurs fast turns more.
    pub exposure: f32,
    /// By how much the signal is amplified, its noise with it.
    pub gain: f32,
    /// Which light is taken for white.
    pub white_balance: WhiteBalance,
    /// Pixels of a picture, as a part of what the sensor has.
    pub resolution: Resolution,
    /// Frames a second.
    pub frame_hz: f32,
}

/// By how much red and blue are amplified against green.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each field is named after its colour")]
pub struct WhiteBalance {
    pub red: f32,
    pub blue: f32,
}

/// How many of the sensor's pixels a picture has in each direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Resolution {
    /// All.
    #[default]
    Full,
    /// One of two.
    Half,
    /// One of four.
    Quarter,
}

impl Resolution {
    /// Sensor pixels for one pixel of a picture, in each direction.
    pub const fn step(self) -> usize {
        match self {
            Resolution::Full => 1,
            Resolution::Half => 2,
            Resolution::Quarter => 4,
        }
    }
}

impl Default for CameraSettings {
    fn default() -> CameraSettings {
        CameraSettings {
            exposure: 1.0,
            gain: 1.0,
            white_balance: WhiteBalance { red: 1.0, blue: 1.0 },
            resolution: Resolution::Full,
            frame_hz: 30.0,
        }
    }
}

impl Validate for CameraSettings {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("exposure", self.exposure, Bound::COEFFICIENT.positive()),
            ("gain", self.gain, Bound::COEFFICIENT.positive()),
            ("white_balance.red", self.white_balance.red, Bound::COEFFICIENT.positive()),
            ("white_balance.blue", self.white_balance.blue, Bound::COEFFICIENT.positive()),
            ("frame_hz", self.frame_hz, Bound::RATE.positive()),
        ])
    }
}
