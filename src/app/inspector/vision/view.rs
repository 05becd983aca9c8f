//! What the calibration's panel shows, as plain data: from the match of this window, or from a robot somewhere else.

use super::history::CameraValues;
use crate::vision::{
    CameraCalibration, CameraSettings, ColourClass, ColourTable, Gaze, Image, KnownObjects, Quality,
};
use crate::world::sense::Lighting;

/// A picture of a robot's camera, and what is made of it.
#[derive(Clone, Debug)]
pub struct CalibrationView<'a> {
    /// Whose camera it is, for people.
    pub whose: String,
    /// The last picture; none before the first.
    pub image: Option<&'a Image>,
    /// Which class each of its pixels truly shows, if that is known.
    pub truth: Option<&'a [Option<ColourClass>]>,
    /// How well the robot cuts its pictures, where that is told and the truth is not known.
    pub quality: Option<&'a Quality>,
    /// Where the camera looked when it took the picture.
    pub gaze: Gaze,
    /// What can be recognised in it; nothing is, where that is not known.
    pub known: Option<&'a KnownObjects>,
    /// The calibration that is in force, or asked for.
    pub calibration: &'a CameraCalibration,
    /// What its file says, and the name of that.
    pub file: Option<(&'a str, &'a CameraCalibration)>,
    /// The light of the hall and that with which the match began, where it can be changed.
    pub light: Option<[Lighting; 2]>,
}

/// What a person asks for in the panel.
#[derive(Clone, Debug, PartialEq)]
pub enum CalibrationWish {
    /// The running camera set otherwise.
    Camera(CameraSettings),
    /// Its pictures cut otherwise.
    Colours(ColourTable),
    /// The hall lit otherwise.
    Light(Lighting),
    /// The calibration as it is now in a file of this name.
    Save(String),
    /// The values of a file of this name.
    Load(String),
}

impl CalibrationWish {
    /// What leads from some values to others.
    pub fn between(before: &CameraValues, after: &CameraValues) -> Vec<CalibrationWish> {
        let settings = (before.settings != after.settings).then_some(CalibrationWish::Camera(after.settings));
        let colours = before.colours != after.colours;
        let colours = colours.then(|| CalibrationWish::Colours(after.colours.clone()));
        settings.into_iter().chain(colours).collect()
    }
}
