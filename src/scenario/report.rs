//! What came of a scenario over all its seeds: a line for people, and JUnit XML for machines.

use std::fmt::{self, Display, Formatter};
use std::time::Duration;

use quick_junit::{NonSuccessKind, SerializeError, TestCase, TestCaseStatus, TestSuite};

use super::event::Dependency;
use super::judge::{Failure, Verdict};

/// All runs of one scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The file's name among the assets.
    pub file: String,
    /// What the scenario shows.
    pub name: String,
    /// What was switched off: the scenario must then fail with at least one seed.
    pub without: Option<Dependency>,
    pub runs: Vec<Run>,
}

/// A scenario played with one seed.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    pub seed: u64,
    pub verdict: Verdict,
    /// Wall time.
    pub took: Duration,
}

impl Report {
    /// Whether the scenario came out as it must. One that was not played did not.
    pub fn passed(&self) -> bool {
        let failed = self.failed().count();
        match self.without {
            None => failed == 0 && !self.runs.is_empty(),
            Some(_) => failed > 0,
        }
    }

    fn failed(&self) -> impl Iterator<Item = &Run> {
        self.runs.iter().filter(|run| !run.verdict.passed())
    }

    fn title(&self) -> String {
        match self.without {
            Some(dependency) => format!("{}, without {dependency}", self.name),
            None => self.name.clone(),
        }
    }
}

/// `ok    <name> (10 seeds)`, or `FAIL  <name>: 3 of 10 seeds` with the reasons in lines of their own; no line break at the
/// end.
impl Display for Report {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let title = self.title();
        let played = self.runs.len();
        let seeds = if played == 1 { "1 seed".to_owned() } else { format!("{played} seeds") };
        let failed = self.failed().count();
        match (self.passed(), self.without) {
            (true, None) => write!(f, "ok    {title} ({seeds})"),
            (true, Some(_)) => write!(f, "ok    {title}: fails as it must, {failed} of {seeds}"),
            (false, _) if played == 0 => write!(f, "FAIL  {title}: was not played"),
            (false, Some(_)) => write!(f, "FAIL  {title}: passes all the same ({seeds})"),
            (false, None) => {
                write!(f, "FAIL  {title}: {failed} of {seeds}")?;
                for run in self.failed() {
                    for failure in &run.verdict.failures {
                        write!(f, "\n      seed {}, {failure}", run.seed)?;
                    }
                }
                Ok(())
            }
        }
    }
}

impl Display for Failure {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Failure { expectation, tick, seconds, reason } = self;
        write!(f, "tick {tick} ({seconds:.2} s): expected {expectation}, but {reason}")
    }
}

/// JUnit XML with a suite for each scenario and a case for each seed; a scenario played without something is one case, since
/// its seeds may pass.
///
/// # Errors
/// If the XML cannot be written.
pub fn junit(reports: &[Report]) -> Result<String, SerializeError> {
    let mut all = quick_junit::Report::new("touchline scenarios");
    all.add_test_suites(reports.iter().map(suite));
    all.to_string()
}

fn suite(report: &Report) -> TestSuite {
    let mut suite = TestSuite::new(report.title());
    if report.without.is_some() || report.runs.is_empty() {
        let failure = (!report.passed()).then(|| report.to_string());
        let took = report.runs.iter().map(|run| run.took).sum();
        suite.add_test_case(case(report, "all seeds", failure, took));
    } else {
        suite.add_test_cases(report.runs.iter().map(|run| {
            let failures: Vec<String> = run.verdict.failures.iter().map(Failure::to_string).collect();
            let failure = (!failures.is_empty()).then(|| failures.join("\n"));
            case(report, &format!("seed {}", run.seed), failure, run.took)
        }));
    }
    suite
}

fn case(report: &Report, name: &str, failure: Option<String>, took: Duration) -> TestCase {
    let status = match failure {
        None => TestCaseStatus::success(),
        Some(failure) => {
            let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
            status.set_message(failure.lines().next().unwrap_or_default()).set_description(failure);
            status
        }
    };
    let mut case = TestCase::new(name, status);
    case.set_classname(&report.file).set_time(took);
    case
}

#[cfg(test)]
mod tests {
    use super::*;

    fn failure(tick: u64) -> Failure {
        Failure {
            expectation: "by 5 s: home 1 is forward".into(),
            tick,
            seconds: tick as f64 / 60.0,
            reason: "home 1 was halfback, not forward".into(),
        }
    }

    fn report(failing: &[u64], without: Option<Dependency>) -> Report {
        let runs = (1..=3).map(|seed| {
            let failures = if failing.contains(&seed) { vec![failure(300)] } else { Vec::new() };
            Run { seed, verdict: Verdict { failures }, took: Duration::from_millis(1500) }
        });
        Report { file: "swap".into(), name: "A <swap> works".into(), without, runs: runs.collect() }
    }

    #[test]
    fn a_scenario_that_passes_is_one_line() {
        assert_eq!(report(&[], None).to_string(), "ok    A <swap> works (3 seeds)");
        let mut one = report(&[], None);
        one.runs.truncate(1);
        assert_eq!(one.to_string(), "ok    A <swap> works (1 seed)");
    }

    #[test]
    fn a_scenario_that_fails_gives_the_reasons_by_seed() {
        let report = report(&[1, 3], None);
        assert!(!report.passed());
        let reason =
            "tick 300 (5.00 s): expected by 5 s: home 1 is forward, but home 1 was halfback, not forward";
        assert_eq!(
            report.to_string(),
            format!("FAIL  A <swap> works: 2 of 3 seeds\n      seed 1, {reason}\n      seed 3, {reason}")
        );
    }

    #[test]
    fn a_scenario_that_was_not_played_has_not_passed() {
        let mut empty = report(&[], None);
        empty.runs.clear();
        assert!(!empty.passed());
        assert_eq!(empty.to_string(), "FAIL  A <swap> works: was not played");
        empty.without = Some(Dependency::Claims);
        assert!(!empty.passed());
        assert!(junit(&[empty]).unwrap().contains("failures=\"1\""));
    }

    #[test]
    fn without_what_it_depends_on_a_scenario_must_fail() {
        let fails = report(&[2], Some(Dependency::RoleSwap));
        assert!(fails.passed());
        assert_eq!(
            fails.to_string(),
            "ok    A <swap> works, without role swaps: fails as it must, 1 of 3 seeds"
        );
        let passes = report(&[], Some(Dependency::RoleSwap));
        assert!(!passes.passed());
        assert_eq!(
            passes.to_string(),
            "FAIL  A <swap> works, without role swaps: passes all the same (3 seeds)"
        );
    }

    #[test]
    fn junit_has_a_suite_for_each_scenario_and_a_case_for_each_seed() {
        let xml = junit(&[report(&[2], None), report(&[2], Some(Dependency::RoleSwap))]).unwrap();
        assert_eq!(xml.matches("<testsuite ").count(), 2);
        assert_eq!(xml.matches("<testcase ").count(), 4);
        assert_eq!(xml.matches("<failure ").count(), 1);
        assert!(xml.contains(r#"<testsuite name="A &lt;swap&gt; works" tests="3""#), "{xml}");
        assert!(xml.contains(r#"<testcase name="seed 2" classname="swap" time="1.500">"#), "{xml}");
        assert!(xml.contains("but home 1 was halfback, not forward"));
        assert_eq!(junit(&[report(&[2], None)]).unwrap(), junit(&[report(&[2], None)]).unwrap());
    }
}
