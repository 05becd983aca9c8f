//! What came of a scenario over all its seeds: a line for people, and JUnit XML for machines.

use std::fmt::{self, Display, Formatter};
use std::time::Duration;

use quick_junit::{NonSuccessKind, SerializeError, TestCase, TestCaseStatus, TestSuite};

use super::event::Dependency;
use super::judge::{Failure, Verdict};
use crate::data::in_one_line;

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
    /// Whether it was stopped before all of its runs were played.
    pub interrupted: bool,
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
        let name = in_one_line(&self.name);
        match self.without {
            Some(dependency) => format!("{name}, without {dependency}"),
            None => name,
        }
    }
}

/// `ok    <name> (10 seeds)`, or `FAIL  <name>: 3 of 10 seeds` with a line for each expectation that was not met; no line
/// break at the end.
impl Display for Report {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let title = self.title();
        let played = self.runs.len();
        let seeds = if played == 1 { "1 seed".to_owned() } else { format!("{played} seeds") };
        let failed = self.failed().count();
        match (self.passed(), self.without) {
            _ if self.interrupted => write!(f, "stop  {title}: {failed} of {seeds} failed so far"),
            (true, None) => write!(f, "ok    {title} ({seeds})"),
            (true, Some(_)) => write!(f, "ok    {title}: fails as it must, {failed} of {seeds}"),
            (false, _) if played == 0 => write!(f, "FAIL  {title}: was not played"),
            (false, Some(_)) => write!(f, "FAIL  {title}: passes all the same ({seeds})"),
            (false, None) => {
                write!(f, "FAIL  {title}: {failed} of {seeds}")?;
                let failed: Vec<&Run> = self.failed().collect();
                write_failures(f, &failed, played)
            }
        }
    }
}

/// A line for each expectation that was not met in these of so many runs: with which seeds, and why with the first of them.
fn write_failures(f: &mut Formatter<'_>, failed: &[&Run], played: usize) -> fmt::Result {
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
    let mut suite = TestSuite::new(xml(&report.title()));
    if report.interrupted && (report.without.is_some() || report.runs.is_empty()) {
        suite.add_test_case(TestCase::new("all seeds", TestCaseStatus::skipped()));
    } else if report.without.is_some() || report.runs.is_empty() {
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
mod tests {
    use quick_xml::events::Event;
    use quick_xml::{Reader, XmlVersion};

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
        Report {
            file: "swap".into(),
            name: "A <swap> works".into(),
            without,
            runs: runs.collect(),
            interrupted: false,
        }
    }

    #[test]
    fn a_scenario_that_passes_is_one_line() {
        assert_eq!(report(&[], None).to_string(), "ok    A <swap> works (3 seeds)");
        let mut one = report(&[], None);
        one.runs.truncate(1);
        assert_eq!(one.to_string(), "ok    A <swap> works (1 seed)");
    }

    const REASON: &str =
        "tick 300 (5.00 s): expected by 5 s: home 1 is forward, but home 1 was halfback, not forward";

    #[test]
    fn a_scenario_that_fails_alike_on_some_or_all_seeds_says_so_once() {
        let some = report(&[1, 3], None);
        assert!(!some.passed());
        assert_eq!(
            some.to_string(),
            format!("FAIL  A <swap> works: 2 of 3 seeds\n      seeds 1, 3, {REASON}")
        );
        let one = report(&[2], None).to_string();
        assert_eq!(one, format!("FAIL  A <swap> works: 1 of 3 seeds\n      seed 2, {REASON}"));
        let mut all = report(&[1, 2, 3], None);
        let line = format!("FAIL  A <swap> works: 3 of 3 seeds\n      all 3 seeds, {REASON}");
        assert_eq!(all.to_string(), line);
        let template = all.runs[0].clone();
        all.runs = (1..=30).map(|seed| Run { seed, ..template.clone() }).collect();
        assert!(all.to_string().ends_with(&format!("\n      all 30 seeds, {REASON}")), "{all}");
        all.runs[4].verdict = Verdict::default();
        assert!(all.to_string().ends_with(&format!("\n      29 seeds, {REASON}")), "{all}");
    }

    #[test]
    fn an_expectation_that_fails_in_different_ways_is_told_with_the_first_seed() {
        let mut report = report(&[1, 3], None);
        report.runs[2].verdict.failures = vec![failure(7)];
        let other = Failure { expectation: "never: the ball is out".into(), ..failure(9) };
        report.runs[2].verdict.failures.push(other.clone());
        let expected = format!(
            "FAIL  A <swap> works: 2 of 3 seeds\n      seeds 1, 3; with seed 1, {REASON}\n      seed 3, {other}"
        );
        assert_eq!(report.to_string(), expected);
    }

    #[test]
    fn a_scenario_that_is_stopped_tells_what_it_came_to_and_counts_as_skipped() {
        let mut report = report(&[1], None);
        report.interrupted = true;
        assert_eq!(report.to_string(), "stop  A <swap> works: 1 of 3 seeds failed so far");
        report.runs.clear();
        let xml = junit(&[report]).unwrap();
        assert!(xml.contains("skipped=\"1\"") && xml.contains("failures=\"0\""), "{xml}");
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
    fn junit_is_xml_whatever_a_name_holds() {
        let wild: String =
            ('\0'..='\u{FF}').chain("\u{2028}\u{FFFE}\u{FFFF}\u{10FFFF}]]>&amp;<!--".chars()).collect();
        let mut report = report(&[1, 2, 3], None);
        report.name = wild.clone();
        report.file = wild.clone();
        for run in &mut report.runs {
            run.verdict.failures[0].expectation = wild.clone();
            run.verdict.failures[0].reason = wild.clone();
        }
        let xml = junit(&[report.clone(), Report { without: Some(Dependency::RoleSwap), ..report }]).unwrap();
        let is_allowed =
            |c: char| matches!(u32::from(c), 0x9 | 0xA | 0xD | 0x20..=0xD7FF | 0xE000..=0xFFFD | 0x10000..);
        assert!(xml.chars().all(is_allowed), "{xml}");
        let mut reader = Reader::from_str(&xml);
        let mut text = String::new();
        loop {
            match reader.read_event().expect("it is XML") {
                Event::Start(tag) | Event::Empty(tag) => {
                    for attribute in tag.attributes() {
                        let value =
                            attribute.expect("a sound attribute").normalized_value(XmlVersion::Explicit1_0);
                        text.push_str(&value.expect("every entity is known"));
                    }
                }
                Event::Text(part) => text.push_str(&part.decode().expect("it is UTF-8")),
                Event::Eof => break,
                _ => {}
            }
        }
        assert!(text.contains("ABC") && text.contains('\u{10FFFF}') && text.contains('\u{FFFD}'), "{text}");
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
