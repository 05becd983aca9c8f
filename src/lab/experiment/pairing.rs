//! The values of treatments with the same seeds, and their differences.

use std::collections::BTreeMap;

use super::metric::Metric;
use super::plan::ExperimentPlan;
use super::row::ExperimentRow;
use crate::lab::statistics::mean;

/// What the first of two treatments has more than the other of a metric, with each seed that both were played with.
pub(super) fn differences(
    plan: &ExperimentPlan,
    rows: &[ExperimentRow],
    treatments: [usize; 2],
    metric: Metric,
) -> Vec<f64> {
    let [own, other] = treatments.map(|treatment| values_by_seed(plan, rows, treatment, metric));
    own.iter().filter_map(|(seed, value)| Some(value - other.get(seed)?)).collect()
}

/// The value of a metric with each seed, if its matches are all there and whole.
pub(super) fn values_by_seed(
    plan: &ExperimentPlan,
    rows: &[ExperimentRow],
    treatment: usize,
    metric: Metric,
) -> BTreeMap<u64, f64> {
    let mut values: BTreeMap<u64, Vec<f64>> = BTreeMap::new();
    for row in rows.iter().filter(|row| row.key.treatment == treatment) {
        if let Ok(result) = &row.result {
            values.entry(row.key.seed).or_default().push(result.value(metric));
        }
    }
    let whole = values.into_iter().filter(|(_, values)| values.len() == plan.sides());
    whole.filter_map(|(seed, values)| Some((seed, mean(&values)?))).collect()
}
