//! What all plots have in common: paper, letters, colours, axes. They are drawn by `plotters` as SVG.

use std::io;
use std::ops::Range;

use plotters::backend::SVGBackend;
use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::PathElement;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontDesc, FontFamily, FontStyle, RGBColor, TRANSPARENT, TextStyle, WHITE};

/// Of letters and axes.
pub(super) const INK: RGBColor = RGBColor(0x1B, 0x23, 0x1F);
/// Of lines that lead the eye.
const GRID: RGBColor = RGBColor(0xDD, 0xE3, 0xDF);
/// Of the line at 0.
const ZERO: RGBColor = RGBColor(0x7C, 0x87, 0x81);
/// Colours that people with any colour vision tell apart (M. Okabe and K. Ito, *Color universal design*, 2008).
pub(super) const COLOURS: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xB2),
    RGBColor(0xD5, 0x5E, 0x00),
    RGBColor(0x00, 0x9E, 0x73),
    RGBColor(0xCC, 0x79, 0xA7),
    RGBColor(0xE6, 0x9F, 0x00),
    RGBColor(0x56, 0xB4, 0xE9),
    RGBColor(0x00, 0x00, 0x00),
];

/// Of a plot, in pixels.
pub(super) const WIDTH: u32 = 560;
/// Around a plot, in pixels.
pub(super) const MARGIN: u32 = 8;
/// For the numbers and the words under an axis, in pixels.
pub(super) const UNDER: u32 = 44;
/// Of letters, in pixels.
const LETTERS: f64 = 12.5;
/// Of a row with a name, in pixels.
const ROW: u32 = 26;
/// Longer names are cut.
const LONGEST_NAME: usize = 36;

/// The whole drawing.
pub(super) type PlotSheet<'text> = DrawingArea<SVGBackend<'text>, Shift>;
/// The part of it within the axes.
pub(super) type PlotArea<'text> = DrawingArea<SVGBackend<'text>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
/// Why something cannot be drawn: there is no room for it.
pub(super) type PlotError = DrawingAreaErrorKind<io::Error>;

type PlotFrame<'text> = ChartContext<'text, SVGBackend<'text>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The element `svg` of a drawing; `None` if there is no room for it.
pub(super) fn svg(height: u32, draw: impl FnOnce(&PlotSheet) -> Result<(), PlotError>) -> Option<String> {
    let mut text = String::new();
    let drawn = {
        let sheet = SVGBackend::with_string(&mut text, (WIDTH, height)).into_drawing_area();
        sheet.fill(&WHITE).and_then(|()| draw(&sheet)).and_then(|()| sheet.present())
    };
    drawn.is_ok().then_some(text)
}

/// A little more than from the least to the greatest of some values; `None` of none.
pub(super) fn padded(values: impl Iterator<Item = f64>) -> Option<Range<f64>> {
    let ends = values.filter(|value| value.is_finite()).fold(None, |ends: Option<(f64, f64)>, value| {
        Some(ends.map_or((value, value), |(low, high)| (low.min(value), high.max(value))))
    });
    let (low, high) = ends?;
    let even = if low == 0.0 { 1.0 } else { low.abs() };
    let pad = if high > low { 0.06 * (high - low) } else { 0.5 * even };
    Some(low - pad..high + pad)
}

/// A number along an axis, without the dust of sums and a negative zero.
fn tick(value: f64) -> String {
    ((value * 1e6).round() / 1e6 + 0.0).to_string()
}

/// Letters that stand so to a point.
pub(super) fn letters(horizontal: HPos, colour: RGBColor) -> TextStyle<'static> {
    // The backend divides the size by this number.
    let font = FontDesc::new(FontFamily::SansSerif, LETTERS * 1.24, FontStyle::Normal);
    font.color(&colour).pos(Pos::new(horizontal, VPos::Center))
}

/// How much room names need on the left, in pixels.
pub(super) fn room_for(names: &[String]) -> u32 {
    let longest = names.iter().map(|name| shortened(name).chars().count()).max().unwrap_or_default();
    16 + 7 * longest as u32
}

/// A name that has room beside a plot.
pub(super) fn shortened(name: &str) -> String {
    if name.chars().count() <= LONGEST_NAME {
        return name.to_owned();
    }
    name.chars().take(LONGEST_NAME - 1).chain(['…']).collect()
}

