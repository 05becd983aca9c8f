//! Means over two numbers, as colours.

use std::ops::Range;

use plotters::chart::ChartBuilder;
use plotters::element::Rectangle;
use plotters::style::colors::colormaps::ViridisRGB;
use plotters::style::text_anchor::HPos;
use plotters::style::{Color, RGBColor, WHITE};

use super::sheet::{
    INK, MARGIN, PlotArea, PlotError, PlotSheet, UNDER, letters, padded, room_for, shortened, svg,
};

/// A mean for each pair of levels.
#[derive(Clone, Debug)]
pub(super) struct HeatMap {
    /// From left to right.
    pub columns: Vec<String>,
    /// From bottom to top.
    pub rows: Vec<String>,
    /// By row and column.
    pub values: Vec<Vec<Option<f64>>>,
}

/// Of a cell, in pixels.
const CELL: u32 = 40;

/// A map with the names of what grows to the right and upwards; `None` if there is no value.
pub(super) fn heat_map_plot(map: &HeatMap, [x, y]: [&str; 2]) -> Option<String> {
    let scale = padded(map.values.iter().flatten().filter_map(|value| *value))?;
    let height = 2 * MARGIN + UNDER + CELL * map.rows.len() as u32;
    svg(height, |sheet| {
        let names: Vec<String> = map.rows.iter().map(|row| format!("{y} {row}")).collect();
        let room = room_for(&names);
        let [columns, rows] = [&map.columns, &map.rows].map(|names| 0.0..names.len() as f64);
        let frame = ChartBuilder::on(sheet)
            .margin(MARGIN)
            .x_label_area_size(UNDER)
            .y_label_area_size(room)
            .build_cartesian_2d(columns, rows)?;
        let area = frame.plotting_area();
        draw_cells((sheet, area), &map.values, scale)?;
        for (row, name) in names.iter().enumerate() {
            let (_, middle) = area.map_coordinate(&(0.0, row as f64 + 0.5));
            let at = ((MARGIN + room) as i32 - 8, middle);
            sheet.draw_text(&shortened(name), &letters(HPos::Right, INK), at)?;
        }
        let (_, under) = area.map_coordinate(&(0.0, 0.0));
        for (column, name) in map.columns.iter().enumerate() {
            let (middle, _) = area.map_coordinate(&(column as f64 + 0.5, 0.0));
            sheet.draw_text(&shortened(name), &letters(HPos::Center, INK), (middle, under + 12))?;
        }
        let (middle, _) = area.map_coordinate(&(map.columns.len() as f64 / 2.0, 0.0));
        sheet.draw_text(x, &letters(HPos::Center, INK), (middle, under + 32))
    })
}

/// Each with its number.
fn draw_cells(
    (sheet, area): (&PlotSheet, &PlotArea),
    values: &[Vec<Option<f64>>],
    scale: Range<f64>,
) -> Result<(), PlotError> {
    for (row, values) in values.iter().enumerate() {
        for (column, value) in values.iter().enumerate() {
            let Some(value) = value else { continue };
            let (x, y) = (column as f64, row as f64);
            let colour = ViridisRGB::get_color_normalized(*value, scale.start, scale.end);
            area.draw(&Rectangle::new([(x, y), (x + 1.0, y + 1.0)], colour.filled()))?;
            let middle = area.map_coordinate(&(x + 0.5, y + 0.5));
            let number = format!("{value:.3}");
            sheet.draw_text(&number, &letters(HPos::Center, readable_on(colour)), middle)?;
        }
    }
    Ok(())
}

/// White on dark colours, dark on bright ones.
fn readable_on(RGBColor(red, green, blue): RGBColor) -> RGBColor {
    let brightness = 299 * u32::from(red) + 587 * u32::from(green) + 114 * u32::from(blue);
    if brightness > 140_000 { INK } else { WHITE }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_known_mean_is_a_cell_with_its_number() {
        let map = HeatMap {
            columns: vec!["0".into(), "0.5".into()],
            rows: vec!["0.2".into(), "0.4".into()],
            values: vec![vec![Some(1.0), Some(2.0)], vec![Some(3.0), None]],
        };
        let svg = heat_map_plot(&map, ["loss", "noise"]).unwrap();
        for word in ["1.000", "2.000", "3.000", "noise 0.2", "noise 0.4", "0.5", "loss"] {
            assert_eq!(svg.lines().filter(|line| *line == word).count(), 1, "{word} in {svg}");
        }
        // The paper is one, too.
        assert_eq!(svg.matches("<rect").count(), 4);
        assert_eq!(heat_map_plot(&HeatMap { values: vec![vec![None; 2]; 2], ..map }, ["x", "y"]), None);
    }

    #[test]
    fn numbers_can_be_read_on_every_colour() {
        assert_eq!(readable_on(RGBColor(253, 231, 37)), INK);
        assert_eq!(readable_on(RGBColor(68, 1, 84)), WHITE);
    }
}
