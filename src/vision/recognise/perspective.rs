//! From pixels to ranges and bearings, and how far they can be trusted.

use bevy::math::{Vec2, Vec3};

use super::estimate::RangeEstimate;
use crate::geometry::angle;
use crate::vision::colours::ColourClass;
use crate::vision::optics::{Gaze, Optics};
use crate::vision::segmentation::Segmented;

/// By how much a camera sways on a robot that moves, against what its robot knows: standard deviation, rad. ASSUMPTION: 0.7°.
pub const SWAY: f32 = 0.012;

/// By how much an edge in a picture is misplaced: standard deviation, pixels. ASSUMPTION.
const EDGE: f32 = 0.7;

/// A picture, cut by colour, and where its camera looked.
#[derive(Clone, Copy, Debug)]
pub struct Perspective<'a> {
    pub optics: &'a Optics,
    pub gaze: Gaze,
    pub picture: Segmented<'a>,
    focal_length: f32,
}

impl<'a> Perspective<'a> {
    pub fn new(optics: &'a Optics, gaze: Gaze, picture: Segmented<'a>) -> Perspective<'a> {
        Perspective { optics, gaze, picture, focal_length: optics.focal_length(picture.width) }
    }

    /// The direction of a point of the picture, of any length: ahead, left, up.
    pub fn ray(&self, at: Vec2) -> Vec3 {
        self.optics.ray((self.picture.width, self.picture.height), self.gaze, at)
    }

    /// Counter-clockwise from the robot's heading, rad.
    pub fn bearing(&self, at: Vec2) -> f32 {
        angle(self.ray(at).truncate())
    }

    /// By how much a direction rises on a metre.
    pub fn slope(&self, at: Vec2) -> f32 {
        let way = self.ray(at);
        way.z / way.truncate().length()
    }

    /// The slope at which a thing of this height is seen from this range, both m.
    pub fn slope_of(&self, height: f32, range: f32) -> f32 {
        (height - self.optics.mount) / range
    }

    /// By how much a slope is wrong that was read off the picture: standard deviation.
    pub fn slope_deviation(&self) -> f32 {
        Vec2::new(self.pixel(), SWAY).length()
    }

    /// The slope that the uncertainty of an edge is worth.
    pub fn pixel(&self) -> f32 {
        EDGE / self.focal_length
    }

    /// How far a point is whose height above the carpet is known, m; nothing, if it looks past all such points.
    pub fn by_plane(&self, at: Vec2, height: f32) -> Option<RangeEstimate> {
        let rise = height - self.optics.mount;
        let range = rise / self.slope(at);
        let deviation = range * range / rise.abs() * self.slope_deviation();
        (range > 0.0 && deviation.is_finite()).then_some(RangeEstimate { range, deviation })
    }

    /// How far an upright thing of known height is, m, that reaches from one row to another, whatever the camera's sway.
    pub fn by_height(&self, x: f32, (top, bottom): (f32, f32), height: f32) -> Option<RangeEstimate> {
        let span = self.slope(Vec2::new(x, top)) - self.slope(Vec2::new(x, bottom));
        let range = height / span;
        // Two edges.
        let deviation = range * range / height * self.pixel() * std::f32::consts::SQRT_2;
        (span > 0.0 && deviation.is_finite()).then_some(RangeEstimate { range, deviation })
    }

    /// How many of the pixels of some rows and columns are of a class that fits, and how many there are in the picture.
    pub fn count(
        &self,
        columns: std::ops::Range<isize>,
        rows: std::ops::Range<isize>,
        fits: impl Fn(ColourClass) -> bool,
    ) -> (usize, usize) {
        let within = |range: std::ops::Range<isize>, most: usize| {
            range.start.max(0) as usize..range.end.clamp(0, most as isize) as usize
        };
        let (columns, rows) = (within(columns, self.picture.width), within(rows, self.picture.height));
        if columns.is_empty() || rows.is_empty() {
            return (0, 0);
        }
        let all = columns.len() * rows.len();
        let fitting = rows.map(|row| {
            let start = row * self.picture.width;
            let classes = &self.picture.classes[start + columns.start..start + columns.end];
            classes.iter().filter(|class| class.is_some_and(&fits)).count()
        });
        (fitting.sum(), all)
    }
}
