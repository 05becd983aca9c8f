//! What a robot makes of the pictures of its camera, and how people calibrate that: colours, blobs, landmarks. Pure.
//!
//! A picture is cut by colour into classes, as the teams of both papers do it (Hammerheads, section III): a [`ColourTable`] says
//! what each [`ColourClass`] looks like to the camera as it is set. [`CameraCalibration`] holds all that people calibrate.
//!
//! A picture goes [`Image`] → [`Segmenter`] → [`recognise()`] → [`Recognised`]. People make a
//! table by [teaching](ColourTable::teach_at), and [`Quality`] is what it is worth.

mod blob;
mod calibration;
mod colours;
mod fit;
mod flaws;
mod image;
mod landmark;
pub mod localise;
mod lookup;
mod optics;
pub mod paint;
mod quality;
mod recognise;
#[cfg(test)]
mod scene;
mod segmentation;
mod settings;
#[cfg(test)]
mod sketch;
mod teach;

pub use blob::{ColourBlob, PixelBox};
pub use calibration::CameraCalibration;
pub use colours::{ColourBox, ColourClass, ColourTable};
pub use flaws::{CameraFlaws, GaitSway, MountPlay};
pub use image::{Image, Yuv};
pub use landmark::{Landmark, LandmarkSighting};
pub use lookup::ColourLookup;
pub use optics::{Gaze, Optics};
pub use quality::{ClassQuality, Quality};
pub use recognise::{KnownObjects, Recognised, recognise};
pub use segmentation::{MOST_BLOBS, Segmented, Segmenter};
pub use settings::{CameraSettings, Resolution, WhiteBalance};
