//! JUnit XML, for machines that run tests.

use std::time::Duration;

use quick_junit::{NonSuccessKind, Report, SerializeError, TestCase, TestCaseStatus, TestSuite};

use super::{PlaceRuns, ScenarioReport};
use crate::lab::scenario::judge::Failure;
use crate::lab::scenario::tally::ProbabilityCount;
use crate::lab::scenario::words::{list, metres_of};
use crate::lab::statistics::TestVerdict;

/// JUnit XML with a suite for each scenario and a case for each seed, or for each place of the ball if there are several or
/// some seeds may fail. What must be met with a probability is a case at each place, with the count of seeds in its output, and an error
/// if it is undecided. A scenario played without something is one case, since its seeds may pass.
///
/// # Errors
/// If the XML cannot be written.
pub fn junit(reports: &[ScenarioReport]) -> Result<String, SerializeError> {
    let mut all = Report::new("touchline scenarios");
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
    } else if report.may_fail > 0 || report.places().nth(1).is_some() || !report.probabilities.is_empty() {
        for place in report.places() {
            let tally = place.tally();
            suite.add_test_case(place_case(report, &place, tally.failed));
            let probabilities = tally.probabilities.iter();
            suite.add_test_cases(probabilities.map(|it| probability_case(report, &place, it)));
        }
    } else {
        suite.add_test_cases(report.runs.iter().map(|run| {
            let failures: Vec<String> = run.verdict.failures.iter().map(Failure::to_string).collect();
            let failure = (!failures.is_empty()).then(|| failures.join("\n"));
            case(report, &format!("seed {}", run.seed), failure, run.took)
        }));
    }
    suite
}

/// What must be met with each seed, or with all but a few.
fn place_case(report: &ScenarioReport, place: &PlaceRuns, failed: usize) -> TestCase {
    let failures = place.failed().flat_map(|run| {
        place.strict_failures(run).map(move |failure| format!("seed {}, {failure}", run.seed))
    });
    let failure = (failed > report.may_fail).then(|| list(failures, "\n"));
    case(report, &name_of(place), failure, place.runs.iter().map(|run| run.took).sum())
}

/// Its seeds are those of the place's own case, which has their time.
fn probability_case(report: &ScenarioReport, place: &PlaceRuns, probability: &ProbabilityCount) -> TestCase {
    let told = probability.to_string();
    let failure = (probability.count.verdict == TestVerdict::Missed).then(|| told.clone());
    let name = format!("{}, {}", name_of(place), probability.expectation);
    let mut case = case(report, &name, failure, Duration::ZERO);
    if probability.count.verdict == TestVerdict::Undecided {
        case.status = not_met(NonSuccessKind::Error, &told);
    }
    case.set_system_out(xml(&told));
    case
}

fn name_of(place: &PlaceRuns) -> String {
    place.runs.first().map_or_else(String::new, |run| format!("ball at {}", metres_of(run.place)))
}

fn case(report: &ScenarioReport, name: &str, failure: Option<String>, took: Duration) -> TestCase {
    let failure = failure.map(|failure| not_met(NonSuccessKind::Failure, &failure));
    let mut case = TestCase::new(xml(name), failure.unwrap_or_else(TestCaseStatus::success));
    case.set_classname(xml(&report.file)).set_time(took);
    case
}

fn not_met(kind: NonSuccessKind, why: &str) -> TestCaseStatus {
    let why = xml(why);
    let mut status = TestCaseStatus::non_success(kind);
    status.set_message(why.lines().next().unwrap_or_default()).set_description(why);
    status
}

/// A text without the characters that XML does not allow, whatever a name in a file holds.
fn xml(text: &str) -> String {
    let is_allowed =
        |c| matches!(c, '\t' | '\n' | '\r' | ' '..='\u{D7FF}' | '\u{E000}'..='\u{FFFD}' | '\u{10000}'..);
    text.replace(|c| !is_allowed(c), "\u{FFFD}")
}
