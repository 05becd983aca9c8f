//! What a calibrated camera is worth, told in the numbers of the fast model of a camera: many pictures of random moments of a match
//! are drawn and worked out, and what was recognised is compared with the truth.

mod fit;
mod moments;
mod plan;
mod readings;
mod report;

pub use plan::{EyesChoice, EyesPlan};
pub use report::{EyesReport, FittedNumber};
