//! Where a camera is, and which way a pixel looks.

use bevy::math::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

use super::settings::Resolution;
use crate::data::{Bound, Fault, Validate, check_all, check_count};
use crate::geometry::{Sighting, angle};
use crate::ops;

/// The sensor and the lens of a camera, and where it sits on its robot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Optics {
    /// Pixels of the sensor.
    pub width: usize,
    /// Pixels of the sensor.
    pub height: usize,
    /// Degrees from the left edge to the right edge. Pixels are square.
    pub field_of_view: f32,
    /// Of the lens above the carpet, m.
    pub mount: f32,
    /// By how much the camera looks down when it looks straight ahead, degrees.
    pub tilt: f32,
    /// By how much it looks down at a ball at the robot's feet, degrees; as the above, if it cannot nod.
    pub nod: f32,
}

/// Where a camera looks: its own turn on the robot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Gaze {
    /// rad to the left of the robot's heading.
    pub pan: f32,
    /// rad downwards.
    pub tilt: f32,
}

impl Optics {
    /// Width and height of a picture, pixels.
    pub const fn picture_size(&self, resolution: Resolution) -> (usize, usize) {
        let step = resolution.step();
        (self.width / step, self.height / step)
    }

    /// Distance from the lens to the picture, in pixels of a picture of this width.
    pub fn focal_length(&self, width: usize) -> f32 {
        width as f32 / 2.0 / ops::tan(self.field_of_view.to_radians() / 2.0)
    }

    /// The direction in which a point of a picture looks: x ahead of the robot, y to its left, z upwards; not of unit length.
    /// Points are counted in pixels from the picture's left upper corner; the middle of the first pixel is (0.5, 0.5).
    pub fn ray(&self, (width, height): (usize, usize), gaze: Gaze, at: Vec2) -> Vec3 {
        let focal = self.focal_length(width);
        let (left, up) = (width as f32 / 2.0 - at.x, height as f32 / 2.0 - at.y);
        let (sin, cos) = ops::sin_cos(gaze.tilt);
        let (ahead, rise) = (focal * cos + up * sin, up * cos - focal * sin);
        let across = Vec2::new(ops::cos(gaze.pan), ops::sin(gaze.pan)).rotate(Vec2::new(ahead, left));
        across.extend(rise)
    }

    /// Where a direction, as [`ray`](Optics::ray) gives it, meets a picture; nothing, if it is behind the lens.
    pub fn project(&self, (width, height): (usize, usize), gaze: Gaze, way: Vec3) -> Option<Vec2> {
        let flat = Vec2::new(ops::cos(gaze.pan), -ops::sin(gaze.pan)).rotate(way.truncate());
        let (sin, cos) = ops::sin_cos(gaze.tilt);
        let (depth, up) = (flat.x * cos - way.z * sin, flat.x * sin + way.z * cos);
        let scale = self.focal_length(width) / depth;
        let at = Vec2::new(width as f32 / 2.0 - flat.y * scale, height as f32 / 2.0 - up * scale);
        (depth > 0.0).then_some(at)
    }

    /// Where on a plane at this height, m, a point of a picture is; nothing, if it looks past it.
    pub fn on_plane(&self, size: (usize, usize), gaze: Gaze, at: Vec2, height: f32) -> Option<Sighting> {
        let way = self.ray(size, gaze, at);
        let share = (height - self.mount) / way.z;
        let flat = way.truncate() * share;
        (share > 0.0 && share.is_finite()).then(|| Sighting { range: flat.length(), bearing: angle(flat) })
    }
}

impl Validate for Optics {
    fn validate(&self) -> Result<(), Fault> {
        check_count("width", "the number of pixels", self.width, 16..=MOST_PIXELS)?;
        check_count("height", "the number of pixels", self.height, 16..=MOST_PIXELS)?;
        check_all([
            ("field_of_view", self.field_of_view, Bound::VIEW),
            ("mount", self.mount, Bound::SIZE.positive()),
            ("tilt", self.tilt, Bound::NOD),
            ("nod", self.nod, Bound::NOD),
        ])
    }
}

/// Of a side of a picture.
const MOST_PIXELS: usize = 1024;

#[cfg(test)]
mod tests {
    use super::*;

    const OPTICS: Optics =
        Optics { width: 208, height: 160, field_of_view: 56.9, mount: 0.19, tilt: 10.0, nod: 40.0 };
    const SIZE: (usize, usize) = (208, 160);

    #[test]
    fn a_ray_meets_the_picture_where_it_came_from() {
        for gaze in [Gaze::default(), Gaze { pan: 0.7, tilt: 0.3 }, Gaze { pan: -1.4, tilt: -0.2 }] {
            for at in [Vec2::new(0.5, 0.5), Vec2::new(104.0, 80.0), Vec2::new(207.5, 159.5)] {
                let back = OPTICS.project(SIZE, gaze, OPTICS.ray(SIZE, gaze, at)).unwrap();
                assert!(back.distance(at) < 1e-2, "{gaze:?} {at} {back}");
            }
        }
    }

    #[test]
    fn the_edges_are_half_a_field_of_view_aside_and_the_left_one_is_to_the_left() {
        let way = OPTICS.ray(SIZE, Gaze::default(), Vec2::new(0.0, 80.0));
        assert!((angle(way.truncate()).to_degrees() - 28.45).abs() < 0.01);
    }

    #[test]
    fn a_point_on_the_carpet_is_where_its_angle_says() {
        let gaze = Gaze { pan: 0.5, tilt: 0.3 };
        let seen = OPTICS.on_plane(SIZE, gaze, Vec2::new(104.0, 80.0), 0.0).unwrap();
        assert!((seen.range - 0.19 / ops::tan(0.3)).abs() < 1e-4 && (seen.bearing - 0.5).abs() < 1e-4);
        assert_eq!(
            OPTICS.on_plane(SIZE, Gaze::default(), Vec2::new(104.0, 20.0), 0.0),
            None,
            "above the horizon"
        );
    }
}
