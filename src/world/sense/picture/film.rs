//! What lens and sensor make of light: blurred, amplified, clipped and noisy brightness and colour.

use super::glass::Glass;
use super::material::{FULL_SHADE, Material, SHADES, TONES, Tone};
use crate::rng::{Dice, Seed};
use crate::vision::{Image, Yuv};

/// A sensor with its tables and room for three rows.
#[derive(Clone, Debug)]
pub struct Film {
    /// For each tone, what the sensor gives of it.
    palette: Box<[Signal; TONES]>,
    /// Standard normal, 1 is [`NOISE_UNIT`]: a stretch for each channel.
    noise: [Vec<i16>; 3],
    /// The row at hand, and those above and below it, by their numbers' remainder.
    rows: [Channels; 3],
    blurred: Vec<i16>,
    /// The channels of the row at hand, as they come to the picture.
    developed: [Vec<u8>; 3],
}

/// How a picture is exposed.
#[derive(Clone, Copy, Debug)]
pub struct Exposure {
    /// By how much light of each of red, green and blue is more than what the paints are given for.
    pub light: [f32; 3],
    /// By how much noise is amplified.
    pub gain: f32,
    /// Over how many pixels a point is smeared.
    pub smear: f32,
}

/// Brightness, colour differences, and the standard deviation of the noise in 16ths, in one number.
#[derive(Clone, Copy, Debug, Default)]
struct Signal(u32);

impl Signal {
    fn new(y: u8, u: u8, v: u8, noise: u8) -> Signal {
        Signal(u32::from_le_bytes([y, u, v, noise]))
    }

    /// Brightness, blue and red against it, noise.
    fn parts(self) -> [i16; 4] {
        self.0.to_le_bytes().map(i16::from)
    }
}

/// The channels of a row, with a pixel more on both sides.
#[derive(Clone, Debug, Default)]
struct Channels {
    y: Vec<i16>,
    u: Vec<i16>,
    v: Vec<i16>,
    noise: Vec<i16>,
}

const NOISE_UNIT: f32 = 32.0;
/// What a pixel gets of the brightness of the next ones, as a power of two: an eighth. ASSUMPTION: at the finest pattern of light
/// and dark that the pixels can show, half of the contrast is left, as of a small lens.
const LENS: u32 = 3;
/// What a pixel gets of the colour of the next ones, as a power of two: a quarter, as of a sensor with one colour a pixel.
const MOSAIC: u32 = 2;
/// Rows begin at any of so many places of the noise.
const STARTS: usize = 4096;
/// The widest picture.
const WIDEST: usize = 1024;
/// Noise of a dark pixel, in levels of brightness. ASSUMPTION.
const DARK_NOISE: f32 = 2.0;
/// Noise of a full pixel, in levels of brightness, which grows with the root of the light. ASSUMPTION.
const LIGHT_NOISE: f32 = 5.0;

impl Default for Film {
    fn default() -> Film {
        // The same for all; where a row begins is a matter of the match's dice.
        let mut dice = Dice::new(Seed(0), "noise of sensors", None);
        let mut noise =
            || (0..STARTS + WIDEST).map(|_| dice.normal(NOISE_UNIT).clamp(-127.0, 127.0) as i16).collect();
        Film {
            palette: Box::new([Signal::default(); TONES]),
            noise: [noise(), noise(), noise()],
            rows: Default::default(),
            blurred: Vec::new(),
            developed: Default::default(),
        }
    }
}

impl Film {
    /// Makes a picture of what each pixel shows, of this width and height.
    pub fn develop(
        &mut self,
        (tones, (width, height)): (&[Tone], (usize, usize)),
        glass: &Glass,
        exposure: &Exposure,
        dice: &mut Dice,
        image: &mut Image,
    ) {
        (image.width, image.height) = (width, height);
        image.pixels.resize(width * height, Yuv::default());
        self.rows.iter_mut().for_each(|row| row.fit(width));
        self.mix(exposure);
        let smear = (exposure.smear.round() as usize).min(width);
        for row in 0..=height {
            if row < height {
                self.gather(row, tones, glass, smear);
            }
            if let Some(above) = row.checked_sub(1) {
                let span = above * width..row * width;
                let start = (dice.uniform() * STARTS as f32) as usize;
                // The first row has none above it, and the last one none below.
                let near = [above.saturating_sub(1), above, row.min(height - 1)].map(|row| row % 3);
                self.fix(near, &mut image.pixels[span], start);
            }
        }
    }

