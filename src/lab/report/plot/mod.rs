//! Plots of a metric as SVG: means with intervals, the values of all seeds, curves over a number, surfaces over two.

mod curves;
mod heat_map;
mod intervals;
mod sheet;
mod spread;

use self::curves::{PlotCurve, curve_plot};
use self::heat_map::{HeatMap, heat_map_plot};
use self::intervals::{IntervalRow, interval_plot};
use self::spread::spread_plot;
use super::document::ReportPlot;
use super::evaluated::Evaluated;
use super::metric_title::with_unit;
use crate::lab::experiment::{ExperimentFile, Factor, FactorLevels, Metric};

/// What a plot shows of a treatment, besides its name.
fn mean_of(of: &Evaluated, metric: Metric, treatment: usize) -> Option<IntervalRow> {
    let figure = of.summary.treatments[treatment].figures.get(&metric)?;
    let levels = of.experiment.level_names(treatment);
    Some(IntervalRow { name: levels.join(", "), mean: figure.mean?, interval: figure.interval })
}

/// The plots that suit the factors of an experiment.
pub(super) fn plots(of: &Evaluated, metric: Metric) -> Vec<ReportPlot> {
    let file = &of.experiment.file;
    let numeric: Vec<usize> =
        (0..file.factors.len()).filter(|place| is_numeric(&file.factors[*place])).collect();
    let values = with_unit(metric);
    let means = match numeric[..] {
        [] => vec![intervals(of, metric, &values)],
        [factor] => vec![curves(of, metric, factor)],
        [x, y, ..] => surfaces(of, metric, [x, y]),
    };
    let spread = (0..file.treatments()).map(|treatment| {
        let seeds = of.rows.values(treatment, metric).into_values().collect();
        (of.experiment.level_names(treatment).join(", "), seeds)
    });
    let spread = spread_plot(&spread.collect::<Vec<_>>(), &values).map(|svg| ReportPlot {
        caption:
            "All seeds as dots; the box holds the middle half of them, the line is the one in the middle."
                .into(),
        svg,
    });
    means.into_iter().chain([spread]).flatten().collect()
}

fn is_numeric(factor: &Factor) -> bool {
    matches!(factor.levels, FactorLevels::Values { .. }) && factor.levels.len() > 1
}

fn numbers(factor: &Factor) -> &[f64] {
    match &factor.levels {
        FactorLevels::Values { values, .. } => values,
        FactorLevels::Named(_) => &[],
    }
}

fn intervals(of: &Evaluated, metric: Metric, values: &str) -> Option<ReportPlot> {
    let treatments = 0..of.experiment.treatments();
    let rows: Vec<IntervalRow> = treatments.filter_map(|treatment| mean_of(of, metric, treatment)).collect();
    let caption = "The mean of each treatment with its interval of 95 %.".into();
    interval_plot(&rows, values).map(|svg| ReportPlot { caption, svg })
}

fn curves(of: &Evaluated, metric: Metric, factor: usize) -> Option<ReportPlot> {
    let file = &of.experiment.file;
    let numbers = numbers(&file.factors[factor]);
    let curve = |base: usize| {
        let mut points: Vec<(f64, IntervalRow)> = (numbers.iter().enumerate())
            .filter_map(|(place, x)| {
                Some((*x, mean_of(of, metric, with_place(file, base, (factor, place)))?))
            })
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        PlotCurve { name: other_levels(of, base, &[factor]), points }
    };
    let curves: Vec<PlotCurve> = bases(file, &[factor]).map(curve).collect();
    let name = &file.factors[factor].name;
    let caption = format!("The mean with its interval of 95 %, over {name}.");
    curve_plot(&curves, [name, &with_unit(metric)]).map(|svg| ReportPlot { caption, svg })
}

fn surfaces(of: &Evaluated, metric: Metric, [x, y]: [usize; 2]) -> Vec<Option<ReportPlot>> {
    let file = &of.experiment.file;
    let surface = |base: usize| {
        let cell = |column: usize, row: usize| {
            let treatment = with_place(file, with_place(file, base, (x, column)), (y, row));
            mean_of(of, metric, treatment).map(|mean| mean.mean)
        };
        let [columns, rows] = [x, y].map(|factor| file.factors[factor].levels.names());
        let line = |row: usize| (0..columns.len()).map(|column| cell(column, row)).collect();
        let values = (0..rows.len()).map(line).collect();
        let map = HeatMap { columns, rows, values };
        let names = [x, y].map(|factor| file.factors[factor].name.as_str());
        let others = other_levels(of, base, &[x, y]);
        let among = if others.is_empty() { String::new() } else { format!(" ({others})") };
        let caption = format!("{}: the mean by {} and {}{among}.", with_unit(metric), names[0], names[1]);
        heat_map_plot(&map, names).map(|svg| ReportPlot { caption, svg })
    };
    bases(file, &[x, y]).map(surface).collect()
}

/// The treatments that have the first levels of these factors.
fn bases<'a>(file: &'a ExperimentFile, factors: &'a [usize]) -> impl Iterator<Item = usize> + 'a {
    (0..file.treatments()).filter(|treatment| {
        let places = file.places(*treatment);
        factors.iter().all(|factor| places[*factor] == 0)
    })
}

fn with_place(file: &ExperimentFile, treatment: usize, (factor, place): (usize, usize)) -> usize {
    let mut places = file.places(treatment);
    places[factor] = place;
    file.treatment_at(&places)
}

/// The levels of a treatment in all other factors.
fn other_levels(of: &Evaluated, treatment: usize, factors: &[usize]) -> String {
    let levels = of.experiment.level_names(treatment).into_iter().enumerate();
    let others = levels.filter(|(place, _)| !factors.contains(place)).map(|(_, level)| level);
    others.collect::<Vec<_>>().join(", ")
}
