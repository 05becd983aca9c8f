//! Where on the sensor the drawn picture falls: the lens bends it, a camera that rolls turns it, and rows that are read one after
//! the other show a turn askew.

use super::material::Tone;
use super::shot::Shot;
use crate::ops;

/// Moves pixels of a drawn picture to where the sensor has them. The drawn one has a margin around it.
#[derive(Clone, Debug, Default)]
pub struct Warp {
    made_for: Option<Lens>,
    /// For each pixel of the sensor, how far from it what it shows was drawn, to the right and down, in [`UNIT`]s.
    bent: Vec<[i16; 2]>,
    tones: Vec<Tone>,
}

/// What the table is made for.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Lens {
    size: (usize, usize),
    /// Pixels.
    focal: f32,
    distortion: (f32, f32),
}

/// Parts of a pixel.
const UNIT: f32 = 32.0;
/// The same, as bits.
const UNIT_BITS: u32 = 5;
/// Fixed-point numbers have so many bits more than units.
const FINE_BITS: u32 = 11;
/// The largest shift of a pixel that the table holds, pixels.
const FARTHEST: f32 = 1000.0;

impl Warp {
    /// What each pixel of the sensor shows, row by row.
    pub fn tones(&self) -> &[Tone] {
        &self.tones
    }

    /// Fills the sensor from the drawn picture.
    pub fn apply(&mut self, shot: &Shot, drawn: &[Tone]) {
        self.fit(shot);
        let (width, height) = shot.size();
        let margin = shot.margin() as i32;
        let (wide, high) = (width as i32 + 2 * margin, height as i32 + 2 * margin);
        let fine = |pixels: f32| (pixels * UNIT * (1 << FINE_BITS) as f32) as i32;
        let skew = shot.skew();
        self.tones.resize(width * height, Tone::default());
        let rows = self.tones.chunks_exact_mut(width).zip(self.bent.chunks_exact(width)).enumerate();
        for (row, (tones, bent)) in rows {
            let down = row as f32 + 0.5 - height as f32 / 2.0;
            let right = 0.5 - width as f32 / 2.0;
            // The middle of the row's first pixel.
            let mut x = ((margin << UNIT_BITS) + (1 << (UNIT_BITS - 1)))
                + (fine((skew.aside - shot.sway.roll) * down) >> FINE_BITS);
            let y = ((margin + row as i32) << UNIT_BITS) + (1 << (UNIT_BITS - 1));
            let mut lower = fine(skew.along * down + shot.sway.roll * right);
            let step = fine(shot.sway.roll);
            for (tone, [off_x, off_y]) in tones.iter_mut().zip(bent) {
                let column = (x + i32::from(*off_x)) >> UNIT_BITS;
                let line = (y + (lower >> FINE_BITS) + i32::from(*off_y)) >> UNIT_BITS;
                let index = line.clamp(0, high - 1) * wide + column.clamp(0, wide - 1);
                *tone = drawn.get(index as usize).copied().unwrap_or_default();
                x += 1 << UNIT_BITS;
                lower += step;
            }
        }
    }

    /// Makes the table for a lens.
    fn fit(&mut self, shot: &Shot) {
        let size = shot.size();
        let lens = Lens { size, focal: shot.optics.focal_length(size.0), distortion: shot.flaws.distortion };
        if self.made_for == Some(lens) {
            return;
        }
        self.made_for = Some(lens);
        let (width, height) = size;
        self.bent = (0..width * height)
            .map(|index| {
                let place = [
                    (index % width) as f32 - width as f32 / 2.0,
                    (index / width) as f32 - height as f32 / 2.0,
                ];
                let [x, y] = place.map(|place| place + 0.5);
                let more = straightened(ops::hypot(x, y) / lens.focal, lens.distortion) - 1.0;
                [x, y].map(|place| ((place * more).clamp(-FARTHEST, FARTHEST) * UNIT).round() as i16)
            })
            .collect();
    }
}

/// By which factor a point at this distance from the middle, as a tangent, would be farther away without the lens's distortion.
fn straightened(bent: f32, (k1, k2): (f32, f32)) -> f32 {
    let mut factor = 1.0;
    // The root of a polynomial, by steps that go half of the way.
    for _ in 0..40 {
        let square = (bent * factor) * (bent * factor);
        let drawn = (1.0 + k1 * square + k2 * square * square).clamp(0.25, 4.0);
        factor += 0.5 * (1.0 / drawn - factor);
    }
    factor
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lens_bends_what_is_straightened_back_to_where_it_was() {
        for distortion in [(-0.147, 0.385), (-0.05, 0.0), (0.1, 0.0)] {
            for bent in [0.0_f32, 0.2, 0.5, 0.66] {
                let straight = bent * straightened(bent, distortion);
                let square = straight * straight;
                let again = straight * (1.0 + distortion.0 * square + distortion.1 * square * square);
                assert!((again - bent).abs() < 1e-4, "{distortion:?} {bent} {again}");
            }
        }
        assert_eq!(straightened(0.5, (0.0, 0.0)), 1.0);
    }

    #[test]
    fn no_lens_bends_a_point_to_nowhere() {
        for distortion in [(10.0, 10.0), (-10.0, -10.0), (-10.0, 10.0)] {
            let factor = straightened(3.0, distortion);
            assert!((0.2..=4.1).contains(&factor), "{distortion:?} {factor}");
        }
    }
}
