//! What the runs of a scenario with the ball at one place come to, run by run.

use serde::Serialize;

use super::check::Scenario;
use super::condition::Expectation;
use super::judge::{Failure, Verdict};
use crate::lab::statistics::{ProbabilityTest, TestCount, TestVerdict};

/// What a scenario came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum ScenarioOutcome {
    /// It came out as it must.
    Passed,
    /// It did not.
    Failed,
    /// Its seeds were too few to show or refute a probability.
    Undecided,
}

/// An expectation that must be met with a probability, and how often it was.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbabilityCount {
    /// In plain words.
    pub expectation: String,
    /// The probability, and how sure its verdict is.
    pub test: ProbabilityTest,
    /// The seeds until the verdict.
    pub count: TestCount,
}

impl ProbabilityCount {
    /// Before the first seed.
    pub fn new(expectation: String, test: ProbabilityTest) -> ProbabilityCount {
        ProbabilityCount { expectation, test, count: TestCount::default() }
    }

    /// All of a scenario, before the first seed.
    pub(super) fn all_of(scenario: &Scenario) -> Vec<ProbabilityCount> {
        let tested = |expectation: &Expectation| {
            Some(ProbabilityCount::new(expectation.to_string(), expectation.probability()?))
        };
        scenario.expect.iter().filter_map(tested).collect()
    }
}

/// The runs with the ball at one place, so far.
#[derive(Clone, Debug)]
pub(super) struct Tally {
    /// Seeds that did not meet what must be met with each.
    pub failed: usize,
    pub probabilities: Vec<ProbabilityCount>,
}

impl Tally {
    /// Before the first run.
    pub fn new(probabilities: &[ProbabilityCount]) -> Tally {
        Tally { failed: 0, probabilities: probabilities.to_vec() }
    }

    /// Adds a run.
    pub fn add(&mut self, verdict: &Verdict) {
        self.failed += usize::from(strict_failures(verdict, &self.probabilities).next().is_some());
        for ProbabilityCount { expectation, test, count } in &mut self.probabilities {
            *count = test.count(*count, verdict.met(expectation));
        }
    }

    /// What it comes to if as many seeds may fail.
    pub fn outcome(&self, may_fail: usize) -> ScenarioOutcome {
        let any = |verdict| self.probabilities.iter().any(|it| it.count.verdict == verdict);
        if self.failed > may_fail || any(TestVerdict::Missed) {
            ScenarioOutcome::Failed
        } else if any(TestVerdict::Undecided) {
            ScenarioOutcome::Undecided
        } else {
            ScenarioOutcome::Passed
        }
    }

    /// Whether more seeds would change nothing. Where nothing must be met with a probability, all seeds are played.
    pub fn is_decided(&self) -> bool {
        !self.probabilities.is_empty() && self.outcome(0) != ScenarioOutcome::Undecided
    }
}

/// What a run did not meet of that which must be met with each seed.
pub(super) fn strict_failures<'a>(
    verdict: &'a Verdict,
    probabilities: &'a [ProbabilityCount],
) -> impl Iterator<Item = &'a Failure> {
    let is_tested = |failure: &&Failure| probabilities.iter().any(|it| it.expectation == failure.expectation);
    verdict.failures.iter().filter(move |failure| !is_tested(failure))
}
