//! Matches that are recorded, and played again from their recordings.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::{text, touchline};

/// Records a short match and returns its result.
fn record(path: &Path) -> Value {
    let output = touchline(&["run", "--minutes", "0.1", "--seed", "5", "--json", "--record", path_of(path)]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("the report is JSON")
}

fn path_of(path: &Path) -> &str {
    path.to_str().expect("a plain path")
}

fn folder() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.replay");
    (folder, path)
}

#[test]
fn a_recorded_match_is_played_again_by_another_process() {
    let (_folder, path) = folder();
    let result = record(&path);
    let output = touchline(&["replay", path_of(&path), "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let again: Value = serde_json::from_slice(&output.stdout).expect("the report is JSON");
    for figure in ["digest", "score", "ticks", "driven"] {
        assert_eq!(again[figure], result[figure], "{figure}");
    }
    let said = text(&touchline(&["replay", path_of(&path)]).stdout);
    let ticks = &result["ticks"];
    assert!(said.ends_with(&format!("{ticks} of {ticks} ticks are as they were recorded\n")), "{said}");
}

#[test]
fn what_is_no_sound_replay_is_refused_in_one_line() {
    let (_folder, path) = folder();
    let ticks = record(&path)["ticks"].as_u64().expect("it is a number");
    let whole = ticks / 60 * 60;
    let bytes = fs::read(&path).expect("it is there");
    let refused = |bytes: &[u8], expected: &str| {
        fs::write(&path, bytes).expect("it is written");
        let output = touchline(&["replay", path_of(&path)]);
        assert_eq!(output.status.code(), Some(2));
        assert_eq!(text(&output.stderr), format!("{}: {expected}\n", path.display()));
    };
    let ours = env!("CARGO_PKG_VERSION");
    let newer = [b"touchline replay 99.1\n", &bytes[18..]].concat();
    refused(&newer, &format!("was recorded by version 99.1, and this is version {ours}"));
    let mut spoilt = bytes.clone();
    let last = spoilt.len() - 20;
    spoilt[last] ^= 1;
    refused(&spoilt, &format!("is damaged after tick {whole}"));
    refused(b"", "is not a replay");
    fs::write(&path, &bytes[..bytes.len() - 20]).expect("it is written");
    let said = text(&touchline(&["replay", path_of(&path)]).stdout);
    assert!(
        said.ends_with(&format!(
            "{whole} of {whole} ticks are as they were recorded; the recording was cut off there\n"
        )),
        "{said}"
    );
}

#[test]
fn each_run_of_a_scenario_is_recorded_in_a_file_of_its_own() {
    let (folder, _) = folder();
    let scenario = "assets/scenarios/booking_nearer_takes_over.ron:laboratory";
    let output = touchline(&["check", scenario, "--ablate", "--record", path_of(folder.path())]);
    assert!(output.status.success(), "{}", text(&output.stdout));
    let files =
        fs::read_dir(folder.path()).expect("it is there").map(|file| file.expect("it is a file").path());
    let mut files: Vec<PathBuf> = files.collect();
    files.sort();
    let named = |part: &str| files.iter().filter(|file| path_of(file).contains(part)).count();
    assert_eq!(
        (named("booking_nearer_takes_over.laboratory.seed_1.replay"), named("without_")),
        (1, files.len() / 2),
        "{files:?}"
    );
    for file in &files {
        let output = touchline(&["replay", path_of(file)]);
        assert!(output.status.success(), "{}: {}", file.display(), text(&output.stderr));
    }
}

#[test]
fn a_recording_that_cannot_be_written_is_told_before_the_match() {
    let output = touchline(&["run", "--record", "/no/such/folder/a.replay"]);
    assert_eq!(output.status.code(), Some(5));
    assert_eq!(output.stdout, b"");
    assert!(text(&output.stderr).starts_with("/no/such/folder/a.replay: cannot be written: "));
}

/// A match of a person in the window, which a test of the window recorded in another build of the program.
const OF_A_PERSON: &str = "tests/golden/person.replay";

#[test]
#[cfg_attr(not(target_arch = "x86_64"), ignore = "it was recorded with the vector units of x86-64")]
fn a_match_of_a_person_that_another_build_has_recorded_is_played_again_tick_by_tick() {
    let output = touchline(&["replay", OF_A_PERSON]);
    let anew = "where play is meant to change: INSTA_UPDATE=always cargo test --lib a_match_of_a_person";
    assert!(output.status.success(), "{}{anew}", text(&output.stderr));
    let said = text(&output.stdout);
    assert!(said.ends_with("600 of 600 ticks are as they were recorded\n"), "{said}");
    assert!(fs::metadata(OF_A_PERSON).expect("it is there").len() < 30_000);
}

#[test]
fn the_answer_to_why_is_also_a_page_with_other_futures() {
    let (folder, path) = folder();
    record(&path);
    let page = folder.path().join("why.html");
    let asked = ["why", path_of(&path), "--horizon", "2", "--seeds", "0", "--most", "6", "--json"];
    let output = touchline(&[&asked[..], &["--page", path_of(&page)]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).expect("the report is JSON");
    assert!(report["tried"].as_u64() > Some(0), "{report}");
    assert!(fs::read(&page).expect("it is written").starts_with(b"<!DOCTYPE html>"));
    let nowhere = folder.path().join("nowhere/why.html");
    let output = touchline(&["why", path_of(&path), "--page", path_of(&nowhere)]);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(5), 0), "it is told before the long work");
}
