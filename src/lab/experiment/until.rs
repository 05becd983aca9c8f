//! How many seeds an experiment plays that stops when enough is known.

use super::file::UntilRule;
use super::pairing::PairedRows;
use super::plan::ExperimentPlan;
use super::row::ExperimentRow;
use crate::lab::statistics::{UntilWidth, WidthVerdict};

impl ExperimentPlan {
    /// How many of its seeds are to be played, the first ones, as far as the rows so far tell. When all their rows are there and it
    /// is still that number, the experiment is over.
    pub fn wanted_seeds(&self, rows: &[ExperimentRow]) -> u32 {
        let budget = self.file.blocks.number;
        let Some(UntilRule::Width { metric, confidence, width }) = self.file.until else { return budget };
        let rule = UntilWidth { confidence, width, budget: budget as usize };
        let rows = PairedRows::of(self, rows);
        let of_treatment = |treatment: usize| {
            let values: Vec<f64> = rows.values(treatment, metric).into_values().collect();
            let wanted = match rule.look(&values) {
                WidthVerdict::Reached { matches, .. } => matches,
                WidthVerdict::More { next_look, .. } => next_look,
                WidthVerdict::BudgetSpent { .. } => budget as usize,
            };
            // A seed whose match broke off is made up for by another.
            u32::try_from(wanted + rows.broken(treatment)).unwrap_or(budget)
        };
        (0..self.treatments()).map(of_treatment).max().map_or(budget, |wanted| wanted.min(budget))
    }
}
