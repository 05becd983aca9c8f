//! The values of treatments with the same seeds, and their differences.

use std::collections::BTreeMap;

use super::metric::Metric;
use super::plan::ExperimentPlan;
use super::row::ExperimentRow;
use crate::lab::statistics::mean;

/// The rows of an experiment by treatment.
pub struct PairedRows<'a> {
    treatments: Vec<Vec<&'a ExperimentRow>>,
    sides: usize,
}

impl<'a> PairedRows<'a> {
    /// Sorts rows by their treatments.
    pub fn of(plan: &ExperimentPlan, rows: &'a [ExperimentRow]) -> PairedRows<'a> {
        let mut treatments = vec![Vec::new(); plan.treatments()];
        for row in rows {
            treatments[row.key.treatment].push(row);
        }
        PairedRows { treatments, sides: plan.sides() }
    }

    /// The value of a metric with each seed, if its matches are all there and whole.
    pub fn values(&self, treatment: usize, metric: Metric) -> BTreeMap<u64, f64> {
        let mut values: BTreeMap<u64, Vec<f64>> = BTreeMap::new();
        for row in &self.treatments[treatment] {
            if let Ok(result) = &row.result {
                values.entry(row.key.seed).or_default().push(result.value(metric));
            }
        }
        let whole = values.into_iter().filter(|(_, values)| values.len() == self.sides);
        whole.filter_map(|(seed, values)| Some((seed, mean(&values)?))).collect()
    }

    /// What the first of two treatments has more than the other of a metric, with each seed that both were played with.
    pub fn differences(&self, treatments: [usize; 2], metric: Metric) -> Vec<f64> {
        let [own, other] = treatments.map(|treatment| self.values(treatment, metric));
        own.iter().filter_map(|(seed, value)| Some(value - other.get(seed)?)).collect()
    }

    /// How many matches of a treatment broke off.
    pub fn broken(&self, treatment: usize) -> usize {
        self.treatments[treatment].iter().filter(|row| row.result.is_err()).count()
    }
}
