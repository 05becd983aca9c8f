//! What people read of a scenario's runs.

use std::fmt::{self, Display, Formatter};

use super::{PlaceRuns, ScenarioReport, ScenarioRun};
use crate::lab::scenario::judge::Failure;
use crate::lab::scenario::tally::{ProbabilityCount, ScenarioOutcome};
use crate::lab::scenario::words::metres_of;
use crate::lab::statistics::TestVerdict;

/// `ok    <name> (10 seeds)`, or `FAIL  <name>: 3 of 10 seeds` with a line for each expectation that was not met, or `open  <name>`; no line
/// break at the end. With the ball at several places there is a line for each at which it failed, be it as often as it may. What must
/// be met with a probability has a line with its count.
impl Display for ScenarioReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (title, played) = (self.title(), self.played());
        let (failed, outcome) = (self.failed().count(), self.outcome());
        match (outcome, self.without) {
            _ if self.interrupted => {
                return write!(f, "stop  {title}: {failed} of {} failed so far", self.runs_in_words());
            }
            _ if self.runs.is_empty() => return write!(f, "FAIL  {title}: was not played"),
            (ScenarioOutcome::Passed, Some(_)) => {
                write!(f, "ok    {title}: fails as it must, {failed} of {}", self.runs_in_words())?;
                return self.write_probabilities(f);
            }
            (ScenarioOutcome::Failed, Some(_)) => {
                return write!(f, "FAIL  {title}: passes all the same ({played})");
            }
            (ScenarioOutcome::Passed, None) => {
                let as_may_be =
                    if failed > 0 { format!("; {failed} failed, as may be") } else { String::new() };
                write!(f, "ok    {title} ({played}{as_may_be})")?;
            }
            (ScenarioOutcome::Undecided, _) => {
                write!(f, "open  {title}: undecided after {}", self.runs_in_words())?
            }
            (ScenarioOutcome::Failed, None) => {
                write!(f, "FAIL  {title}: {failed} of {}", self.runs_in_words())?
            }
        }
        self.write_probabilities(f)?;
        if self.places().nth(1).is_some() {
            return self.places().try_for_each(|place| place.write_failed_seeds(f));
        }
        if outcome == ScenarioOutcome::Passed && !self.probabilities.is_empty() {
            return Ok(());
        }
        let failed: Vec<&ScenarioRun> = self.failed().collect();
        write_failures(f, &failed, self.runs.len())
    }
}

impl ScenarioReport {
    /// "10 seeds", or "25 places, 10 seeds", or "25 places, 34 to 60 seeds".
    fn played(&self) -> String {
        let seeds = || self.places().map(|place| place.runs.len());
        let seeds = match (seeds().min().unwrap_or_default(), seeds().max().unwrap_or_default()) {
            (1, 1) => "1 seed".to_owned(),
            (least, most) if least == most => format!("{most} seeds"),
            (least, most) => format!("{least} to {most} seeds"),
        };
        let places = self.places().count();
        if places > 1 { format!("{places} places, {seeds}") } else { seeds }
    }

    /// "10 seeds", or "250 runs (25 places, 10 seeds)".
    fn runs_in_words(&self) -> String {
        match self.places().count() {
            0 | 1 => self.played(),
            _ => format!("{} runs ({})", self.runs.len(), self.played()),
        }
    }

    /// A line for each probability; with several places only where it was not shown, and without what it depends on only where it was
    /// refuted.
    fn write_probabilities(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let is_grid = self.places().nth(1).is_some();
        let is_told = |verdict| match verdict {
            TestVerdict::Met => !is_grid && self.without.is_none(),
            TestVerdict::Missed => true,
            TestVerdict::Undecided => self.without.is_none(),
        };
        for place in self.places() {
            let at = place.runs.first().filter(|_| is_grid).map(|run| metres_of(run.place));
            let at = at.map_or_else(String::new, |place| format!("ball at {place}: "));
            for probability in place.tally().probabilities.iter().filter(|it| is_told(it.count.verdict)) {
                write!(f, "\n      {at}{probability}")?;
            }
        }
        Ok(())
    }
}

/// `met with 34 of 34 seeds: with a probability of at least 0.9 (confidence 0.95), by 5 s: home 1 is forward`
impl Display for ProbabilityCount {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let verdict = match self.count.verdict {
            TestVerdict::Met => "",
            TestVerdict::Missed => "too seldom, ",
            TestVerdict::Undecided => "undecided, ",
        };
        write!(f, "{verdict}met with {} of {} seeds: {}", self.count.met, self.count.of, self.expectation)
    }
}

impl PlaceRuns<'_> {
    fn write_failed_seeds(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let seeds: Vec<u64> = self.failed().map(|run| run.seed).collect();
        let (Some(run), played) = (self.runs.first().filter(|_| !seeds.is_empty()), self.runs.len()) else {
            return Ok(());
        };
        write!(f, "\n      ball at {}: {}", metres_of(run.place), seeds_in_words(&seeds, played))
    }
}

/// A line for each expectation that was not met in these of so many runs: with which seeds, and why with the first of them.
fn write_failures(f: &mut Formatter<'_>, failed: &[&ScenarioRun], played: usize) -> fmt::Result {
    let all = || failed.iter().flat_map(|run| run.verdict.failures.iter().map(|failure| (run.seed, failure)));
    let mut told: Vec<&str> = Vec::new();
    for (first, failure) in all() {
        if told.contains(&failure.expectation.as_str()) {
            continue;
        }
        told.push(&failure.expectation);
        let alike = all().filter(|(_, other)| other.expectation == failure.expectation);
        let is_same = alike.clone().all(|(_, other)| other == failure);
        let mut seeds: Vec<u64> = alike.map(|(seed, _)| seed).collect();
        seeds.dedup();
        write!(f, "\n      {}", seeds_in_words(&seeds, played))?;
        if !is_same {
            write!(f, "; with seed {first}")?;
        }
        write!(f, ", {failure}")?;
    }
    Ok(())
}

/// More seeds than these are counted, not listed.
const LISTED: usize = 8;

fn seeds_in_words(seeds: &[u64], played: usize) -> String {
    match seeds {
        [seed] => format!("seed {seed}"),
        _ if seeds.len() == played => format!("all {played} seeds"),
        _ if seeds.len() > LISTED => format!("{} seeds", seeds.len()),
        _ => {
            let seeds: Vec<String> = seeds.iter().map(u64::to_string).collect();
            format!("seeds {}", seeds.join(", "))
        }
    }
}

impl Display for Failure {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Failure { expectation, tick, seconds, reason } = self;
        write!(f, "tick {tick} ({seconds:.2} s): expected {expectation}, but {reason}")
    }
}
