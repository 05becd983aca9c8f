//! Means with their intervals, one row a treatment.

use plotters::element::Circle;
use plotters::style::Color;

use super::sheet::{COLOURS, PlotArea, PlotError, height_of_rows, line, padded, rows_with_names, svg};
use crate::lab::statistics::Interval;

/// The mean of a treatment.
#[derive(Clone, Debug)]
pub(super) struct IntervalRow {
    /// That of the treatment.
    pub name: String,
    pub mean: f64,
    pub interval: Option<Interval>,
}

impl IntervalRow {
    /// From where to where it reaches: its interval and itself.
    pub fn ends(&self) -> [f64; 2] {
        let interval = self.interval.unwrap_or(Interval { low: self.mean, high: self.mean });
        [interval.low.min(self.mean), interval.high.max(self.mean)]
    }
}

/// `None` of no rows.
pub(super) fn interval_plot(rows: &[IntervalRow], described: &str) -> Option<String> {
    let values = padded(rows.iter().flat_map(IntervalRow::ends))?;
    let names: Vec<String> = rows.iter().map(|row| row.name.clone()).collect();
    svg(height_of_rows(rows.len()), |sheet| {
        let area = rows_with_names(sheet, &names, (values, described))?;
        rows.iter().enumerate().try_for_each(|(place, row)| draw(&area, place as f64, row))
    })
}

fn draw(area: &PlotArea, y: f64, row: &IntervalRow) -> Result<(), PlotError> {
    let [low, high] = row.ends();
    let colour = COLOURS[0];
    line(area, [(low, y), (high, y)], (colour, 2))?;
    for end in [low, high] {
        line(area, [(end, y - 0.18), (end, y + 0.18)], (colour, 2))?;
    }
    area.draw(&Circle::new((row.mean, y), 4, colour.filled()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_treatment_has_its_name_its_dot_and_its_interval() {
        let interval = Some(Interval { low: -1.0, high: 2.0 });
        let rows = ["off <1>", "on"].map(|name| IntervalRow { name: name.into(), mean: 0.5, interval });
        let svg = interval_plot(&rows, "Goals").unwrap();
        assert_eq!(svg.matches("<circle").count(), 2);
        for word in ["off &lt;1&gt;", "on", "Goals"] {
            assert!(svg.lines().any(|line| line == word), "{word} in {svg}");
        }
        assert_eq!(interval_plot(&[], "Goals"), None);
    }
}
