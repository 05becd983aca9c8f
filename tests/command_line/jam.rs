//! `touchline jam`: what it writes plays the worst radio again.

use super::{text, touchline};

#[test]
fn the_worst_radio_of_a_scenario_is_a_scenario_that_fails() {
    let folder = tempfile::tempdir().expect("a folder");
    let worst = folder.path().join("worst.ron").display().to_string();
    let scenario = "counterexample_02_two_generals_unlocked_at_once:paper";
    let output = touchline(&["jam", scenario, "--without-faults", "--out", &worst]);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(said.contains("a role is doubled") && said.contains("with any 0 packets"), "{said}");
    let checked = touchline(&["check", &worst]);
    assert_eq!(checked.status.code(), Some(1), "{}", text(&checked.stdout));
}

#[test]
fn the_worst_radio_of_a_recorded_match_is_a_recording_that_plays_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let scenario = "assets/scenarios/counterexample_01_shared_for_a_moment.ron:paper";
    let recorded = touchline(&["check", scenario, "--record", &path("runs")]);
    assert_eq!(recorded.status.code(), Some(0), "{}", text(&recorded.stdout));
    let run = std::fs::read_dir(path("runs")).expect("there are recordings").next();
    let run = run.expect("at least one").expect("it can be read").path().display().to_string();
    let worst = path("worst.replay");
    let jam = ["jam", &run, "--at", "0.9", "--seconds", "8", "--out", &worst];
    let output = touchline(&jam);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(said.contains("a role is doubled") && said.contains("with any 1 packets"), "{said}");
    let replayed = touchline(&["replay", &worst]);
    let said = text(&replayed.stdout);
    assert_eq!(replayed.status.code(), Some(0), "{said}{}", text(&replayed.stderr));
    let early = touchline(&["jam", &run, "--at", "900"]);
    assert_eq!(early.status.code(), Some(2));
    assert!(text(&early.stderr).contains("ends after"), "{}", text(&early.stderr));
}
