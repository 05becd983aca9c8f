//! All that people calibrate of a camera, as `assets/cameras/*.ron` has it.

use serde::{Deserialize, Serialize};

use super::colours::ColourTable;
use super::flaws::CameraFlaws;
use super::optics::Optics;
use super::settings::CameraSettings;
use crate::data::{Fault, Validate};

/// A camera as it is built, set and calibrated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraCalibration {
    /// Its name for people.
    pub name: String,
    /// How it is built; not changed while it runs.
    pub optics: Optics,
    /// What of it the robot does not allow for; not changed while it runs.
    #[serde(default)]
    pub flaws: CameraFlaws,
    /// How it is set.
    pub settings: CameraSettings,
    /// What colours look like to it, set like that.
    pub colours: ColourTable,
}

impl Validate for CameraCalibration {
    fn validate(&self) -> Result<(), Fault> {
        self.optics.validate_as("optics")?;
        self.flaws.validate_as("flaws")?;
        self.settings.validate_as("settings")?;
        self.colours.validate_as("colours")
    }
}
