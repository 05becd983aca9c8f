//! What the rows of an experiment say: each treatment's figures with intervals, and what differs from the first treatment.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

use serde::Serialize;

use super::claim::{JudgedClaim, judge_claims};
use super::figure_words::{MeanWithInterval, probability};
use super::metric::Metric;
use super::pairing::PairedRows;
use super::plan::ExperimentPlan;
use super::row::ExperimentRow;
use crate::lab::statistics::{Interval, PairedDifference, compare_pairs, mean, mean_interval};
use crate::rng::{DEFAULT_SEED, Seed};

/// What the rows of an experiment say about the metrics that its design names.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExperimentSummary {
    /// What was asked.
    pub name: String,
    /// The share of cases in which an interval holds what it is of.
    pub confidence: f64,
    /// In their order.
    pub treatments: Vec<TreatmentSummary>,
    /// What is claimed of them.
    pub claims: Vec<JudgedClaim>,
    /// Matches that broke off.
    pub broken: usize,
}

/// What the rows of a treatment say.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TreatmentSummary {
    /// The level of each factor, by the factor's name.
    pub levels: Vec<(String, String)>,
    /// The seeds that it was played with, on both sides if sides are swapped.
    pub seeds: usize,
    /// By metric.
    pub figures: BTreeMap<Metric, FigureSummary>,
}

/// What is known of a metric in a treatment. A value is that of a seed: the mean of both sides, if sides are swapped.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureSummary {
    /// The mean.
    pub mean: Option<f64>,
    /// Its interval, by Student.
    pub interval: Option<Interval>,
    /// What this treatment has more than the first one with the same seeds.
    pub against_first: Option<PairedDifference>,
}

/// Of the intervals of a summary.
pub const CONFIDENCE: f64 = 0.95;

impl ExperimentSummary {
    /// Sums rows up; those of seeds that were not played on both sides do not count.
    pub fn of(plan: &ExperimentPlan, rows: &[ExperimentRow]) -> ExperimentSummary {
        let rows = PairedRows::of(plan, rows);
        let treatments = (0..plan.treatments()).map(|treatment| treatment_summary(plan, &rows, treatment));
        ExperimentSummary {
            name: plan.file.name.clone(),
            confidence: CONFIDENCE,
            treatments: treatments.collect(),
            claims: judge_claims(plan, &rows, CONFIDENCE),
            broken: (0..plan.treatments()).map(|treatment| rows.broken(treatment)).sum(),
        }
    }
}

fn treatment_summary(plan: &ExperimentPlan, rows: &PairedRows, treatment: usize) -> TreatmentSummary {
    let names = plan.file.factors.iter().map(|factor| factor.name.clone());
    let figure = |metric: &Metric| {
        let values: Vec<f64> = rows.values(treatment, *metric).into_values().collect();
        let against_first = (treatment > 0).then(|| {
            let pairs = rows.differences([treatment, 0], *metric);
            compare_pairs(&pairs, CONFIDENCE, Seed(DEFAULT_SEED))
        });
        let interval = mean_interval(&values, CONFIDENCE);
        (*metric, FigureSummary { mean: mean(&values), interval, against_first: against_first.flatten() })
    };
    TreatmentSummary {
        levels: names.zip(plan.level_names(treatment)).collect(),
        seeds: rows.seeds(treatment),
        figures: plan.file.metrics.iter().map(figure).collect(),
    }
}

impl Display for ExperimentSummary {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.name)?;
        self.treatments.iter().try_for_each(|treatment| write!(f, "{treatment}"))?;
        for JudgedClaim { claim, verdict, .. } in &self.claims {
            writeln!(f, "{}: {}", verdict.words(), claim.says)?;
        }
        if self.broken > 0 {
            writeln!(f, "{} matches broke off; the column `error` says why", self.broken)?;
        }
        Ok(())
    }
}

impl Display for TreatmentSummary {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let levels = self.levels.iter().map(|(factor, level)| format!("{factor} {level}, "));
        writeln!(f, "{}{} seeds", levels.collect::<String>(), self.seeds)?;
        for (metric, figure) in &self.figures {
            let value = MeanWithInterval { value: figure.mean, interval: figure.interval };
            write!(f, "  {:18} {:28}", metric.column(), format!("{value} {}", metric.unit()))?;
            if let Some(difference) = &figure.against_first {
                let more = MeanWithInterval { value: Some(difference.mean), interval: difference.interval };
                write!(f, " {more} against the first")?;
                if let Some(test) = &difference.signed_rank {
                    write!(f, ", p {}", probability(test.p))?;
                }
            }
            writeln!(f)?;
        }
        Ok(())
    }
}
