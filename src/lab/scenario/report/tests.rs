//! What is told of runs, to people and to machines.

use quick_xml::events::Event;
use quick_xml::{Reader, XmlVersion};

use super::*;
use crate::lab::statistics::ProbabilityTest;

fn failure(tick: u64) -> Failure {
    Failure {
        expectation: "by 5 s: home 1 is forward".into(),
        tick,
        seconds: tick as f64 / 60.0,
        reason: "home 1 was halfback, not forward".into(),
    }
}

fn report(failing: &[u64], without: Option<Dependency>) -> ScenarioReport {
    let runs = (1..=3).map(|seed| {
        let failures = if failing.contains(&seed) { vec![failure(300)] } else { Vec::new() };
        run(Vec2::ZERO, seed, failures)
    });
    of(without, 0, runs.collect())
}

fn run(place: Vec2, seed: u64, failures: Vec<Failure>) -> ScenarioRun {
    ScenarioRun { place, seed, verdict: Verdict { failures }, took: Duration::from_millis(1500) }
}

fn of(without: Option<Dependency>, may_fail: usize, runs: Vec<ScenarioRun>) -> ScenarioReport {
    let (file, name) = ("swap".into(), "A <swap> works".into());
    let probabilities = Vec::new();
    ScenarioReport { file, variant: None, name, without, may_fail, probabilities, runs, interrupted: false }
}

/// So many runs at one place, of which these do not meet what must be met with a probability of 0.5, sure to 0.9.
fn tested(runs: u64, failing: &[u64], without: Option<Dependency>) -> ScenarioReport {
    let failures = |seed| if failing.contains(&seed) { vec![failure(300)] } else { Vec::new() };
    let mut report = of(without, 0, (1..=runs).map(|seed| run(Vec2::ZERO, seed, failures(seed))).collect());
    let test = ProbabilityTest { at_least: 0.5, confidence: 0.9 };
    report.probabilities = vec![ProbabilityCount::new(failure(0).expectation, test)];
    report
}

#[test]
fn what_is_probable_is_told_with_its_count_of_seeds() {
    let passes = tested(9, &[2], None);
    assert_eq!(passes.outcome(), ScenarioOutcome::Passed);
    assert_eq!(
        passes.to_string(),
        "ok    A <swap> works (9 seeds; 1 failed, as may be)\n      met with 8 of 9 seeds: by 5 s: home 1 is forward"
    );
    let fails = tested(6, &[1, 2, 3, 4, 5, 6], None);
    assert_eq!(fails.outcome(), ScenarioOutcome::Failed);
    let told = "FAIL  A <swap> works: 6 of 6 seeds\n      too seldom, met with 0 of 5 seeds: by 5 s: home 1 is forward";
    assert_eq!(fails.to_string(), format!("{told}\n      all 6 seeds, {REASON}"));
    let open = tested(4, &[1, 3], None);
    assert_eq!(open.outcome(), ScenarioOutcome::Undecided);
    assert!(!open.passed());
    let told = "open  A <swap> works: undecided after 4 seeds\n      undecided, met with 2 of 4 seeds: by 5 s: home 1 is forward";
    assert_eq!(open.to_string(), format!("{told}\n      seeds 1, 3, {REASON}"));
}

#[test]
fn what_must_be_met_with_each_seed_fails_beside_a_probability() {
    let mut report = tested(9, &[2], None);
    let other = Failure { expectation: "never: the ball is out".into(), ..failure(9) };
    report.runs[8].verdict.failures.push(other);
    assert_eq!(report.outcome(), ScenarioOutcome::Failed);
    let xml = junit(&[report]).unwrap();
    assert_eq!((xml.matches("<testcase ").count(), xml.matches("<failure ").count()), (2, 1), "{xml}");
}

#[test]
fn without_what_it_depends_on_a_probability_must_be_refuted() {
    let without = Some(Dependency::RoleSwap);
    let fails = tested(6, &[1, 2, 3, 4, 5, 6], without);
    assert_eq!(fails.outcome(), ScenarioOutcome::Passed);
    let told = "ok    A <swap> works, without role swaps: fails as it must, 6 of 6 seeds\n      too seldom, met with 0 of 5 seeds: by";
    assert!(fails.to_string().starts_with(told), "{fails}");
    assert_eq!(tested(4, &[1, 3], without).outcome(), ScenarioOutcome::Undecided);
    let passes = tested(9, &[2], without);
    assert_eq!(passes.outcome(), ScenarioOutcome::Failed);
    assert_eq!(passes.to_string(), "FAIL  A <swap> works, without role swaps: passes all the same (9 seeds)");
}

