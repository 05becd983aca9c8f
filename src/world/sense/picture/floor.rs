//! The floor: carpet, painted lines, and what is beyond. A picture of it from above, in several sizes.

use bevy::math::Vec2;

use super::material::{LINE_STEPS, Material, Tone};
use super::raster::{FIXED, Raster};
use super::shot::Viewpoint;
use super::solid::Spread;
use crate::geometry::Zone;
use crate::pitch::Pitch;
use crate::vision::paint::PitchPaint;

/// The floor from above. Texels hold the number of a material: that of carpet and line, or of what is beyond.
#[derive(Clone, Debug)]
pub struct Floor {
    /// The south-western corner.
    least: Vec2,
    /// Of a texel of the finest level, m.
    texel: f32,
    /// Each level has half the texels of the one before in each direction.
    levels: Vec<Level>,
}

#[derive(Clone, Debug)]
struct Level {
    width: usize,
    height: usize,
    texels: Vec<u8>,
}

/// Of a texel, on a pitch that is not larger than the leagues', m.
const TEXEL: f32 = 0.005;
/// Texels of a larger one in each direction.
const MOST_TEXELS: f32 = 2048.0;
const LEVELS: usize = 7;
/// Pixels between two places where the light of the floor is looked up.
const LIT: usize = 32;
/// Places that a pixel far away looks up, one behind the other.
const MOST_TAPS: f32 = 4.0;
/// Texels from the lens to the farthest place of the floor that is looked up.
const HORIZON: f32 = 12_000.0;

impl Floor {
    /// The floor of a pitch, up to its fence or walls.
    pub fn of(pitch: &Pitch) -> Floor {
        let walls = PitchPaint::of(pitch).walls.is_some();
        let edge =
            pitch.half_size() + if walls { Vec2::X * pitch.goal.depth } else { Vec2::splat(pitch.margin()) };
        let texel = TEXEL.max(2.0 * edge.max_element() / MOST_TEXELS);
        let size = (2.0 * edge / texel).ceil();
        let (width, height) = (size.x as usize, size.y as usize);
        let mut brush =
            Brush { least: -edge, texel, level: Level { width, height, texels: vec![0; width * height] } };
        brush.paint_lines(pitch, walls);
        let mut levels = vec![brush.level];
        while levels.len() < LEVELS {
            let next = levels[levels.len() - 1].halved();
            levels.push(next);
        }
        Floor { least: -edge, texel, levels }
    }

    /// Paints all rows of a picture: floor up to the horizon, and above it the dark under the roof.
    pub fn paint(&self, view: &Viewpoint, light: &Spread, raster: &mut Raster) {
        for row in 0..view.size.1 {
            let up = view.middle().y - (row as f32 + 0.5);
            match self.stretch(view, up) {
                Some(stretch) => self.paint_row(&stretch, light, raster.row(row)),
                None => raster.row(row).fill(Tone::new(Material::HALL, 14)),
            }
        }
    }

    /// The part of the floor that a row shows, if it shows the floor.
    fn stretch(&self, view: &Viewpoint, up: f32) -> Option<Stretch> {
        let (sin, cos) = view.tilt;
        let (ahead, rise) = (view.focal * cos + up * sin, up * cos - view.focal * sin);
        let share = view.height / -rise;
        let left = view.middle().x - 0.5;
        let reach = (ahead.abs() + view.middle().x) * share;
        if rise >= 0.0 || reach > HORIZON * self.texel {
            return None;
        }
        // Metres for a pixel along the row, and from this row to the next: a pixel of the floor far away is long.
        let across = share * (sin + ahead * share * cos / view.height).abs();
        let level = self.level_for((share * across).sqrt());
        let taps = (across / self.texel_of(level)).round().clamp(1.0, MOST_TAPS);
        let apart = across / taps;
        let first = Vec2::new(ahead * share - (taps - 1.0) / 2.0 * apart, left * share);
        Some(Stretch {
            from: view.eye + view.ahead.rotate(first),
            step: view.ahead.rotate(Vec2::new(0.0, -share)),
            deeper: view.ahead * apart,
            taps: taps as usize,
            level,
        })
    }

