//! The program as a person or a script calls it.

mod coverage;
mod duel;
#[cfg(target_os = "linux")]
mod every_command;
mod experiment;
mod export;
mod fit_eyes;
#[cfg(target_os = "linux")]
mod hostile;
#[cfg(unix)]
mod interrupt;
mod jam;
mod league;
mod options;
mod output;
mod replays;
mod report;
mod soak;
mod tune;

use std::io::{self, PipeWriter};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use touchline::data::AssetKind;

use crate::support::{assets, strategy_text};

/// The program with these arguments, as it is started where there is no display.
pub(crate) fn program(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_touchline"));
    where_there_is_no_display(&mut command).args(arguments);
    command
}

/// An output that nobody reads.
pub(crate) fn closed_pipe() -> PipeWriter {
    let (reader, writer) = io::pipe().expect("the system has pipes");
    drop(reader);
    writer
}

fn where_there_is_no_display(command: &mut Command) -> &mut Command {
    command.current_dir(env!("CARGO_MANIFEST_DIR")).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY")
}

fn touchline(arguments: &[&str]) -> Output {
    program(arguments).output().expect("the program starts")
}

/// Writes a scenario in which the ball is expected where it is not.
fn failing_scenario(folder: &Path) -> PathBuf {
    let path = folder.join("failing.ron");
    let text = r#"(
        name: "The ball is far from where it is",
        source: "a test",
        seconds: 0.1,
        home: (strategy: "ball_chasers", players: [(number: 0, at: (-3, 0))]),
        ball: (at: (2, 2)),
        expect: [Always(what: Distance(from: Ball, to: At(2, 2), above: 3))],
    )"#;
    std::fs::write(&path, text).expect("the file is written");
    path
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_match_prints_its_result_as_json() {
    let output = touchline(&["run", "--minutes", "0.1", "--seed", "5", "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("the report is JSON");
    assert_eq!(report["seed"], 5);
    assert_eq!(report["teams"][1], "Ball chasers");
    assert_eq!(report["digest"].as_str().map(str::len), Some(16));
    let again = touchline(&["run", "--minutes", "0.1", "--seed", "5", "--json"]);
    let again: serde_json::Value = serde_json::from_slice(&again.stdout).expect("the report is JSON");
    assert_eq!(report["digest"], again["digest"], "two processes played the same match differently");
}

#[test]
fn either_team_can_play_either_strategy() {
    let arguments = ["run", "--minutes", "0.1", "--home", "ball_chasers", "--away", "hammerheads_2001"];
    let output = touchline(&arguments);
    assert!(text(&output.stdout).starts_with("Ball chasers"), "{}", text(&output.stdout));
}

#[test]
fn without_a_display_the_match_is_played_headless_and_one_line_says_so() {
    if cfg!(not(target_os = "linux")) {
        return;
    }
    let output = touchline(&["play", "--minutes", "0.1"]);
    assert!(output.status.success());
    assert_eq!(text(&output.stderr).lines().count(), 1, "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("headless"));
    assert!(text(&output.stdout).contains("CMU Hammerheads 2001"));
}

#[test]
fn bad_input_ends_with_one_line_and_exit_code_2() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let broken = folder.path().join("broken.ron");
    let (_, sound) = strategy_text("ball_chasers");
    std::fs::write(&broken, sound.replace("go: \"search\"", "go: \"nowhere\"")).expect("the file is written");
    let broken = broken.to_string_lossy().into_owned();
    let calls: [&[&str]; 6] = [
        &["run", "--home", &broken],
        &["run", "--home", "nobody"],
        &["run", "--match", "nothing"],
        &["run", "--minutes", "NaN"],
        &["play", "--pilot", "home:9"],
        &["--assets", "/nowhere/at/all", "run"],
    ];
    for call in calls {
        let output = touchline(call);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{call:?}: {message}");
        assert_eq!(message.trim().lines().count(), 1, "{call:?}: {message}");
        assert!(output.stdout.is_empty(), "{call:?} printed {}", text(&output.stdout));
    }
    let message = text(&touchline(calls[0]).stderr);
    assert!(message.contains("broken.ron:") && message.contains("nowhere"), "{message}");
}

#[test]
fn check_reads_all_assets() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let shipped = assets();
    for kind in AssetKind::ALL {
        let there = folder.path().join(kind.folder());
        std::fs::create_dir(&there).expect("the folder is made");
        // All scenarios are played by another test.
        let few = if kind == AssetKind::Scenario { 2 } else { usize::MAX };
        for file in shipped.files(kind).expect("they are there").into_iter().take(few) {
            std::fs::copy(&file, there.join(file.file_name().expect("it has a name"))).expect("it is copied");
        }
    }
    let output = touchline(&["check", "--assets", &folder.path().to_string_lossy()]);
    let said = text(&output.stdout);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("2 scenarios") && said.contains("all sound"), "{said}");
    assert_eq!(touchline(&["check", "Cargo.toml"]).status.code(), Some(2));
}