    /// Works out what the sensor gives of each tone.
    fn mix(&mut self, exposure: &Exposure) {
        for (material, signals) in Material::all().zip(self.palette.chunks_exact_mut(SHADES)) {
            let paint = material.paint();
            let full = [0, 1, 2].map(|channel| paint[channel] * exposure.light[channel] / FULL_SHADE);
            for (shade, signal) in signals.iter_mut().enumerate() {
                let [r, g, b] = full.map(|channel| (channel * shade as f32).min(255.0));
                let y = 0.299 * r + 0.587 * g + 0.114 * b;
                let variance =
                    DARK_NOISE * DARK_NOISE * exposure.gain + LIGHT_NOISE * LIGHT_NOISE * y / 255.0;
                let (blue, red) = (128.5 + 0.564_334 * (b - y), 128.5 + 0.713_267 * (r - y));
                let noise = 16.0 * (exposure.gain * variance).sqrt();
                *signal = Signal::new((y + 0.5) as u8, blue as u8, red as u8, noise as u8);
            }
        }
    }

    /// Reads a row, smeared over so many pixels.
    fn gather(&mut self, row: usize, tones: &[Tone], glass: &Glass, length: usize) {
        let Channels { y, u, v, noise } = &mut self.rows[row % 3];
        let width = noise.len();
        let span = row * width..(row + 1) * width;
        let out = y[1..].iter_mut().zip(&mut u[1..]).zip(&mut v[1..]).zip(noise);
        let lens = glass.light[span.clone()].iter().zip(&glass.shift[span.clone()]);
        for ((tone, (light, shift)), (((y, u), v), noise)) in tones[span].iter().zip(lens).zip(out) {
            let [bright, blue, red, deviation] =
                self.palette[tone.darkened(u16::from(*light)).index()].parts();
            let shift = i16::from(*shift);
            (*y, *u, *v, *noise) = (bright, blue + shift, red - shift / 2, deviation);
        }
        for channel in [y, u, v] {
            if length > 1 {
                smear(&mut channel[1..=width], length, &mut self.blurred);
            }
            channel[0] = channel[1];
            channel[width + 1] = channel[width];
        }
    }

    /// Mixes a row with those above and below it, adds noise and writes pixels.
    fn fix(&mut self, [above, here, below]: [usize; 3], pixels: &mut [Yuv], start: usize) {
        let [above, here, below] = [&self.rows[above], &self.rows[here], &self.rows[below]];
        let (room, [of_y, of_u, of_v]) = (&mut self.blurred, &mut self.developed);
        let noise =
            [0, 1, 2].map(|channel| (&self.noise[channel][start..start + pixels.len()], &here.noise[..]));
        expose::<LENS>([&above.y, &here.y, &below.y], noise[0], room, of_y);
        expose::<MOSAIC>([&above.u, &here.u, &below.u], noise[1], room, of_u);
        expose::<MOSAIC>([&above.v, &here.v, &below.v], noise[2], room, of_v);
        for (((pixel, y), u), v) in pixels.iter_mut().zip(of_y).zip(of_u).zip(of_v) {
            *pixel = Yuv { y: *y, u: *u, v: *v };
        }
    }
}

impl Channels {
    fn fit(&mut self, width: usize) {
        for channel in [&mut self.y, &mut self.u, &mut self.v] {
            channel.resize(width + 2, 0);
        }
        self.noise.resize(width, 0);
    }
}

