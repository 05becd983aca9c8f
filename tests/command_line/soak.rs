//! `touchline soak`: what must not break is played until it does, and the smallest such match is a scenario that fails.

use super::{text, touchline};

/// A seed with which the paper's protocol leaves a role doubled.
const BREAKS: &str = "64";

#[test]
fn the_papers_swap_is_broken_and_the_smallest_match_that_does_is_a_scenario_that_fails() {
    let folder = tempfile::tempdir().expect("a folder");
    let found = folder.path().join("found.ron");
    let found = found.to_str().expect("its name is text");
    let paper = ["soak", "hammerheads_swap_paper", "--hours", "0.001", "--seed", BREAKS, "--out", found];
    let output = touchline(&paper);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("a role is doubled") && said.contains("with 1 events"), "{said}");
    let checked = touchline(&["check", found]);
    let said = text(&checked.stdout);
    assert_eq!(checked.status.code(), Some(1), "{said}");
    assert!(said.contains("a role is doubled"), "{said}");
}

#[test]
fn the_hardened_swap_and_bookings_bear_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let nothing = folder.path().join("nothing.ron");
    let out = nothing.to_str().expect("its name is text");
    let output = touchline(&[
        "soak",
        "hammerheads_swap",
        "chaos_b3p",
        "--hours",
        "0.1",
        "--seed",
        "500",
        "--out",
        out,
    ]);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("6 matches") && said.contains("nothing broke"), "{said}");
    assert!(!nothing.exists(), "there is nothing to write");
}

#[test]
fn a_strategy_that_is_not_there_is_told_with_those_that_are() {
    let output = touchline(&["soak", "hammerheads_1999"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("hammerheads_2001"), "{}", text(&output.stderr));
}
