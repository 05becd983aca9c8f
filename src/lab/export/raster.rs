//! A drawing as pixels, filled in software. Text has no font: digits and the colon are strokes.

use std::f32::consts::TAU;

use bevy::math::Vec2;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash, Transform,
};

use super::figure::{Drawing, Figure, Tint};
use crate::geometry::unit;

/// Draws figures on a picture of a drawing's extent.
pub struct Painter {
    picture: Pixmap,
    to_pixels: Transform,
    scale: f32,
}

impl Painter {
    /// A picture that is so many pixels wide, with the drawing on it; none if it has no pixels.
    pub fn new(drawing: &Drawing, width: u32) -> Option<Painter> {
        let scale = width as f32 / (2.0 * drawing.half.x);
        let height = (2.0 * drawing.half.y * scale).round() as u32;
        let to_pixels = Transform::from_row(scale, 0.0, 0.0, -scale, width as f32 / 2.0, height as f32 / 2.0);
        let mut painter = Painter { picture: Pixmap::new(width, height)?, to_pixels, scale };
        painter.picture.fill(colour(Tint::solid(drawing.ground)));
        painter.draw(&drawing.figures);
        Some(painter)
    }

    /// A picture that begins as this one does.
    pub fn copied(&self) -> Painter {
        Painter { picture: self.picture.clone(), ..*self }
    }

    /// Draws over what is there.
    pub fn draw(&mut self, figures: &[Figure]) {
        for figure in figures {
            self.draw_figure(figure);
        }
    }

    /// The pixels, row by row: red, green, blue.
    pub fn pixels(&self) -> impl Iterator<Item = [u8; 3]> + '_ {
        self.picture.pixels().iter().map(|pixel| [pixel.red(), pixel.green(), pixel.blue()])
    }

    /// Width and height.
    pub fn size(&self) -> [u32; 2] {
        [self.picture.width(), self.picture.height()]
    }

    fn draw_figure(&mut self, figure: &Figure) {
        match figure {
            Figure::Polygon { points, fill } => self.fill(through(points, true), *fill),
            Figure::Disc { centre, radius, fill } => self.fill(round(*centre, *radius), *fill),
            Figure::Line { points, closed, width, tint, dash } => {
                let join = if *closed { LineJoin::Miter } else { LineJoin::Round };
                self.stroke(through(points, *closed), *tint, self.pen(*width, join, *dash));
            }
            Figure::Circle { centre, radius, width, tint, dash } => {
                self.stroke(round(*centre, *radius), *tint, self.pen(*width, LineJoin::Round, *dash));
            }
            Figure::Text { at, height, text, tint } => self.write(*at, *height, text, *tint),
        }
    }

    /// A pen that is never thinner than a pixel.
    fn pen(&self, width: f32, line_join: LineJoin, dash: Option<f32>) -> Stroke {
        let dash = dash.and_then(|dash| StrokeDash::new(vec![dash, dash], 0.0));
        Stroke { width: width.max(1.0 / self.scale), line_join, dash, ..Stroke::default() }
    }

    fn fill(&mut self, path: Option<Path>, fill: Tint) {
        let Some(path) = path else { return };
        self.picture.fill_path(&path, &paint(fill), FillRule::Winding, self.to_pixels, None);
    }

    fn stroke(&mut self, path: Option<Path>, tint: Tint, stroke: Stroke) {
        let Some(path) = path else { return };
        self.picture.stroke_path(&path, &paint(tint), &stroke, self.to_pixels, None);
    }

    fn write(&mut self, at: Vec2, height: f32, text: &str, tint: Tint) {
        let (step, width) = (ADVANCE * height, 0.14 * height);
        let first = at - Vec2::X * (step * (text.chars().count().max(1) - 1) as f32 / 2.0);
        let stroke = Stroke {
            width: width.max(1.0 / self.scale),
            line_cap: LineCap::Round,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        for (place, sign) in text.chars().enumerate() {
            let middle = first + Vec2::X * (step * place as f32);
            for line in strokes(sign) {
                let points: Vec<Vec2> =
                    line.iter().map(|(x, y)| middle + height * Vec2::new(*x, *y)).collect();
                self.stroke(through(&points, false), tint, stroke.clone());
            }
        }
    }
}

/// From one sign to the next, in heights of a digit.
const ADVANCE: f32 = 0.78;