#[test]
fn an_undecided_probability_is_an_error_of_junit_and_a_verdict_of_json() {
    let reports = [tested(9, &[2], None), tested(4, &[1, 3], None)];
    let xml = junit(&reports).unwrap();
    assert_eq!((xml.matches("<testcase ").count(), xml.matches("<failure ").count()), (4, 0), "{xml}");
    assert_eq!(xml.matches("<error ").count(), 1, "{xml}");
    assert!(
        xml.contains("<system-out>met with 8 of 9 seeds: by 5 s: home 1 is forward</system-out>"),
        "{xml}"
    );
    let json = serde_json::to_value(rows(&reports)).unwrap();
    assert_eq!((&json[0]["outcome"], &json[1]["outcome"]), (&"Passed".into(), &"Undecided".into()));
    assert_eq!((&json[0]["seeds"], &json[0]["failed"][0]["seed"]), (&9.into(), &2.into()));
    let probability = &json[0]["probabilities"][0];
    assert_eq!(
        (&probability["met"], &probability["of"], &probability["verdict"]),
        (&8.into(), &9.into(), &"Met".into())
    );
}

/// Two places and three seeds each; fails with so many of them.
fn at_two_places(failing: [u64; 2], may_fail: usize) -> ScenarioReport {
    let runs = [Vec2::ZERO, Vec2::new(1.0, -2.5)].into_iter().zip(failing).flat_map(|(place, failing)| {
        let failures = move |seed| if seed <= failing { vec![failure(300)] } else { Vec::new() };
        (1..=3).map(move |seed| run(place, seed, failures(seed)))
    });
    of(None, may_fail, runs.collect())
}

#[test]
fn with_several_places_the_report_names_those_at_which_it_failed() {
    assert_eq!(at_two_places([0, 0], 0).to_string(), "ok    A <swap> works (2 places, 3 seeds)");
    let fails = at_two_places([0, 2], 1);
    assert!(!fails.passed());
    assert_eq!(
        fails.to_string(),
        "FAIL  A <swap> works: 2 of 6 runs (2 places, 3 seeds)\n      ball at (1.00, -2.50): seeds 1, 2"
    );
}

#[test]
fn at_each_place_as_many_seeds_may_fail_as_the_file_allows() {
    let report = at_two_places([1, 1], 1);
    assert!(report.passed());
    let text = report.to_string();
    assert!(text.starts_with("ok    A <swap> works (2 places, 3 seeds; 2 failed, as may be)"), "{text}");
    assert!(text.contains("ball at (0.00, 0.00): seed 1"), "{text}");
    assert!(!at_two_places([1, 1], 0).passed() && !at_two_places([0, 2], 1).passed());
    let xml = junit(&[at_two_places([1, 2], 1)]).unwrap();
    assert_eq!((xml.matches("<testcase ").count(), xml.matches("<failure ").count()), (2, 1), "{xml}");
    assert!(xml.contains(r#"<testcase name="ball at (1.00, -2.50)""#), "{xml}");
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
    assert_eq!(some.to_string(), format!("FAIL  A <swap> works: 2 of 3 seeds\n      seeds 1, 3, {REASON}"));
    let one = report(&[2], None).to_string();
    assert_eq!(one, format!("FAIL  A <swap> works: 1 of 3 seeds\n      seed 2, {REASON}"));
    let mut all = report(&[1, 2, 3], None);
    let line = format!("FAIL  A <swap> works: 3 of 3 seeds\n      all 3 seeds, {REASON}");
    assert_eq!(all.to_string(), line);
    let template = all.runs[0].clone();
    all.runs = (1..=30).map(|seed| ScenarioRun { seed, ..template.clone() }).collect();
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
    assert_eq!(fails.to_string(), "ok    A <swap> works, without role swaps: fails as it must, 1 of 3 seeds");
    let passes = report(&[], Some(Dependency::RoleSwap));
    assert!(!passes.passed());
    assert_eq!(passes.to_string(), "FAIL  A <swap> works, without role swaps: passes all the same (3 seeds)");
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
    let xml =
        junit(&[report.clone(), ScenarioReport { without: Some(Dependency::RoleSwap), ..report }]).unwrap();
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
