//! `touchline export`, as a person or a script calls it.

use std::path::Path;

use super::{text, touchline};

fn recorded(folder: &Path) -> String {
    let replay = folder.join("match.replay").to_string_lossy().into_owned();
    let output = touchline(&["run", "--minutes", "0.1", "--seed", "5", "--record", &replay]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    replay
}

#[test]
fn a_recorded_match_is_written_as_everything_at_once() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let replay = recorded(folder.path());
    let file = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let [page, log, picture, film] = ["m.html", "m.mcap", "m.svg", "m.gif"].map(file);
    let pictures = ["--svg", &picture, "--at", "2s", "--gif", &film, "--from", "60", "--to", "90"];
    let arguments = [&["export", &replay, "--html", &page, "--mcap", &log, "--json"], &pictures[..]].concat();
    let output = touchline(&arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let counts: serde_json::Value = serde_json::from_slice(&output.stdout).expect("the counts are JSON");
    assert_eq!(counts["frames"], 11);
    assert!(counts["log"]["/poses"].as_u64() > Some(0), "{counts}");
    let begins = |path: &str, start: &[u8]| {
        let bytes = std::fs::read(path).expect("the file is there");
        assert!(bytes.starts_with(start), "{path}");
    };
    begins(&page, b"<!DOCTYPE html>");
    begins(&log, b"\x89MCAP0\r\n");
    begins(&picture, b"<svg");
    begins(&film, b"GIF89a");
}

#[test]
fn what_cannot_be_exported_is_told_in_one_line() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let replay = recorded(folder.path());
    let picture = folder.path().join("m.svg").to_string_lossy().into_owned();
    let beyond = folder.path().join("nowhere/m.svg").to_string_lossy().into_owned();
    let calls: [(&[&str], i32, &str); 5] = [
        (&["export", &replay], 2, "--html"),
        (&["export", &replay, "--svg", &picture, "--at", "9999999"], 2, "9999999"),
        (&["export", "Cargo.toml", "--svg", &picture, "--at", "1"], 2, "Cargo.toml"),
        (&["export", &replay, "--gif", &picture, "--from", "90", "--to", "60"], 2, "--to"),
        (&["export", &replay, "--svg", &beyond, "--at", "1"], 5, "nowhere"),
    ];
    for (arguments, code, word) in calls {
        let output = touchline(arguments);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {message}");
        assert!(message.trim().lines().count() == 1 && message.contains(word), "{arguments:?}: {message}");
    }
    assert!(!Path::new(&picture).exists(), "nothing is written");
}
