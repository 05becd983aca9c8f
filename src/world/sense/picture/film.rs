//! What a sensor makes of light: amplified, clipped and noisy brightness and colour.

use std::ops::Range;

use super::glass::Glass;
use super::material::{FULL_SHADE, Material, SHADES, TONES};
use super::raster::Raster;
use crate::rng::{Dice, Seed};
use crate::vision::{Image, Yuv};

/// A sensor with its tables and room for one row.
#[derive(Clone, Debug)]
pub struct Film {
    /// For each tone, what the sensor gives of it.
    palette: Box<[Signal; TONES]>,
    /// Standard normal, 1 is [`NOISE_UNIT`]: a stretch for each channel.
    noise: [Vec<i16>; 3],
    row: Channels,
    blurred: Vec<i16>,
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

/// The channels of a row. The colours have a pixel more on both sides.
#[derive(Clone, Debug, Default)]
struct Channels {
    y: Vec<i16>,
    u: Vec<i16>,
    v: Vec<i16>,
    noise: Vec<i16>,
}

const NOISE_UNIT: f32 = 32.0;
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
            row: Channels::default(),
            blurred: Vec::new(),
        }
    }
}

impl Film {
    /// Makes a picture of what was painted.
    pub fn develop(
        &mut self,
        raster: &Raster,
        glass: &Glass,
        exposure: &Exposure,
        dice: &mut Dice,
        image: &mut Image,
    ) {
        let (width, height) = raster.size();
        (image.width, image.height) = (width, height);
        image.pixels.resize(width * height, Yuv::default());
        self.row.fit(width);
        self.mix(exposure);
        let smear = (exposure.smear.round() as usize).min(width);
        for row in 0..height {
            let span = row * width..(row + 1) * width;
            self.gather(raster, glass, span.clone());
            if smear > 1 {
                self.blur(smear);
            }
            let start = (dice.uniform() * STARTS as f32) as usize;
            self.fix(&mut image.pixels[span], start);
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

    fn gather(&mut self, raster: &Raster, glass: &Glass, span: Range<usize>) {
        let Channels { y, u, v, noise } = &mut self.row;
        let width = y.len();
        let colours = u[1..].iter_mut().zip(&mut v[1..]);
        let out = y.iter_mut().zip(noise).zip(colours);
        let lens = glass.light[span.clone()].iter().zip(&glass.shift[span.clone()]);
        for ((tone, (light, shift)), ((y, noise), (u, v))) in raster.tones()[span].iter().zip(lens).zip(out) {
            let [bright, blue, red, deviation] =
                self.palette[tone.darkened(u16::from(*light)).index()].parts();
            let shift = i16::from(*shift);
            (*y, *u, *v, *noise) = (bright, blue + shift, red - shift / 2, deviation);
        }
        for colour in [u, v] {
            colour[0] = colour[1];
            colour[width + 1] = colour[width];
        }
    }

    /// Smears a row over so many pixels.
    fn blur(&mut self, length: usize) {
        let Channels { y, u, v, .. } = &mut self.row;
        let width = y.len();
        for channel in [&mut y[..], &mut u[1..=width], &mut v[1..=width]] {
            smear(channel, length, &mut self.blurred);
        }
    }

    /// Adds noise, mixes neighbouring colours as a sensor with one colour a pixel does, and writes pixels.
    fn fix(&mut self, pixels: &mut [Yuv], start: usize) {
        let Channels { y, u, v, noise } = &mut self.row;
        let width = y.len();
        self.blurred.resize(width, 0);
        let [of_y, of_u, of_v] = [0, 1, 2].map(|channel| &self.noise[channel][start..start + width]);
        for ((y, noise), random) in y.iter_mut().zip(&*noise).zip(of_y) {
            *y = (*y + ((random * noise) >> 9)).clamp(0, 255);
        }
        for (colour, of_colour) in [(u, of_u), (v, of_v)] {
            let mixed = &mut self.blurred;
            let neighbours = colour.iter().zip(&colour[1..]).zip(&colour[2..]);
            for (((mixed, ((left, middle), right)), noise), random) in
                mixed.iter_mut().zip(neighbours).zip(&*noise).zip(of_colour)
            {
                *mixed = (((left + 2 * middle + right + 2) >> 2) + ((random * noise) >> 9)).clamp(0, 255);
            }
            colour[..width].copy_from_slice(mixed);
        }
        let Channels { y, u, v, .. } = &self.row;
        for (((pixel, y), u), v) in pixels.iter_mut().zip(y).zip(u).zip(v) {
            *pixel = Yuv { y: *y as u8, u: *u as u8, v: *v as u8 };
        }
    }
}

impl Channels {
    fn fit(&mut self, width: usize) {
        self.y.resize(width, 0);
        self.noise.resize(width, 0);
        self.u.resize(width + 2, 0);
        self.v.resize(width + 2, 0);
    }
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
    fn a_smeared_row_keeps_its_mean_and_spreads_an_edge_over_the_length() {
        let mut out: Vec<i16> = (0..40).map(|index| if index < 20 { 50 } else { 150 }).collect();
        smear(&mut out, 8, &mut Vec::new());
        assert_eq!(out.iter().filter(|value| (51..=149).contains(*value)).count(), 7);
        assert_eq!((out[0], out[39]), (50, 150));
        assert!(out.windows(2).all(|pair| pair[0] <= pair[1]));
    }
}