    /// m.
    fn texel_of(&self, level: usize) -> f32 {
        self.texel * (1 << level) as f32
    }

    /// The level whose texels are not larger than a size in metres.
    fn level_for(&self, size: f32) -> usize {
        (0..LEVELS - 1).find(|level| self.texel_of(level + 1) > size).unwrap_or(LEVELS - 1)
    }

    fn paint_row(&self, stretch: &Stretch, light: &Spread, tones: &mut [Tone]) {
        match stretch.taps {
            1 => self.walk::<1>(stretch, light, tones),
            2 => self.walk::<2>(stretch, light, tones),
            3 => self.walk::<3>(stretch, light, tones),
            _ => self.walk::<4>(stretch, light, tones),
        }
    }

    /// Paints a row each of whose pixels looks up so many places.
    fn walk<const TAPS: usize>(&self, stretch: &Stretch, light: &Spread, tones: &mut [Tone]) {
        let level = &self.levels[stretch.level];
        let shift = 16 + stretch.level;
        let [mut x, mut y] = self.fixed(stretch.from - self.least);
        let [along_x, along_y] = self.fixed(stretch.step);
        let taps: [[i32; 2]; TAPS] = std::array::from_fn(|tap| self.fixed(stretch.deeper * tap as f32));
        let look = |x: i32, y: i32| {
            let steps = taps.map(|[right, up]| {
                level.line_steps(x.wrapping_add(right) >> shift, y.wrapping_add(up) >> shift)
            });
            let sum: u32 = steps.iter().map(|steps| u32::from(steps.unwrap_or(0))).sum();
            let mean = sum * (256 / TAPS as u32) + 128;
            steps[0].map_or(Material::BEYOND, |_| Material::floor((mean >> 8) as u8))
        };
        let mut at = stretch.from;
        let mut shade = (light.shade(at, 1.0) * FIXED) as i32;
        for piece in tones.chunks_mut(LIT) {
            at += stretch.step * LIT as f32;
            let next = (light.shade(at, 1.0) * FIXED) as i32;
            let step = (next - shade) / LIT as i32;
            for tone in piece {
                *tone = Tone::new(look(x, y), (shade >> 16) as u16);
                (x, y) = (x.wrapping_add(along_x), y.wrapping_add(along_y));
                shade += step;
            }
            shade = next;
        }
    }

    /// Texels of the finest level as fixed-point numbers.
    fn fixed(&self, metres: Vec2) -> [i32; 2] {
        let scaled = metres * (FIXED / self.texel);
        [scaled.x as i32, scaled.y as i32]
    }
}

/// What a row shows of the floor.
struct Stretch {
    /// Under the middle of its first pixel.
    from: Vec2,
    /// From one pixel to the next.
    step: Vec2,
    /// From one place that a pixel looks up to the next one.
    deeper: Vec2,
    /// Places that a pixel looks up.
    taps: usize,
    level: usize,
}

impl Level {
    /// How much line there is at a place; nothing, beyond the edge.
    fn line_steps(&self, x: i32, y: i32) -> Option<u8> {
        // What is negative becomes larger than any width.
        let (x, y) = (x as u32 as usize, y as u32 as usize);
        (x < self.width && y < self.height).then(|| self.texels.get(y * self.width + x).copied()).flatten()
    }

    /// The same with one texel for four.
    fn halved(&self) -> Level {
        let (width, height) = (self.width / 2, self.height / 2);
        let mut texels = Vec::with_capacity(width * height);
        for row in 0..height {
            let (above, below) = self.texels[2 * row * self.width..].split_at(self.width);
            let pairs = above.chunks_exact(2).zip(below.chunks_exact(2)).take(width);
            texels.extend(pairs.map(|(a, b)| (a[0] + a[1] + b[0] + b[1] + 2) / 4));
        }
        Level { width, height, texels }
    }
}

/// Paints lines on the finest level.
struct Brush {
    least: Vec2,
    texel: f32,
    level: Level,
}

