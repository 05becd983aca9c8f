//! An experiment with what its rows say.

use crate::lab::experiment::{ExperimentPlan, ExperimentRow, ExperimentSummary, PairedRows};

/// An experiment that is reported.
#[derive(Clone, Debug)]
pub struct ReportedExperiment {
    /// What was asked, as it can be played again.
    pub plan: ExperimentPlan,
    /// What was played.
    pub rows: Vec<ExperimentRow>,
    /// What plays it again.
    pub command: String,
}

/// A reported experiment with its rows by treatment and their summary.
pub(super) struct Evaluated<'a> {
    pub experiment: &'a ExperimentPlan,
    pub played: &'a [ExperimentRow],
    pub command: &'a str,
    pub rows: PairedRows<'a>,
    pub summary: ExperimentSummary,
}

impl Evaluated<'_> {
    pub fn of(experiment: &ReportedExperiment) -> Evaluated<'_> {
        let ReportedExperiment { plan, rows, command } = experiment;
        Evaluated {
            experiment: plan,
            played: rows,
            command,
            rows: PairedRows::of(plan, rows),
            summary: ExperimentSummary::of(plan, rows),
        }
    }
}
