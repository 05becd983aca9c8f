//! Means over a number, one curve for each level of what else differs.

use plotters::element::{Circle, PathElement};
use plotters::style::text_anchor::HPos;
use plotters::style::{Color, RGBColor};

use super::intervals::IntervalRow;
use super::sheet::{
    COLOURS, INK, MARGIN, PlotArea, PlotError, PlotSheet, UNDER, axes, letters, line, padded, svg,
};

/// A line through means.
#[derive(Clone, Debug)]
pub(super) struct PlotCurve {
    /// Empty if there is one curve alone.
    pub name: String,
    /// From left to right.
    pub points: Vec<(f64, IntervalRow)>,
}

/// Of the part within the axes, in pixels.
const INNER: u32 = 260;
/// Of a name in the list of curves, in pixels.
const NAME: u32 = 18;

/// Curves with what stands along the axes; `None` if there is no point.
pub(super) fn curve_plot(curves: &[PlotCurve], [x, y]: [&str; 2]) -> Option<String> {
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let xs = padded(points().map(|(x, _)| *x))?;
    let ys = padded(points().flat_map(|(_, mean)| mean.ends()))?;
    let has_names = curves.iter().any(|curve| !curve.name.is_empty());
    let above = if has_names { MARGIN + NAME * curves.len() as u32 } else { 0 };
    svg(above + INNER + UNDER + 2 * MARGIN, |sheet| {
        let (names, rest) = sheet.split_vertically(above);
        let area = axes(&rest, (xs, x), (ys, y))?;
        curves.iter().zip(COLOURS.iter().cycle()).enumerate().try_for_each(|(place, (curve, colour))| {
            if has_names {
                draw_name(&names, place, &curve.name, *colour)?;
            }
            draw(&area, curve, *colour)
        })
    })
}

fn draw_name(sheet: &PlotSheet, place: usize, name: &str, colour: RGBColor) -> Result<(), PlotError> {
    let y = (MARGIN + NAME * place as u32 + NAME / 2) as i32;
    let left = (2 * UNDER) as i32;
    sheet.draw(&PathElement::new(vec![(left - 30, y), (left - 8, y)], colour.stroke_width(3)))?;
    sheet.draw_text(name, &letters(HPos::Left, INK), (left, y))
}

fn draw(area: &PlotArea, curve: &PlotCurve, colour: RGBColor) -> Result<(), PlotError> {
    let path: Vec<(f64, f64)> = curve.points.iter().map(|(x, mean)| (*x, mean.mean)).collect();
    area.draw(&PathElement::new(path, colour.stroke_width(2)))?;
    for (x, mean) in &curve.points {
        let [low, high] = mean.ends();
        line(area, [(*x, low), (*x, high)], (colour, 1))?;
        area.draw(&Circle::new((*x, mean.mean), 3, colour.filled()))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_curve_goes_through_its_points_and_is_named() {
        let mean = |mean| IntervalRow { name: String::new(), mean, interval: None };
        let points = vec![(0.0, mean(1.0)), (0.5, mean(3.0)), (0.9, mean(2.0))];
        let curve = |name: &str| PlotCurve { name: name.into(), points: points.clone() };
        let svg = curve_plot(&[curve("paper"), curve("hardened")], ["loss", "Goals"]).unwrap();
        assert_eq!(svg.matches("<circle").count(), 6);
        for word in ["paper", "hardened", "loss", "Goals"] {
            assert!(svg.lines().any(|line| line == word), "{word} in {svg}");
        }
        assert_eq!(curve_plot(&[PlotCurve { name: String::new(), points: Vec::new() }], ["x", "y"]), None);
    }
}