impl Brush {
    fn paint_lines(&mut self, pitch: &Pitch, walls: bool) {
        let half_width = PitchPaint::of(pitch).line_width / 2.0;
        let half = pitch.half_size();
        let is_wall = |from: Vec2, to: Vec2| {
            walls
                && ((from.x == to.x && from.x.abs() == half.x) || (from.y == to.y && from.y.abs() == half.y))
        };
        let lines = pitch.lines().into_iter().filter(|(from, to)| !is_wall(*from, *to));
        let post = Vec2::new(half.x, pitch.goal.width / 2.0);
        let mouths = [1.0, -1.0].map(|side| (post * Vec2::new(side, -1.0), post * Vec2::new(side, 1.0)));
        for (from, to) in lines.chain(mouths) {
            self.fill(Zone { min: from.min(to), max: from.max(to) }.grown(half_width), |at, texel| {
                let inside =
                    |low: f32, high: f32, x: f32| (high.min(x + texel) - low.max(x)).clamp(0.0, texel);
                let zone = Zone { min: from.min(to), max: from.max(to) }.grown(half_width);
                inside(zone.min.x, zone.max.x, at.x) * inside(zone.min.y, zone.max.y, at.y) / (texel * texel)
            });
        }
        let radius = pitch.centre_circle_radius;
        self.fill(Zone { min: Vec2::ZERO, max: Vec2::ZERO }.grown(radius + half_width), |at, texel| {
            let off = ((at + texel / 2.0).length() - radius).abs();
            ((half_width - off) / texel + 0.5).clamp(0.0, 1.0)
        });
    }

    /// Covers texels of a zone by a share each, which is that of the corner of the texel and of its size.
    fn fill(&mut self, zone: Zone, share: impl Fn(Vec2, f32) -> f32) {
        let Brush { least, texel, level } = self;
        let [low, high] = [zone.min, zone.max].map(|at| ((at - *least) / *texel).max(Vec2::ZERO));
        for row in low.y as usize..(high.y as usize + 1).min(level.height) {
            for column in low.x as usize..(high.x as usize + 1).min(level.width) {
                let at = *least + Vec2::new(column as f32, row as f32) * *texel;
                let steps = (share(at, *texel) * f32::from(LINE_STEPS)).round() as u8;
                let place = &mut level.texels[row * level.width + column];
                *place = steps.max(*place);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::pitch;
    use crate::vision::ColourClass;

    fn class(floor: &Floor, level: usize, x: f32, y: f32) -> Option<ColourClass> {
        let at = (Vec2::new(x, y) - floor.least) / (floor.texel * (1 << level) as f32);
        floor.levels[level]
            .line_steps(at.x.floor() as i32, at.y.floor() as i32)
            .and_then(|steps| Material::floor(steps).class())
    }

    #[test]
    fn lines_are_white_where_the_pitch_has_them() {
        let floor = Floor::of(&pitch());
        let (white, green) = (Some(ColourClass::White), Some(ColourClass::Green));
        for level in 0..3 {
            assert_eq!(class(&floor, level, 0.0, 1.3), white, "halfway line");
            assert_eq!(class(&floor, level, 0.35, 0.355), white, "circle");
            assert_eq!(class(&floor, level, -3.5, 1.2), white, "penalty area");
            assert_eq!(class(&floor, level, 4.5, 0.3), white, "goal line");
            assert_eq!(class(&floor, level, 2.0, 2.0), green);
            assert_eq!(class(&floor, level, 1.0, 2.49), green, "the wall is white, not the floor");
            assert_eq!(class(&floor, level, 2.0, 2.6), None, "beyond the wall");
            assert_eq!(class(&floor, level, -20.0, 0.0), None);
        }
    }

    #[test]
    fn the_largest_pitch_has_a_floor_that_is_not_too_large() {
        let mut large = pitch();
        (large.length, large.width) = (200.0, 200.0);
        let floor = Floor::of(&large);
        assert!(floor.levels[0].texels.len() <= 2100 * 2100);
    }
}
