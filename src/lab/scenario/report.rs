//! The result of a scenario over all its seeds: a line for people, and JUnit XML for machines.

use std::fmt::{self, Display, Formatter};
use std::time::Duration;

use bevy::prelude::Vec2;
use quick_junit::{NonSuccessKind, SerializeError, TestCase, TestCaseStatus, TestSuite};

use super::event::Dependency;
use super::judge::{Failure, Verdict};
use super::words::{list, metres_of};
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
struct PlaceRuns<'a>(&'a [ScenarioRun]);

impl PlaceRuns<'_> {
    fn failed(&self) -> impl Iterator<Item = &ScenarioRun> {
        self.0.iter().filter(|run| !run.verdict.passed())
    }
}

impl ScenarioReport {
    /// Whether the scenario came out as it must. One that was not played did not.
    pub fn passed(&self) -> bool {
        let failed = self.places().any(|place| place.failed().count() > self.may_fail);
        match self.without {
            None => !failed && !self.runs.is_empty(),
            Some(_) => failed,
        }
    }

    fn places(&self) -> impl Iterator<Item = PlaceRuns<'_>> {
        self.runs.chunk_by(|a, b| a.place == b.place).map(PlaceRuns)
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

    /// "10 seeds", or "25 places, 10 seeds".
    fn played(&self) -> String {
        let places = self.places().count();
        let seeds = self.places().next().map_or(0, |place| place.0.len());
        let seeds = if seeds == 1 { "1 seed".to_owned() } else { format!("{seeds} seeds") };
        if places > 1 { format!("{places} places, {seeds}") } else { seeds }
    }

    /// "10 seeds", or "250 runs (25 places, 10 seeds)".
    fn runs_in_words(&self) -> String {
        match self.places().count() {
            0 | 1 => self.played(),
            _ => format!("{} runs ({})", self.runs.len(), self.played()),
        }
    }
}

/// `ok    <name> (10 seeds)`, or `FAIL  <name>: 3 of 10 seeds` with a line for each expectation that was not met; no line
/// break at the end. With the ball at several places there is a line for each at which it failed, be it as often as it may.
impl Display for ScenarioReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (title, played) = (self.title(), self.played());
        let failed = self.failed().count();
        match (self.passed(), self.without) {
            _ if self.interrupted => {
                return write!(f, "stop  {title}: {failed} of {} failed so far", self.runs_in_words());
            }
            (true, None) if failed > 0 => write!(f, "ok    {title} ({played}; {failed} failed, as may be)")?,
            (true, None) => return write!(f, "ok    {title} ({played})"),
            (true, Some(_)) => {
                return write!(f, "ok    {title}: fails as it must, {failed} of {}", self.runs_in_words());
            }
            (false, _) if self.runs.is_empty() => return write!(f, "FAIL  {title}: was not played"),
            (false, Some(_)) => return write!(f, "FAIL  {title}: passes all the same ({played})"),
            (false, None) => write!(f, "FAIL  {title}: {failed} of {}", self.runs_in_words())?,
        }
        if self.places().nth(1).is_some() {
            return self.places().try_for_each(|place| place.write_failed_seeds(f));
        }
        let failed: Vec<&ScenarioRun> = self.failed().collect();
        write_failures(f, &failed, self.runs.len())
    }
}

impl PlaceRuns<'_> {
    fn write_failed_seeds(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let seeds: Vec<u64> = self.failed().map(|run| run.seed).collect();
        let (Some(run), played) = (self.0.first().filter(|_| !seeds.is_empty()), self.0.len()) else {
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

/// A text without the characters that XML does not allow, whatever a name in a file holds.
fn xml(text: &str) -> String {
    let is_allowed =
        |c| matches!(c, '\t' | '\n' | '\r' | ' '..='\u{D7FF}' | '\u{E000}'..='\u{FFFD}' | '\u{10000}'..);
    text.replace(|c| !is_allowed(c), "\u{FFFD}")
}

/// JUnit XML with a suite for each scenario and a case for each seed, or for each place of the ball if there are several or
/// some seeds may fail; a scenario played without something is one case, since its seeds may pass.
///
/// # Errors
/// If the XML cannot be written.
pub fn junit(reports: &[ScenarioReport]) -> Result<String, SerializeError> {
    let mut all = quick_junit::Report::new("touchline scenarios");
    all.add_test_suites(reports.iter().map(suite));
    all.to_string()
}

fn suite(report: &ScenarioReport) -> TestSuite {
    let mut suite = TestSuite::new(xml(&report.title()));
    if report.interrupted && (report.without.is_some() || report.runs.is_empty()) {
        suite.add_test_case(TestCase::new("all seeds", TestCaseStatus::skipped()));
    } else if report.without.is_some() || report.runs.is_empty() {
        let failure = (!report.passed()).then(|| report.to_string());
        let took = report.runs.iter().map(|run| run.took).sum();
        suite.add_test_case(case(report, "all seeds", failure, took));
    } else if report.may_fail > 0 || report.places().nth(1).is_some() {
        suite.add_test_cases(report.places().map(|place| place_case(report, &place)));
    } else {
        suite.add_test_cases(report.runs.iter().map(|run| {
            let failures: Vec<String> = run.verdict.failures.iter().map(Failure::to_string).collect();
            let failure = (!failures.is_empty()).then(|| failures.join("\n"));
            case(report, &format!("seed {}", run.seed), failure, run.took)
        }));
    }
    suite
}

fn place_case(report: &ScenarioReport, place: &PlaceRuns) -> TestCase {
    let failures = place
        .failed()
        .flat_map(|run| run.verdict.failures.iter().map(|failure| format!("seed {}, {failure}", run.seed)));
    let failure = (place.failed().count() > report.may_fail).then(|| list(failures, "\n"));
    let name = place.0.first().map_or_else(String::new, |run| format!("ball at {}", metres_of(run.place)));
    case(report, &name, failure, place.0.iter().map(|run| run.took).sum())
}

fn case(report: &ScenarioReport, name: &str, failure: Option<String>, took: Duration) -> TestCase {
    let status = match failure {
        None => TestCaseStatus::success(),
        Some(failure) => {
            let failure = xml(&failure);
            let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
            status.set_message(failure.lines().next().unwrap_or_default()).set_description(failure);
            status
        }
    };
    let mut case = TestCase::new(xml(name), status);
    case.set_classname(xml(&report.file)).set_time(took);
    case
}

#[cfg(test)]
mod tests;