#[test]
fn a_scenario_that_fails_ends_with_exit_code_1_and_says_once_what_all_seeds_have_in_common() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = failing_scenario(folder.path());
    let path = path.to_string_lossy();
    for (call, line) in [(["check", &path], "all 10 seeds, tick 1 "), (["play", &path], "seed 1, tick 1 ")] {
        let output = touchline(&call);
        let said = text(&output.stdout);
        assert_eq!(output.status.code(), Some(1), "{call:?}: {said}");
        assert_eq!(said.matches("tick").count(), 1, "{said}");
        assert!(said.contains(line), "{said}");
    }
}

#[test]
fn the_help_says_what_the_exit_codes_mean() {
    for call in [&["--help"][..], &["run", "--help"], &["play", "--help"], &["check", "--help"]] {
        let said = text(&touchline(call).stdout);
        for line in ["0    done", "1    a scenario failed", "2    bad input", "130  interrupted"] {
            assert!(said.contains(line), "`{line}` is not in: {said}");
        }
    }
}

#[test]
fn a_robot_that_the_match_does_not_have_is_told_who_plays() {
    let output = touchline(&["robot", "--team", "home", "--number", "9"]);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    for word in ["--number", "`home 9`", "home 0, home 1, home 2, home 3, away 0, away 1, away 2, away 3"] {
        assert!(message.contains(word), "{message}");
    }
}

#[test]
fn an_address_that_is_none_is_named_with_its_option() {
    for option in ["--gamecontroller", "--announce"] {
        let output = touchline(&["run", option, "nonsense"]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains("nonsense") && message.contains(option), "{message}");
        assert!(output.stdout.is_empty(), "{option} printed {}", text(&output.stdout));
    }
}

#[test]
fn options_about_the_league_that_have_no_effect_are_refused() {
    let robot = ["robot", "--team", "home", "--number", "1"];
    let calls: [(&[&str], &str); 5] = [
        (&["run", "--announce-version", "19"], "--announce"),
        (&["run", "--announce", "127.0.0.1:9", "--announce-version", "17"], "18, 19 or 20"),
        (&["run", "--league-ports", "127.0.0.1", "--remote", "home:1"], "--remote"),
        (&[&robot[..], &["--league-ports", "127.0.0.1"]].concat(), "--league-ports"),
        (&[&robot[..], &["--announce", "127.0.0.1:9"]].concat(), "--announce"),
    ];
    for (call, word) in calls {
        let output = touchline(call);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{call:?}: {message}");
        assert!(message.contains(word) && output.stdout.is_empty(), "{call:?}: {message}");
    }
}

#[test]
fn a_fault_in_the_addresses_is_named_with_its_line_and_field() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("addresses.ron");
    let path = file.to_string_lossy();
    let good = r#""home 0": "127.0.0.1:7400""#;
    for (bad, words) in [
        (r#""home 1": "127.0.0.1:0""#, [":3:", "home 1", "port other than 0"]),
        (r#""home 1": "127.0.0.1:7400""#, [":3:", "home 1", "that of home 0"]),
        (r#""Home:1": "127.0.0.1:0""#, [":3:", "Home:1", "port other than 0"]),
        (r#""home-0": "127.0.0.1:7401""#, [":3:", "home-0", "is there twice"]),
        (r#""home": "127.0.0.1:7401""#, [":3:", "home", "groups have no address"]),
        (r#""home 1": "nowhere""#, [":3:", "home 1", "socket address"]),
        (r#""nobody": "127.0.0.1:7401""#, [":3:", "nobody", "is nobody"]),
    ] {
        std::fs::write(&file, format!("{{\n    {good},\n    {bad},\n}}\n")).expect("the file is written");
        let output = touchline(&["run", "--radio", "udp", "--addresses", &path]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(message.starts_with(&*path), "{message}");
        for word in words {
            assert!(message.contains(word), "`{word}` is not in: {message}");
        }
    }
}
