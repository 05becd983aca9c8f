//! Options that contradict each other or have no effect are refused.

use super::{failing_scenario, text, touchline};

#[test]
fn an_option_without_effect_is_refused_and_named() {
    let addresses = "assets/addresses.ron";
    let calls: &[(&[&str], &str)] = &[
        (&["run", "--addresses", addresses], "--addresses"),
        (&["play", "--addresses", addresses], "--addresses"),
        (&["run", "--radio", "good", "--remote", "home:1"], "--radio"),
        (&["run", "--remote", "home:1", "--remote", "home:2", "--remote", "home:1"], "--remote"),
        (&["run", "--pilot", "home:1"], "--pilot"),
        (&["play", "swap_figure_8", "--home", "ball_chasers"], "--home"),
        (&["play", "swap_figure_8", "--match", "friendly"], "--match"),
        (&["play", "swap_figure_8", "--addresses", addresses], "--addresses"),
        (&["play", "swap_figure_8", "--remote", "home:1"], "--remote"),
        (&["play", "swap_figure_8", "--gamecontroller", "127.0.0.1:3838"], "--gamecontroller"),
        (&["play", "swap_figure_8", "--announce", "127.0.0.1:3838"], "--announce"),
        (&["play", "swap_figure_8", "--pilot", "home:1"], "--pilot"),
        (&["robot", "--team", "home", "--number", "1", "--radio", "good"], "--radio"),
        (&["robot", "--team", "home", "--number", "1", "--remote", "home:1"], "--remote"),
        (&["robot", "--team", "home", "--number", "1", "--minutes", "1"], "--minutes"),
        (
            &["robot", "--team", "home", "--number", "1", "--gamecontroller", "127.0.0.1:3838"],
            "--gamecontroller",
        ),
        (&["run", "--patience", "3"], "--patience"),
        (&["run", "--heavy", "--radio", "udp"], "--heavy"),
        (&["run", "--heavy", "--announce", "127.0.0.1:3838"], "--heavy"),
        (&["run", "--chaos-from", "10.0.0.7"], "--chaos"),
        (&["run", "--chaos", "127.0.0.1:65534"], "--chaos: 127.0.0.1:65534"),
        (&["play", "swap_figure_8", "--chaos", "127.0.0.1:7500"], "--chaos"),
        (&["robot", "--team", "home", "--number", "1", "--chaos", "127.0.0.1:7500"], "--chaos"),
        (&["chaos", "--connect", "127.0.0.1:7500", "--robot", "home:1"], "--image"),
        (&["chaos", "--connect", "127.0.0.1:65535", "--robot", "home:1", "--data"], "127.0.0.1:65535"),
        (
            &["chaos", "--connect", "127.0.0.1:7500", "--robot", "home:1", "--image", "picture.jpg"],
            "picture.jpg",
        ),
        (&["check", "--seed", "1"], "--seed"),
        (&["check", "--json"], "--json"),
        (&["duel", "--pilot", "home:1"], "--pilot"),
    ];
    for (call, option) in calls {
        let output = touchline(call);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{call:?}: {message}");
        assert!(message.contains(option), "{call:?}: {message}");
        assert!(output.stdout.is_empty(), "{call:?} printed {}", text(&output.stdout));
    }
}

#[test]
fn nobody_can_drive_a_robot_where_there_is_no_window() {
    if cfg!(not(target_os = "linux")) {
        return;
    }
    let output = touchline(&["play", "--pilot", "home:1", "--minutes", "0.02"]);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(message.starts_with("--pilot: ") && message.lines().count() == 1, "{message}");
}

#[test]
fn ablation_is_refused_where_no_scenario_says_what_it_depends_on() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scenario = failing_scenario(folder.path());
    for file in [&*scenario.to_string_lossy(), "assets/strategies/ball_chasers.ron"] {
        let output = touchline(&["check", "--ablate", file]);
        let said = text(&output.stdout);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("fault --ablate: "), "{said}");
    }
}

#[test]
fn a_seed_survives_every_reader_of_json_or_is_refused() {
    let largest = "9007199254740991";
    let output = touchline(&["run", "--minutes", "0.02", "--json", "--seed", largest]);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("the report is JSON");
    assert_eq!(report["seed"].as_f64().map(|seed| format!("{seed:.0}")), Some(largest.into()));
    for seed in ["9007199254740992", "18446744073709551615"] {
        let output = touchline(&["run", "--seed", seed]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains("--seed") && message.contains(largest), "{message}");
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = failing_scenario(folder.path());
    let scenario = std::fs::read_to_string(&path).expect("it was written");
    let scenario = scenario.replace("seconds: 0.1,", "seconds: 0.1,\n        seeds: [1, 9007199254740992],");
    std::fs::write(&path, scenario).expect("the file is written");
    let output = touchline(&["check", &path.to_string_lossy()]);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains(":5:") && said.contains("seeds[1]: must be at most 9007199254740991"), "{said}");
}