/// Mixes each value of a row with those around it, and adds noise of a strength. The rows have a value more on both sides.
fn expose<const BITS: u32>(
    [above, here, below]: [&[i16]; 3],
    (random, strength): (&[i16], &[i16]),
    mixed: &mut Vec<i16>,
    out: &mut Vec<u8>,
) {
    mixed.clear();
    mixed.extend(
        above.iter().zip(here).zip(below).map(|((above, here), below)| blend::<BITS>(*above, *here, *below)),
    );
    let values = mixed.iter().zip(&mixed[1..]).zip(&mixed[2..]);
    let noise = random.iter().zip(strength).map(|(random, strength)| (random * strength) >> 9);
    out.clear();
    out.extend(values.zip(noise).map(|(((left, middle), right), noise)| {
        (blend::<BITS>(*left, *middle, *right) + noise).clamp(0, 255) as u8
    }));
}

/// A value of which one of 2 to the power of `BITS` parts is each neighbour's.
fn blend<const BITS: u32>(before: i16, own: i16, after: i16) -> i16 {
    (before + own * ((1 << BITS) - 2) + after + (1 << (BITS - 1))) >> BITS
}

/// Replaces each pixel of a row by the mean of so many neighbours, with the last one of the row repeated beyond its ends.
fn smear(row: &mut [i16], length: usize, room: &mut Vec<i16>) {
    let &mut [first, .., last] = row else { return };
    let (before, after) = (length / 2, length - length / 2);
    room.clear();
    room.resize(before, first);
    room.extend_from_slice(row);
    room.resize(before + row.len() + after, last);
    let share = (1 << 16) / length as i32;
    let mut sum: i32 = room[..length].iter().copied().map(i32::from).sum();
    for ((value, enters), leaves) in row.iter_mut().zip(&room[length..]).zip(&*room) {
        *value = ((sum * share + (1 << 15)) >> 16) as i16;
        sum += i32::from(enters - leaves);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vision::ColourClass;
    use crate::vision::paint::paint;

    const EXPOSURE: Exposure = Exposure { light: [1.0; 3], gain: 1.0, smear: 0.0 };

    fn signal(exposure: Exposure, class: ColourClass) -> Yuv {
        let mut film = Film::default();
        film.mix(&exposure);
        let tone = super::super::material::Tone::new(Material::of(class), FULL_SHADE as u16);
        let [y, u, v, _] = film.palette[tone.index()].0.to_le_bytes();
        Yuv { y, u, v }
    }

    #[test]
    fn a_paint_in_the_light_that_it_is_given_for_has_its_own_colour() {
        for class in ColourClass::ALL {
            let (ours, nominal) = (signal(EXPOSURE, class), Yuv::from_rgb(paint(class)));
            let off = [ours.y.abs_diff(nominal.y), ours.u.abs_diff(nominal.u), ours.v.abs_diff(nominal.v)];
            assert!(off.iter().all(|off| *off <= 1), "{class}: {ours:?} {nominal:?}");
        }
    }

    #[test]
    fn a_sensor_clips_each_colour_so_that_too_much_light_makes_all_white() {
        let orange = signal(Exposure { light: [20.0; 3], ..EXPOSURE }, ColourClass::Orange);
        assert_eq!(orange.to_rgb(), [255; 3]);
    }

    #[test]
    fn a_point_of_light_spreads_to_its_neighbours_and_no_light_is_lost() {
        let rows = [[0; 7], [0, 0, 0, 240, 0, 0, 0], [0; 7]];
        let still = [0; 5];
        let (mut room, mut out) = (Vec::new(), Vec::new());
        let mut row = |above: usize, here: usize, below: usize| {
            let near = [above, here, below].map(|row| &rows[row][..]);
            expose::<MOSAIC>(near, (&still, &still), &mut room, &mut out);
            out.clone()
        };
        assert_eq!(row(0, 1, 2), [0, 30, 60, 30, 0]);
        assert_eq!(row(0, 0, 1), [0, 15, 30, 15, 0]);
    }

    #[test]
    fn a_smeared_row_keeps_its_mean_and_spreads_an_edge_over_the_length() {
        let mut out: Vec<i16> = (0..40).map(|index| if index < 20 { 50 } else { 150 }).collect();
        smear(&mut out, 8, &mut Vec::new());
        assert_eq!(out.iter().filter(|value| (51..=149).contains(*value)).count(), 7);
        assert_eq!((out[0], out[39]), (50, 150));
        assert!(out.windows(2).all(|pair| pair[0] <= pair[1]));
    }
}
