//! The ball in a picture: the outline that a sphere has, shaded as a sphere.

use super::material::{Material, TOP_SHADE, Tone};
use super::raster::{Raster, pixels};
use super::shot::{Corner, Viewpoint};

/// The shades of a sphere over its outline, as shares of its light.
#[derive(Clone, Debug)]
pub struct Sphere {
    shares: Vec<f32>,
}

/// Places of the table in each direction.
const SIDE: usize = 64;

impl Default for Sphere {
    fn default() -> Sphere {
        let share = |index: usize| {
            let [x, up] =
                [index % SIDE, index / SIDE].map(|place| (place as f32 + 0.5) / (SIDE as f32 / 2.0) - 1.0);
            let out = (1.0 - x * x - up * up).max(0.0).sqrt();
            let lit = (0.9 * up + 0.42 * out).max(0.0);
            // ASSUMPTION: much light comes back from carpet and walls, and the ball shines a little.
            let shine = ((0.45 * up + 0.9 * out + 0.1 * x) - 0.97).max(0.0) * 20.0;
            0.55 + 0.5 * lit + shine
        };
        Sphere { shares: (0..SIDE * SIDE).map(share).collect() }
    }
}

impl Sphere {
    /// Paints a sphere of this material around a point.
    pub fn paint(
        &self,
        view: &Viewpoint,
        middle: Corner,
        radius: f32,
        material: Material,
        raster: &mut Raster,
    ) {
        let Some(outline) = SphereOutline::of(view, middle, radius) else { return };
        let (width, height) = raster.size();
        let half = view.middle();
        let Some((top, bottom)) = outline.rows() else { return };
        let (top, bottom) = (half.y - top, half.y - bottom);
        let wide = outline.columns(half.y - (top + bottom) / 2.0).map_or(0.0, |(left, right)| left - right);
        let nearness = 1.0 / middle.depth;
        for row in pixels(top, bottom, height) {
            let y = row as f32 + 0.5;
            let Some((left, right)) = outline.columns(half.y - y) else { continue };
            let (from, to) = (half.x - left, half.x - right);
            let line = place((bottom - y) / (bottom - top)) * SIDE;
            let middle_x = (from + to) / 2.0;
            for column in pixels(from, to, width) {
                let across = (column as f32 + 0.5 - middle_x) / wide + 0.5;
                let shade = self.shares[line + place(across)] * middle.shade;
                let tone = Tone::new(material, shade.min(TOP_SHADE) as u16);
                raster.dot(row * width + column, nearness, tone);
            }
        }
    }
}

/// The place in a table of a share between 0 and 1.
fn place(share: f32) -> usize {
    (share * SIDE as f32).clamp(0.0, (SIDE - 1) as f32) as usize
}

/// The outline of a sphere in a picture: where rays just touch it. In pixels to the left of and above the picture's middle.
struct SphereOutline {
    middle: Corner,
    focal: f32,
    /// The squared distance of the sphere's surface along a ray that touches it.
    tangent: f32,
    radius: f32,
}

impl SphereOutline {
    /// Nothing, if the lens is in the sphere or beside it.
    fn of(view: &Viewpoint, middle: Corner, radius: f32) -> Option<SphereOutline> {
        let Corner { left, up, depth, .. } = middle;
        let tangent = left * left + up * up + depth * depth - radius * radius;
        (depth > radius).then_some(SphereOutline { middle, focal: view.focal, tangent, radius })
    }

    /// The highest and the lowest row.
    fn rows(&self) -> Option<(f32, f32)> {
        let Corner { up, depth, .. } = self.middle;
        let square = self.radius * self.radius;
        roots(square - depth * depth, up * self.focal * depth, (square - up * up) * self.focal * self.focal)
    }

    /// The leftmost and the rightmost place of a row.
    fn columns(&self, row: f32) -> Option<(f32, f32)> {
        let Corner { left, up, depth, .. } = self.middle;
        let along = row * up + self.focal * depth;
        let square = row * row + self.focal * self.focal;
        roots(left * left - self.tangent, left * along, along * along - square * self.tangent)
    }
}

/// Where a x² + 2 b x + c is 0, the greater one first; nothing, if it opens upwards or is below 0 throughout.
fn roots(a: f32, b: f32, c: f32) -> Option<(f32, f32)> {
    let square = b * b - a * c;
    (a < 0.0 && square >= 0.0).then(|| ((-b - square.sqrt()) / a, (-b + square.sqrt()) / a))
}

#[cfg(test)]
mod tests {
    use bevy::math::Vec2;

    use super::*;
    use crate::vision::ColourClass;

    const VIEW: Viewpoint = Viewpoint {
        eye: Vec2::ZERO,
        height: 0.0,
        ahead: Vec2::X,
        tilt: (0.0, 1.0),
        focal: 190.0,
        size: (208, 160),
    };

    #[test]
    fn exactly_the_rays_that_meet_the_sphere_show_it() {
        let orange = Material::of(ColourClass::Orange);
        for (left, up, depth) in [(0.0, 0.0, 1.0), (0.12, -0.1, 0.4), (-0.3, 0.05, 0.7)] {
            let mut raster = Raster::default();
            raster.begin(VIEW.size);
            let middle = Corner { left, up, depth, shade: 40.0 };
            Sphere::default().paint(&VIEW, middle, 0.11, orange, &mut raster);
            for (index, tone) in raster.tones().iter().enumerate() {
                let (column, row) = (index % 208, index / 208);
                let ray = bevy::math::Vec3::new(103.5 - column as f32, 79.5 - row as f32, 190.0).normalize();
                let off = ray.cross(bevy::math::Vec3::new(left, up, depth)).length();
                let is_clear = (off - 0.11).abs() > 1e-4;
                assert!(!is_clear || (tone.material() == orange) == (off < 0.11), "{column} {row} {off}");
            }
        }
    }

    #[test]
    fn a_sphere_is_darker_below() {
        let mut raster = Raster::default();
        raster.begin(VIEW.size);
        let middle = Corner { left: 0.0, up: 0.0, depth: 1.0, shade: 40.0 };
        Sphere::default().paint(&VIEW, middle, 0.11, Material::DARK, &mut raster);
        let (above, below) = (raster.row(64)[104], raster.row(96)[104]);
        assert!(above.index() > below.index() + 5, "{above:?} {below:?}");
    }
}
