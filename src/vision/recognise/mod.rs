//! What a cut picture shows: the ball, other robots, landmarks. Each patch of colour must look as the thing does at its place, as
//! teams check it: large enough, dense, as high above the carpet as it should be, with the right colours around it.
//!
//! Everything is as the robot's own camera has it: what is hidden, badly lit or wrongly calibrated is missed, or taken for something
//! else. Nothing here knows the truth.

mod ball;
mod beacons;
mod estimate;
mod goals;
mod known;
mod lines;
mod perspective;
mod robots;

pub use known::KnownObjects;

use super::landmark::LandmarkSighting;
use super::optics::{Gaze, Optics};
use super::segmentation::Segmented;
use crate::geometry::Sighting;
use crate::ids::Team;
use perspective::Perspective;

/// What a robot recognises in one picture. Ranges are from the robot to the middle of a thing, on the carpet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recognised {
    /// The ball.
    pub ball: Option<Sighting>,
    /// Other robots by their markers.
    pub robots: Vec<(Team, Sighting)>,
    /// Beacons, posts, then points of lines and walls.
    pub landmarks: Vec<LandmarkSighting>,
}

/// Recognises what a picture shows that was taken through these optics with this gaze.
pub fn recognise(picture: Segmented, optics: &Optics, gaze: Gaze, known: &KnownObjects) -> Recognised {
    let view = Perspective::new(optics, gaze, picture);
    let mut seen = Recognised { ball: ball::find_ball(&view, known), ..Recognised::default() };
    robots::find_robots(&view, known, &mut seen.robots);
    let mut beacon_boxes = Vec::new();
    beacons::find_beacons(&view, known, &mut seen.landmarks, &mut beacon_boxes);
    goals::find_posts(&view, known, &beacon_boxes, &mut seen.landmarks);
    lines::find_lines(&view, known, &mut seen.landmarks);
    seen
}

#[cfg(test)]
mod tests;