/// How high a plot with so many rows is, in pixels.
pub(super) fn height_of_rows(rows: usize) -> u32 {
    2 * MARGIN + UNDER + ROW * rows as u32
}

/// A row for each name from top to bottom, at 0, 1, 2 and so on, over an axis of numbers.
pub(super) fn rows_with_names<'text>(
    sheet: &PlotSheet<'text>,
    names: &[String],
    (values, described): (Range<f64>, &str),
) -> Result<PlotArea<'text>, PlotError> {
    let room = room_for(names);
    let rows = names.len() as f64 - 0.5..-0.5;
    let mut frame: PlotFrame<'text> = ChartBuilder::on(sheet)
        .margin(MARGIN)
        .x_label_area_size(UNDER)
        .y_label_area_size(room)
        .build_cartesian_2d(values.clone(), rows)?;
    let number = |value: &f64| tick(*value);
    let mut mesh = frame.configure_mesh();
    mesh.x_label_formatter(&number).disable_y_mesh().y_labels(0).x_labels(7).x_desc(described);
    mesh.bold_line_style(GRID).light_line_style(TRANSPARENT).axis_style(INK);
    mesh.label_style(letters(HPos::Center, INK)).axis_desc_style(letters(HPos::Center, INK)).draw()?;
    let area = frame.plotting_area().clone();
    for (place, name) in names.iter().enumerate() {
        let (_, y) = area.map_coordinate(&(values.start, place as f64));
        let x = (MARGIN + room) as i32 - 8;
        sheet.draw_text(&shortened(name), &letters(HPos::Right, INK), (x, y))?;
    }
    if values.contains(&0.0) {
        line(&area, [(0.0, -0.5), (0.0, names.len() as f64 - 0.5)], (ZERO, 1))?;
    }
    Ok(area)
}

/// Two axes of numbers.
pub(super) fn axes<'text>(
    sheet: &PlotSheet<'text>,
    (x, x_described): (Range<f64>, &str),
    (y, y_described): (Range<f64>, &str),
) -> Result<PlotArea<'text>, PlotError> {
    let mut frame: PlotFrame<'text> = ChartBuilder::on(sheet)
        .margin(MARGIN)
        .x_label_area_size(UNDER)
        .y_label_area_size(UNDER + 16)
        .build_cartesian_2d(x.clone(), y.clone())?;
    let number = |value: &f64| tick(*value);
    let mut mesh = frame.configure_mesh();
    mesh.x_label_formatter(&number).y_label_formatter(&number);
    mesh.x_labels(8).y_labels(7).x_desc(x_described).y_desc(y_described);
    mesh.bold_line_style(GRID).light_line_style(TRANSPARENT).axis_style(INK);
    mesh.label_style(letters(HPos::Center, INK)).axis_desc_style(letters(HPos::Center, INK)).draw()?;
    let area = frame.plotting_area().clone();
    if y.contains(&0.0) {
        line(&area, [(x.start, 0.0), (x.end, 0.0)], (ZERO, 1))?;
    }
    Ok(area)
}

/// A line between two points.
pub(super) fn line(
    area: &PlotArea,
    ends: [(f64, f64); 2],
    (colour, width): (RGBColor, u32),
) -> Result<(), PlotError> {
    area.draw(&PathElement::new(ends.to_vec(), colour.stroke_width(width)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_is_a_little_longer_than_its_values_and_never_empty() {
        assert_eq!(padded([1.0, 0.0, f64::NAN].into_iter()), Some(-0.06..1.06));
        assert_eq!(padded([4.0, 4.0].into_iter()), Some(2.0..6.0));
        assert_eq!(padded([0.0].into_iter()), Some(-0.5..0.5));
        assert_eq!(padded([f64::INFINITY].into_iter()), None);
    }

    #[test]
    fn numbers_along_an_axis_are_short() {
        assert_eq!([0.1 + 0.2, -1e-17, 15.0, -0.05].map(tick), ["0.3", "0", "15", "-0.05"]);
    }

    #[test]
    fn long_names_are_cut() {
        assert_eq!(shortened("claims"), "claims");
        assert_eq!(shortened(&"ä".repeat(40)), "ä".repeat(35) + "…");
    }
}
