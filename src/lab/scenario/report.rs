//! The result of a scenario over all its seeds, and what it comes to.

mod json;
mod junit;
mod text;

use std::time::Duration;

use bevy::prelude::Vec2;

pub use json::{ScenarioRow, rows};
pub use junit::junit;

use super::event::Dependency;
use super::judge::{Failure, Verdict};
use super::tally::{ProbabilityCount, ScenarioOutcome, Tally, strict_failures};
use crate::data::in_one_line;

/// All runs of one scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioReport {
    /// The file's name, and the variant's.
    pub file: String,
    /// The variant of the file.
    pub variant: Option<String>,
    /// What the scenario shows.
    pub name: String,
    /// What was switched off: the scenario must then fail with at least one seed.
    pub without: Option<Dependency>,
    /// With how many seeds it may fail, at each place of the ball.
    pub may_fail: usize,
    /// The expectations that must be met with a probability, at each place of the ball by itself; not yet counted.
    pub probabilities: Vec<ProbabilityCount>,
    /// Place by place.
    pub runs: Vec<ScenarioRun>,
    /// Whether it was stopped before all of its runs were played.
    pub interrupted: bool,
}

/// A scenario played with one seed.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioRun {
    /// Where the ball started, in the pitch frame.
    pub place: Vec2,
    /// The seed.
    pub seed: u64,
    /// How it ended.
    pub verdict: Verdict,
    /// Wall time.
    pub took: Duration,
}

/// The runs with the ball at one place.
struct PlaceRuns<'a> {
    runs: &'a [ScenarioRun],
    report: &'a ScenarioReport,
}

impl<'a> PlaceRuns<'a> {
    fn failed(&self) -> impl Iterator<Item = &'a ScenarioRun> {
        self.runs.iter().filter(|run| !run.verdict.passed())
    }

    /// What a run did not meet of that which must be met with each seed.
    fn strict_failures(&self, run: &'a ScenarioRun) -> impl Iterator<Item = &'a Failure> {
        strict_failures(&run.verdict, &self.report.probabilities)
    }

    fn tally(&self) -> Tally {
        let mut tally = Tally::new(&self.report.probabilities);
        self.runs.iter().for_each(|run| tally.add(&run.verdict));
        tally
    }
}

impl ScenarioReport {
    /// What the scenario came to. One that was not played failed.
    pub fn outcome(&self) -> ScenarioOutcome {
        use ScenarioOutcome::{Failed, Passed, Undecided};
        let outcomes: Vec<ScenarioOutcome> =
            self.places().map(|place| place.tally().outcome(self.may_fail)).collect();
        let worst =
            [Failed, Undecided].into_iter().find(|outcome| outcomes.contains(outcome)).unwrap_or(Passed);
        match (worst, self.without) {
            _ if self.runs.is_empty() => Failed,
            (outcome, None) => outcome,
            (Failed, Some(_)) => Passed,
            (Passed, Some(_)) => Failed,
            (Undecided, Some(_)) => Undecided,
        }
    }

    /// Whether the scenario came out as it must.
    pub fn passed(&self) -> bool {
        self.outcome() == ScenarioOutcome::Passed
    }

    fn places(&self) -> impl Iterator<Item = PlaceRuns<'_>> {
        let places = self.runs.chunk_by(|a, b| a.place == b.place);
        places.map(|runs| PlaceRuns { runs, report: self })
    }

    fn failed(&self) -> impl Iterator<Item = &ScenarioRun> {
        self.runs.iter().filter(|run| !run.verdict.passed())
    }

    fn title(&self) -> String {
        let mut name = in_one_line(&self.name);
        if let Some(variant) = &self.variant {
            name += &format!(" [{}]", in_one_line(variant));
        }
        match self.without {
            Some(dependency) => format!("{name}, without {dependency}"),
            None => name,
        }
    }
}

#[cfg(test)]
mod tests;
