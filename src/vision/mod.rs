//! What a robot makes of the pictures of its camera, and how people calibrate that: colours, blobs, landmarks. Pure.
//!
//! A picture is cut by colour into classes, as the teams of both papers do it (Hammerheads, section III): a [`ColourTable`] says
//! what each [`ColourClass`] looks like to the camera as it is set. [`CameraCalibration`] holds all that people calibrate.

mod calibration;
mod colours;
mod image;
mod optics;
pub mod paint;
mod settings;

pub use calibration::CameraCalibration;
pub use colours::{ColourBox, ColourClass, ColourTable};
pub use image::{Image, Yuv};
pub use optics::{Gaze, Optics};
pub use settings::{CameraSettings, Resolution, WhiteBalance};
