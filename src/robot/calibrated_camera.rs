//! The camera of a robot that sees by pictures, as it is set now.

use std::sync::Arc;

use bevy::prelude::*;

use crate::data::Validate;
use crate::vision::{CameraCalibration, CameraSettings, ColourTable};

/// How a robot's camera is calibrated; robots that do not see by pictures have none. Changed by the Script stage only.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct CalibratedCamera(pub Arc<CameraCalibration>);

/// The running camera is set otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSet(pub CameraSettings);

/// Colours are cut otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct ColoursSet(pub ColourTable);

impl CalibratedCamera {
    /// Values that make no sense change nothing.
    pub(super) fn set(&mut self, CameraSet(settings): &CameraSet) {
        if settings.validate().is_ok() {
            Arc::make_mut(&mut self.0).settings = *settings;
        }
    }

    /// Thresholds that make no sense change nothing.
    pub(super) fn set_colours(&mut self, ColoursSet(colours): &ColoursSet) {
        if colours.validate().is_ok() {
            Arc::make_mut(&mut self.0).colours = colours.clone();
        }
    }
}
