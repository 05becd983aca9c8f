//! What a tuning has come to, on the seeds of the training and on those that were held out.

use serde::Serialize;

use super::file::TuningObjective;
use super::plan::TuningPlan;
use super::race::RaceEntrant;
use super::row::KnownMatches;
use crate::lab::experiment::{
    CONFIDENCE, ClaimVerdict, MeanWithInterval, SeedBlocks, probability, telling, verdict,
};
use crate::lab::report::{ReportBlock, ReportDocument, ReportTable};
use crate::lab::statistics::{PairedDifference, compare_pairs};
use crate::rng::{DEFAULT_SEED, Seed};

/// What a tuning has come to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TuningReport {
    /// What was sought.
    pub name: String,
    /// The team, if the tuning names several.
    pub team: Option<String>,
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

impl TuningReport {
    /// Compares the winner with the values of before by the matches that are known.
    pub fn of(plan: &TuningPlan, winner: &RaceEntrant, known: &KnownMatches) -> TuningReport {
        let compared = |seeds: SeedBlocks| {
            let differences: Vec<f64> = seeds
                .seeds()
                .filter_map(|seed| Some(known.value(winner.number, seed)? - known.value(0, seed)?))
                .collect();
            compare_pairs(&differences, CONFIDENCE, Seed(DEFAULT_SEED))
        };
        let held_out = compared(plan.file.held_out);
        let values = plan.file.parameters.iter().zip(plan.space().original).zip(&winner.values);
        TuningReport {
            name: plan.file.name.clone(),
            team: plan.team().map(str::to_owned),
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
                held_out.as_ref().and_then(|difference| telling(difference.pairs, difference.interval)),
            ),
            held_out,
            matches: known.len(),
        }
    }
}

impl TuningReport {
    /// What stands above the tuned values in their files: one line.
    pub fn comment(&self) -> String {
        let held_out = self.held_out.as_ref().map_or(String::new(), |difference| {
            let (seeds, column) = (difference.pairs, self.objective.metric.column());
            format!("; held out, {seeds} seeds: {} of {column}", mean_of(difference))
        });
        let names: Vec<&str> = self.values.iter().map(|value| value.parameter.as_str()).collect();
        let of = [self.name.as_str()].into_iter().chain(self.team.as_deref()).collect::<Vec<_>>().join(", ");
        let text = format!("// Fitted by `touchline tune` ({of}): {}{held_out}.", names.join(", "));
        text.split_whitespace().collect::<Vec<_>>().join(" ") + "\n"
    }

    /// As text.
    pub fn document(&self) -> ReportDocument {
        let column = self.objective.metric.column();
        let values = self.values.iter().map(|TunedValue { parameter, before, tuned }| {
            vec![parameter.clone(), before.to_string(), tuned.to_string()]
        });
        let compared = [("training (chose the winner)", &self.training), ("held out", &self.held_out)];
        let compared = compared.into_iter().filter_map(|(name, difference)| {
            let difference = difference.as_ref()?;
            let p = difference.signed_rank.as_ref().map_or("-".into(), |test| probability(test.p));
            let mean = mean_of(difference).to_string();
            Some(vec![name.to_owned(), difference.pairs.to_string(), mean, p])
        });
        let blocks = vec![
            ReportBlock::Text(format!(
                "What is sought is {} of {column}; {} matches.",
                self.objective.better.words(),
                self.matches
            )),
            table(["parameter", "before", "tuned"], values.collect()),
            table([&format!("tuned less before, {column}"), "seeds", "mean [95 %]", "p"], compared.collect()),
            ReportBlock::Text(format!("By the seeds that were held out: {}.", self.verdict())),
        ];
        let team = self.team.iter().map(|team| format!(": {team}"));
        ReportDocument { title: [self.name.clone()].into_iter().chain(team).collect(), blocks }
    }

    /// Whether the search has come to other values than those of before.
    pub fn has_changed(&self) -> bool {
        self.values.iter().any(|value| value.before != value.tuned)
    }

    fn verdict(&self) -> &'static str {
        match self.better {
            ClaimVerdict::Held => "the tuned values are better",
            ClaimVerdict::DidNotHold => "the tuned values are worse",
            ClaimVerdict::CannotBeSaid => "cannot be said: the interval holds 0, or the seeds are too few",
        }
    }
}

pub(super) fn mean_of(difference: &PairedDifference) -> MeanWithInterval {
    MeanWithInterval { value: Some(difference.mean), interval: difference.interval }
}

fn table<const N: usize>(head: [&str; N], rows: Vec<Vec<String>>) -> ReportBlock {
    ReportBlock::Table(ReportTable { head: head.map(str::to_owned).into(), rows, words: 1 })
}
