//! A stretch of a match as a GIF that plays for ever. Colours are chosen once for all frames, and a frame holds only what has changed.

use std::collections::BTreeMap;

use color_quant::NeuQuant;
use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};

use super::drawing::{moment_figures, pitch_drawing, score_figures};
use super::figure::Drawing;
use super::moment::MatchMoment;
use super::raster::Painter;
use super::trails::Trails;
use crate::game::MatchPlan;

/// Draws a stretch of a match, frame by frame.
pub struct GifRecorder {
    from: u64,
    until: u64,
    /// Seconds of a tick.
    dt: f32,
    pitch: Drawing,
    ball_radius: f32,
    ground: Painter,
    trails: Trails,
    film: FilmWriter,
}

/// Width of the picture in pixels.
const WIDTH: u32 = 640;
/// Ticks between two frames: twenty frames a second.
const EVERY: u64 = 3;
/// How far back trails go, ticks.
const TRAIL: u64 = 150;
/// How long the last frame stays, hundredths of a second.
const LAST: u16 = 150;

impl GifRecorder {
    /// From one tick until another.
    pub fn new(plan: &MatchPlan, (from, until): (u64, u64), dt: f32) -> Option<GifRecorder> {
        let pitch = pitch_drawing(&plan.pitch);
        let ground = Painter::new(&pitch, WIDTH)?;
        let (trails, film) = (Trails::new(TRAIL), FilmWriter::default());
        Some(GifRecorder { from, until, dt, pitch, ball_radius: plan.ball.radius, ground, trails, film })
    }

    /// Takes note of a moment; those outside of the stretch leave no frame.
    ///
    /// # Errors
    /// If a frame cannot be written.
    pub fn observe(&mut self, moment: &MatchMoment) -> Result<(), EncodingError> {
        self.trails.observe(moment);
        let is_due = moment.tick >= self.from && (moment.tick - self.from).is_multiple_of(EVERY);
        if !is_due || moment.tick > self.until {
            return Ok(());
        }
        let mut painter = self.ground.copied();
        painter.draw(&moment_figures(moment, &self.trails, self.ball_radius, false));
        painter.draw(&score_figures(moment, &self.pitch));
        let delay = (100.0 * self.dt * EVERY as f32).round() as u16;
        self.film.show(&painter, delay)
    }

    /// The whole file, and its number of frames.
    ///
    /// # Errors
    /// If the match was over before the stretch began, or the file cannot be written.
    pub fn finish(self) -> Result<(Vec<u8>, usize), EncodingError> {
        self.film.finish()
    }
}

/// Frames as they are written.
#[derive(Default)]
struct FilmWriter {
    encoder: Option<Encoder<Vec<u8>>>,
    colours: Option<Colours>,
    /// Shown as the last one, and not written yet, since how long it is shown is not known.
    waiting: Option<Frame<'static>>,
    shown: Vec<u8>,
    frames: usize,
}

/// The colour of pixels that stay as they are.
const UNCHANGED: u8 = 255;

impl FilmWriter {
    fn show(&mut self, painter: &Painter, delay: u16) -> Result<(), EncodingError> {
        let [width, height] = painter.size().map(|pixels| pixels as u16);
        let colours = self.colours.get_or_insert_with(|| Colours::of(painter));
        let pixels: Vec<u8> = painter.pixels().map(|pixel| colours.number(pixel)).collect();
        if self.encoder.is_none() {
            let mut encoder = Encoder::new(Vec::new(), width, height, &colours.palette)?;
            encoder.set_repeat(Repeat::Infinite)?;
            self.encoder = Some(encoder);
        }
        self.write_waiting()?;
        let mut frame = changed(&self.shown, &pixels, width, height);
        frame.delay = delay;
        self.waiting = Some(frame);
        self.shown = pixels;
        self.frames += 1;
        Ok(())
    }

    fn write_waiting(&mut self) -> Result<(), EncodingError> {
        match (&mut self.encoder, self.waiting.take()) {
            (Some(encoder), Some(frame)) => encoder.write_frame(&frame),
            _ => Ok(()),
        }
    }

    fn finish(mut self) -> Result<(Vec<u8>, usize), EncodingError> {
        if let Some(frame) = &mut self.waiting {
            frame.delay = LAST;
        }
        self.write_waiting()?;
        let bytes = self.encoder.map_or(Ok(Vec::new()), Encoder::into_inner)?;
        Ok((bytes, self.frames))
    }
}