/// The strokes of a sign around its middle, in heights of a digit; nothing for signs that nobody writes.
fn strokes(sign: char) -> Vec<Vec<(f32, f32)>> {
    let arc = |cx: f32, cy: f32, rx: f32, ry: f32, from: f32, to: f32| -> Vec<(f32, f32)> {
        let at = |step: u8| unit(TAU * (from + (to - from) * f32::from(step) / 16.0));
        (0..=16).map(|step| (cx + rx * at(step).x, cy + ry * at(step).y)).collect()
    };
    match sign {
        '0' => vec![arc(0.0, 0.0, 0.27, 0.5, 0.0, 1.0)],
        '1' => vec![vec![(-0.16, 0.32), (0.06, 0.5), (0.06, -0.5)]],
        '2' => {
            let mut bow = arc(0.0, 0.22, 0.26, 0.28, 0.45, -0.1);
            bow.extend([(-0.27, -0.5), (0.28, -0.5)]);
            vec![bow]
        }
        '3' => vec![arc(-0.02, 0.25, 0.25, 0.25, 0.42, -0.25), arc(-0.02, -0.25, 0.28, 0.25, 0.25, -0.42)],
        '4' => vec![vec![(0.12, -0.5), (0.12, 0.5), (-0.28, -0.2), (0.29, -0.2)]],
        '5' => {
            let mut top = vec![(0.24, 0.5), (-0.18, 0.5), (-0.22, 0.06)];
            top.extend(arc(-0.01, -0.19, 0.27, 0.31, 0.35, -0.4));
            vec![top]
        }
        '6' => vec![arc(0.0, -0.2, 0.26, 0.3, 0.0, 1.0), vec![(-0.26, -0.18), (-0.16, 0.22), (0.14, 0.5)]],
        '7' => vec![vec![(-0.27, 0.5), (0.28, 0.5), (-0.06, -0.5)]],
        '8' => vec![arc(0.0, 0.25, 0.22, 0.25, 0.0, 1.0), arc(0.0, -0.25, 0.27, 0.25, 0.0, 1.0)],
        '9' => vec![arc(0.0, 0.2, 0.26, 0.3, 0.0, 1.0), vec![(0.26, 0.18), (0.16, -0.22), (-0.14, -0.5)]],
        ':' => vec![vec![(0.0, 0.22), (0.0, 0.2)], vec![(0.0, -0.2), (0.0, -0.22)]],
        _ => Vec::new(),
    }
}

fn through(points: &[Vec2], closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    let (first, rest) = points.split_first()?;
    path.move_to(first.x, first.y);
    for point in rest {
        path.line_to(point.x, point.y);
    }
    if closed {
        path.close();
    }
    path.finish()
}

fn round(centre: Vec2, radius: f32) -> Option<Path> {
    PathBuilder::from_circle(centre.x, centre.y, radius)
}

fn colour(tint: Tint) -> Color {
    let [_, red, green, blue] = tint.colour.to_be_bytes();
    Color::from_rgba8(red, green, blue, (255.0 * tint.opacity).round() as u8)
}

fn paint(tint: Tint) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color(colour(tint));
    paint
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawing(figures: Vec<Figure>) -> Drawing {
        Drawing { half: Vec2::new(2.0, 1.0), ground: 0x36_3D_3A, figures }
    }

    fn pixel(painter: &Painter, x: u32, y: u32) -> [u8; 3] {
        painter.pixels().nth((y * painter.size()[0] + x) as usize).expect("it is in the picture")
    }

    #[test]
    fn a_figure_lies_where_it_is_with_north_above() {
        let disc = Figure::Disc { centre: Vec2::new(1.0, 0.5), radius: 0.2, fill: Tint::solid(0xFF_8A_1F) };
        let painter = Painter::new(&drawing(vec![disc]), 400).expect("it has pixels");
        assert_eq!(painter.size(), [400, 200]);
        assert_eq!(pixel(&painter, 300, 50), [0xFF, 0x8A, 0x1F]);
        for (x, y) in [(300, 150), (100, 50), (200, 100)] {
            assert_eq!(pixel(&painter, x, y), [0x36, 0x3D, 0x3A]);
        }
    }

    #[test]
    fn every_digit_looks_different() {
        let pictures: Vec<Vec<[u8; 3]>> = ('0'..=':')
            .map(|sign| {
                let tint = Tint::solid(0xFF_FF_FF);
                let text = Figure::Text { at: Vec2::ZERO, height: 1.0, text: sign.into(), tint };
                Painter::new(&drawing(vec![text]), 80).expect("it has pixels").pixels().collect()
            })
            .collect();
        let blank: Vec<[u8; 3]> =
            Painter::new(&drawing(Vec::new()), 80).expect("it has pixels").pixels().collect();
        for (number, picture) in pictures.iter().enumerate() {
            assert_ne!(*picture, blank);
            assert!(pictures[..number].iter().all(|other| other != picture), "{number}");
        }
    }
}
