//! Where the hall is brighter and where it is darker.

use std::f32::consts::TAU;

use bevy::math::Vec2;

use super::material::{FULL_SHADE, TOP_SHADE};
use crate::geometry::Zone;
use crate::ops;

/// How the light of a hall is spread over it: a smooth pattern between -1 and 1, looked up on a grid.
#[derive(Clone, Debug)]
pub struct Evenness {
    least: Vec2,
    /// Places of the grid for a metre, along each axis.
    scale: Vec2,
    pattern: Vec<f32>,
}

/// Places of the grid in each direction.
const SIDE: usize = 96;
/// Between lamps, m. ASSUMPTION.
const LAMPS: Vec2 = Vec2::new(5.1, 3.7);

impl Evenness {
    /// That of a hall of this size: lamps in rows, and windows in the north.
    pub fn of(room: Zone) -> Evenness {
        let size = room.max - room.min;
        let place = |index: usize| {
            let (column, row) = (index % SIDE, index / SIDE);
            room.min + size * Vec2::new(column as f32 + 0.5, row as f32 + 0.5) / SIDE as f32
        };
        let middle = (room.min + room.max) / 2.0;
        let value = |at: Vec2| {
            let (phase, windows) = (at / LAMPS * TAU, (at.y - middle.y) / size.y * 2.0);
            0.35 * ops::sin(phase.x + 0.7) + 0.35 * ops::sin(phase.y + 1.9) + 0.3 * windows
        };
        let pattern = (0..SIDE * SIDE).map(|index| value(place(index))).collect();
        Evenness { least: room.min, scale: SIDE as f32 / size, pattern }
    }

    /// The shade of a surface that looks up at a place, in light of this unevenness.
    pub fn shade(&self, at: Vec2, unevenness: f32) -> f32 {
        let place = ((at - self.least) * self.scale).clamp(Vec2::ZERO, Vec2::splat((SIDE - 1) as f32));
        let index = place.y as usize * SIDE + place.x as usize;
        let shade = FULL_SHADE * (1.0 + unevenness * self.pattern.get(index).copied().unwrap_or_default());
        shade.clamp(0.0, TOP_SHADE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_is_spread_smoothly_and_within_its_unevenness() {
        let evenness = Evenness::of(Zone { min: Vec2::new(-8.0, -6.0), max: Vec2::new(8.0, 6.0) });
        let mut least = f32::MAX;
        let mut most = f32::MIN;
        for step in 0..400 {
            let at = Vec2::new(-9.0 + 0.045 * step as f32, 7.0 - 0.035 * step as f32);
            let shade = evenness.shade(at, 0.2) / FULL_SHADE;
            let near = evenness.shade(at + Vec2::new(0.1, 0.1), 0.2) / FULL_SHADE;
            assert!((0.8..=1.2).contains(&shade) && (shade - near).abs() < 0.06, "{at} {shade} {near}");
            (least, most) = (least.min(shade), most.max(shade));
        }
        assert!(least < 0.9 && most > 1.1, "{least} {most}");
        assert_eq!(evenness.shade(Vec2::ONE, 0.0), FULL_SHADE);
        assert_eq!(evenness.shade(Vec2::new(1.0, 6.0), 10.0), TOP_SHADE, "a pixel can be no brighter");
    }
}