/// The smallest frame that makes of what is shown what is to be seen.
fn changed(shown: &[u8], pixels: &[u8], width: u16, height: u16) -> Frame<'static> {
    let is_new = |place: usize| shown.get(place) != Some(&pixels[place]);
    let wide = usize::from(width);
    let places = || (0..pixels.len()).filter(|place| is_new(*place));
    // A frame has a pixel at least.
    let span = |of: fn(usize, usize) -> usize| {
        let all = places().map(|place| of(place, wide));
        let (least, most) = all.fold((usize::MAX, 0), |(least, most), at| (least.min(at), most.max(at)));
        if least > most { (0, 0) } else { (least, most) }
    };
    let (left, right) = span(|place, wide| place % wide);
    let (top, bottom) = span(|place, wide| place / wide);
    let buffer: Vec<u8> = (top..=bottom)
        .flat_map(|y| (left..=right).map(move |x| y * wide + x))
        .map(|place| if is_new(place) { pixels[place] } else { UNCHANGED })
        .collect();
    debug_assert!(bottom < usize::from(height));
    Frame {
        left: left as u16,
        top: top as u16,
        width: (right - left + 1) as u16,
        height: (bottom - top + 1) as u16,
        transparent: Some(UNCHANGED),
        dispose: DisposalMethod::Keep,
        buffer: buffer.into(),
        ..Frame::default()
    }
}

/// The colours of a film, chosen from its first frame, in which small things count nearly as much as large ones.
struct Colours {
    quantiser: NeuQuant,
    palette: Vec<u8>,
    known: BTreeMap<[u8; 3], u8>,
}

impl Colours {
    /// The most pixels of a colour that count.
    const MOST: usize = 60;

    fn of(painter: &Painter) -> Colours {
        let mut counts: BTreeMap<[u8; 3], usize> = BTreeMap::new();
        for pixel in painter.pixels() {
            *counts.entry(pixel).or_default() += 1;
        }
        let samples: Vec<u8> = (counts.into_iter())
            .flat_map(|([red, green, blue], count)| {
                std::iter::repeat_n([red, green, blue, 255], count.min(Colours::MOST))
            })
            .flatten()
            .collect();
        let quantiser = NeuQuant::new(1, usize::from(UNCHANGED), &samples);
        let mut palette = quantiser.color_map_rgb();
        palette.resize(3 * 256, 0);
        Colours { quantiser, palette, known: BTreeMap::new() }
    }

    fn number(&mut self, [red, green, blue]: [u8; 3]) -> u8 {
        let quantiser = &self.quantiser;
        let find = || quantiser.index_of(&[red, green, blue, 255]) as u8;
        *self.known.entry([red, green, blue]).or_insert_with(find)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vec2;
    use crate::lab::export::figure::{Figure, Tint};

    #[test]
    fn a_frame_holds_what_has_changed_and_no_more() {
        let before = [1, 1, 1, 1, 1, 1];
        let frame = changed(&before, &[1, 2, 1, 1, 1, 3], 3, 2);
        assert_eq!((frame.left, frame.top, frame.width, frame.height), (1, 0, 2, 2));
        assert_eq!(frame.buffer[..], [2, UNCHANGED, UNCHANGED, 3]);
        let frame = changed(&before, &before, 3, 2);
        assert_eq!((frame.width, frame.height, frame.buffer[0]), (1, 1, UNCHANGED));
        assert_eq!(changed(&[], &before, 3, 2).buffer[..], before);
    }

    #[test]
    fn a_film_reads_back_as_what_was_drawn() {
        let disc = |x: f32| Figure::Disc { centre: Vec2::X * x, radius: 0.3, fill: Tint::solid(0xFF_8A_1F) };
        let drawing = Drawing { half: Vec2::new(2.0, 1.0), ground: 0x2E_7D_46, figures: vec![disc(0.0)] };
        let painter = Painter::new(&drawing, 80).expect("it has pixels");
        let mut film = FilmWriter::default();
        film.show(&painter, 5).expect("memory takes it");
        let mut moved = painter.copied();
        moved.draw(&[disc(1.0)]);
        film.show(&moved, 5).expect("memory takes it");
        let (bytes, frames) = film.finish().expect("memory takes it");
        assert_eq!(frames, 2);
        let mut reader = gif::DecodeOptions::new();
        reader.set_color_output(gif::ColorOutput::RGBA);
        let mut reader = reader.read_info(&bytes[..]).expect("it is a GIF");
        assert_eq!((reader.width(), reader.height()), (80, 40));
        let first = reader.read_next_frame().expect("it is sound").expect("there is one").clone();
        assert_eq!((first.delay, first.width), (5, 80));
        let at = |x: usize, y: usize| &first.buffer[4 * (y * 80 + x)..][..3];
        let near = |a: &[u8], b: [u8; 3]| a.iter().zip(b).all(|(a, b)| a.abs_diff(b) < 6);
        assert!(near(at(40, 20), [0xFF, 0x8A, 0x1F]), "{:?}", at(40, 20));
        assert!(near(at(4, 4), [0x2E, 0x7D, 0x46]), "{:?}", at(4, 4));
        let second = reader.read_next_frame().expect("it is sound").expect("there is one");
        assert_eq!(second.delay, LAST);
        assert!(second.left > 40, "only the new disc is written, not from {}", second.left);
        assert!(reader.read_next_frame().expect("it is sound").is_none());
    }
}
