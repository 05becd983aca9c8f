//! A scenario's result as rows for machines.

use serde::Serialize;

use super::{PlaceRuns, ScenarioReport};
use crate::lab::scenario::tally::{ProbabilityCount, ScenarioOutcome};
use crate::lab::statistics::TestVerdict;

/// What came of a scenario with the ball at one of its places.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScenarioRow {
    /// The file's name, and the variant's.
    pub file: String,
    /// What the scenario shows.
    pub name: String,
    /// What was switched off.
    pub without: Option<String>,
    /// Where the ball started, m in the pitch frame.
    pub ball: [f32; 2],
    /// What all places together came to.
    pub outcome: ScenarioOutcome,
    /// Whether it was stopped before all of its runs were played.
    pub interrupted: bool,
    /// With how many seeds it was played here.
    pub seeds: usize,
    /// The seeds that did not meet every expectation.
    pub failed: Vec<FailedSeed>,
    /// How often expectations were met that must be met with a probability.
    pub probabilities: Vec<ProbabilityRow>,
}

/// A seed that did not meet every expectation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FailedSeed {
    seed: u64,
    /// What was expected, and what was seen instead, and when.
    failures: Vec<String>,
}

/// How often an expectation was met.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProbabilityRow {
    expectation: String,
    at_least: f64,
    confidence: f64,
    met: u32,
    /// The seeds until the verdict, or all.
    of: u32,
    verdict: TestVerdict,
}

/// A row for each scenario and each place of the ball at which it was played.
pub fn rows(reports: &[ScenarioReport]) -> Vec<ScenarioRow> {
    reports.iter().flat_map(|report| report.places().map(|place| row(report, &place))).collect()
}

fn row(report: &ScenarioReport, place: &PlaceRuns) -> ScenarioRow {
    let failed = place.failed().map(|run| FailedSeed {
        seed: run.seed,
        failures: run.verdict.failures.iter().map(ToString::to_string).collect(),
    });
    let probability = |probability: &ProbabilityCount| ProbabilityRow {
        expectation: probability.expectation.clone(),
        at_least: probability.test.at_least,
        confidence: probability.test.confidence,
        met: probability.count.met,
        of: probability.count.of,
        verdict: probability.count.verdict,
    };
    ScenarioRow {
        file: report.file.clone(),
        name: report.name.clone(),
        without: report.without.map(|dependency| dependency.to_string()),
        ball: place.runs.first().map_or([0.0; 2], |run| run.place.to_array()),
        outcome: report.outcome(),
        interrupted: report.interrupted,
        seeds: place.runs.len(),
        failed: failed.collect(),
        probabilities: place.tally().probabilities.iter().map(probability).collect(),
    }
}
