//! What a tuning has come to, on the seeds of the training and on those that were held out.

use std::fmt::{self, Display, Formatter};

use serde::Serialize;

use super::file::{BetterValue, TuningObjective};
use super::plan::TuningPlan;
use super::race::RaceEntrant;
use super::row::KnownMatches;
use crate::lab::experiment::{ClaimVerdict, SeedBlocks, verdict};
use crate::lab::statistics::{PairedDifference, compare_pairs, mean};
use crate::rng::{DEFAULT_SEED, Seed};

/// What a tuning has come to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TuningReport {
    /// What was sought.
    pub name: String,
    /// What candidates were judged by.
    pub objective: TuningObjective,
    /// Each parameter.
    pub values: Vec<TunedValue>,
    /// By how much the tuned values have more of the objective than those of before, on the seeds of the training that both played. The
    /// winner was chosen on these: the difference flatters it.
    pub training: Option<PairedDifference>,
    /// The same on the seeds that were held out.
    pub held_out: Option<PairedDifference>,
    /// Whether the tuned values are better, by the seeds that were held out.
    pub better: ClaimVerdict,
    /// All matches that were played.
    pub matches: usize,
}

/// A parameter with the value that was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TunedValue {
    /// Its name.
    pub parameter: String,
    /// What it was.
    pub before: f64,
    /// What it is.
    pub tuned: f64,
}

const CONFIDENCE: f64 = 0.95;

impl TuningReport {
    /// Compares the winner with the values of before by the matches that are known.
    pub fn of(plan: &TuningPlan, winner: &RaceEntrant, known: &KnownMatches) -> TuningReport {
        let compared = |seeds: SeedBlocks| {
            let differences: Vec<f64> = seeds
                .seeds()
                .filter_map(|seed| Some(value(known, winner.number, seed)? - value(known, 0, seed)?))
                .collect();
            compare_pairs(&differences, CONFIDENCE, Seed(DEFAULT_SEED))
        };
        let held_out = compared(plan.file.held_out);
        let values = plan.file.parameters.iter().zip(plan.space().original).zip(&winner.values);
        TuningReport {
            name: plan.file.name.clone(),
            objective: plan.file.objective,
            values: values
                .map(|((parameter, before), tuned)| TunedValue {
                    parameter: parameter.name.clone(),
                    before,
                    tuned: *tuned,
                })
                .collect(),
            training: compared(plan.file.training),
            better: verdict(
                plan.file.objective.better.claim(),
                held_out.as_ref().and_then(|difference| difference.interval),
            ),
            held_out,
            matches: known.len(),
        }
    }
}

impl TuningReport {
    /// What stands above the tuned values in their files.
    pub fn comment(&self) -> String {
        let held_out = self.held_out.as_ref().map_or(String::new(), |difference| {
            let interval =
                difference.interval.map_or(String::new(), |it| format!(" [{:.3}, {:.3}]", it.low, it.high));
            format!(
                "; held out, {} seeds: {:.3}{interval} of {}",
                difference.pairs,
                difference.mean,
                self.objective.metric.column()
            )
        });
        let names: Vec<&str> = self.values.iter().map(|value| value.parameter.as_str()).collect();
        format!("// Fitted by `touchline tune` ({}): {}{held_out}.\n", self.name, names.join(", "))
    }
}

/// The value of a candidate with a seed: the mean of both sides.
fn value(known: &KnownMatches, candidate: usize, seed: u64) -> Option<f64> {
    let sides = [false, true].map(|swapped| known.get(candidate, seed, swapped)?.value);
    mean(&[sides[0]?, sides[1]?])
}

impl Display for TuningReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let metric = self.objective.metric;
        writeln!(f, "# {}\n", self.name)?;
        writeln!(f, "{} of {}, {} matches.\n", word(self.objective), metric.column(), self.matches)?;
        writeln!(f, "| parameter | before | tuned |\n|---|---|---|")?;
        for TunedValue { parameter, before, tuned } in &self.values {
            writeln!(f, "| {parameter} | {before} | {tuned} |")?;
        }
        writeln!(
            f,
            "\n| tuned less before, {} | seeds | mean | interval of 95 % | p (Wilcoxon) |\n|---|---|---|---|---|",
            metric.column()
        )?;
        for (name, difference) in
            [("training (chose the winner)", &self.training), ("held out", &self.held_out)]
        {
            let Some(difference) = difference else { continue };
            let interval = difference
                .interval
                .map_or("-".into(), |interval| format!("{:.3} to {:.3}", interval.low, interval.high));
            let p = difference.signed_rank.as_ref().map_or("-".into(), |test| format!("{:.3}", test.p));
            writeln!(f, "| {name} | {} | {:.3} | {interval} | {p} |", difference.pairs, difference.mean)?;
        }
        let verdict = match self.better {
            ClaimVerdict::Held => "the tuned values are better",
            ClaimVerdict::DidNotHold => "the tuned values are worse",
            ClaimVerdict::CannotBeSaid => "cannot be said: the interval holds 0, or there is none",
        };
        writeln!(f, "\nBy the seeds that were held out: {verdict}.")
    }
}

fn word(objective: TuningObjective) -> &'static str {
    match objective.better {
        BetterValue::More => "The most",
        BetterValue::Less => "The least",
    }
}
