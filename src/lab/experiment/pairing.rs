//! The values of treatments with the same seeds, and their differences.

use std::collections::BTreeMap;

use super::metric::Metric;
use super::plan::ExperimentPlan;
use super::row::{ExperimentRow, MatchResult};
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

    /// How many seeds have all their matches, and whole.
    pub fn seeds(&self, treatment: usize) -> usize {
        self.whole(treatment).len()
    }

    /// The value of a metric with each seed that has all its matches: the mean of those matches that have one.
    pub fn values(&self, treatment: usize, metric: Metric) -> BTreeMap<u64, f64> {
        let of_seed = |matches: Vec<&MatchResult>| {
            mean(&matches.into_iter().filter_map(|result| result.value(metric)).collect::<Vec<_>>())
        };
        let whole = self.whole(treatment).into_iter();
        whole.filter_map(|(seed, matches)| Some((seed, of_seed(matches)?))).collect()
    }

    fn whole(&self, treatment: usize) -> BTreeMap<u64, Vec<&'a MatchResult>> {
        let mut seeds: BTreeMap<u64, Vec<&MatchResult>> = BTreeMap::new();
        for row in &self.treatments[treatment] {
            if let Ok(result) = &row.result {
                seeds.entry(row.key.seed).or_default().push(result);
            }
        }
        seeds.retain(|_, matches| matches.len() == self.sides);
        seeds
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
