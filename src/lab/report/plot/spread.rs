//! The values of all seeds, one row a treatment.

use plotters::element::{Circle, Rectangle};
use plotters::style::Color;
use statrs::statistics::{Data, Max, Min, OrderStatistics};

use super::sheet::{COLOURS, INK, PlotArea, PlotError, height_of_rows, line, padded, rows_with_names, svg};

/// More dots than these are thinned out evenly, so that a report stays small.
const MOST_DOTS: usize = 200;

/// Of each row its name and its values; `None` if there is no value.
pub(super) fn spread_plot(rows: &[(String, Vec<f64>)], described: &str) -> Option<String> {
    let values = padded(rows.iter().flat_map(|(_, values)| values.iter().copied()))?;
    let names: Vec<String> = rows.iter().map(|(name, _)| name.clone()).collect();
    svg(height_of_rows(rows.len()), |sheet| {
        let area = rows_with_names(sheet, &names, (values, described))?;
        let mut rows = rows.iter().enumerate().filter(|(_, (_, values))| !values.is_empty());
        rows.try_for_each(|(place, (_, values))| {
            draw_box(&area, place as f64, values)?;
            draw_dots(&area, place as f64, values)
        })
    })
}

/// From the lower to the upper quartile, with lines to the least and the greatest value.
fn draw_box(area: &PlotArea, y: f64, values: &[f64]) -> Result<(), PlotError> {
    let mut data = Data::new(values.to_vec());
    let (low, high, middle) = (data.lower_quartile(), data.upper_quartile(), data.median());
    area.draw(&Rectangle::new([(low, y - 0.32), (high, y + 0.32)], COLOURS[0].mix(0.18).filled()))?;
    line(area, [(data.min(), y), (low, y)], (INK, 1))?;
    line(area, [(high, y), (data.max(), y)], (INK, 1))?;
    line(area, [(middle, y - 0.32), (middle, y + 0.32)], (INK, 2))
}

/// One for each seed, some above and some below the middle of the row so that equal ones show.
fn draw_dots(area: &PlotArea, y: f64, values: &[f64]) -> Result<(), PlotError> {
    const GOLDEN: f64 = 0.618;
    let step = values.len().div_ceil(MOST_DOTS);
    values.iter().step_by(step).enumerate().try_for_each(|(place, value)| {
        let off = (GOLDEN * place as f64).fract() - 0.5;
        area.draw(&Circle::new((*value, y + 0.5 * off), 2, COLOURS[0].mix(0.6).filled()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_seed_is_a_dot_and_many_are_thinned_out() {
        let few = [("a".to_owned(), vec![1.0, 2.0, 2.0, 5.0]), ("b".to_owned(), Vec::new())];
        let svg = spread_plot(&few, "Goals").unwrap();
        assert_eq!(svg.matches("<circle").count(), 4);
        let many = [("a".to_owned(), (0..1000).map(f64::from).collect())];
        assert_eq!(spread_plot(&many, "Goals").unwrap().matches("<circle").count(), 200);
        assert_eq!(spread_plot(&few[1..], "Goals"), None);
    }
}
