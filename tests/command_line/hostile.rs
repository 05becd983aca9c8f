//! Files that are not what they should be, and disks that are full: one line, an exit code, and nothing half-done.

use std::fs::{self, File};
use std::path::Path;

use super::experiment::DESIGN;
use super::{program, text, touchline};

/// More than anybody's file, of zeros that take no room on the disk.
fn huge(path: &Path, beginning: &str) -> String {
    fs::write(path, beginning).expect("the file is written");
    let file = File::options().write(true).open(path).expect("it is there");
    file.set_len(1 << 30).expect("the disk has room for holes");
    path.display().to_string()
}

/// The one line with which a command refuses its input.
#[track_caller]
fn refusal(arguments: &[&str], code: i32) -> String {
    let output = touchline(arguments);
    // `check` tells of its files where others print their results, and how many there were.
    let message = text(&output.stderr) + &text(&output.stdout);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {message}");
    let lines = if arguments[0] == "check" { 2 } else { 1 };
    assert_eq!(message.lines().count(), lines, "{arguments:?}: {message}");
    message
}

#[test]
fn a_file_without_end_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let asset = huge(&folder.path().join("huge.ron"), "(name: \"huge\",");
    assert!(refusal(&["check", &asset], 2).contains("longer than"));
    let strategy = refusal(&["run", "--home", &asset], 2);
    assert!(strategy.contains("longer than"), "{strategy}");
    let version = env!("CARGO_PKG_VERSION");
    let replay = huge(&folder.path().join("huge.replay"), &format!("touchline replay {version}\n"));
    for command in ["replay", "jam"] {
        assert!(refusal(&[command, &replay], 2).contains("longer than"));
    }
    // Grows for as long as it is read.
    assert!(refusal(&["check", "/dev/zero"], 2).contains("longer than"));
    assert!(refusal(&["replay", "/dev/zero"], 2).contains("is not a replay"));
}

#[test]
fn what_is_no_file_or_not_there_any_more_is_said_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().display().to_string();
    let gone = folder.path().join("gone.replay").display().to_string();
    assert!(refusal(&["replay", &path], 2).contains("is a folder"));
    assert!(refusal(&["replay", &gone], 2).contains("cannot be read"));
    assert!(refusal(&["export", &gone, "--html", "/dev/null"], 2).contains("cannot be read"));
}

#[test]
fn deep_nesting_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, begins, ends) in [("lists", "[", "]"), ("structs", "(a:", ")"), ("comments", "/*", "*/")] {
        let path = folder.path().join(format!("{name}.ron"));
        let text = format!("(name: \"x\", machines: {}1{})", begins.repeat(100_000), ends.repeat(100_000));
        fs::write(&path, text).expect("the file is written");
        refusal(&["check", &path.display().to_string()], 2);
    }
}

#[test]
fn a_full_disk_under_a_recording_is_one_line() {
    let message = refusal(&["run", "--minutes", "0.1", "--record", "/dev/full"], 5);
    assert!(message.starts_with("/dev/full: ") && message.contains("No space left"), "{message}");
}

/// The disk is as good as full after 64 KiB: files cannot grow beyond that.
#[test]
fn a_full_disk_under_an_experiment_is_one_line_and_the_rows_so_far_are_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let design = folder.path().join("loss.ron");
    fs::write(&design, DESIGN).expect("the design is written");
    let out = folder.path().join("rows");
    let arguments = ["experiment", &design.display().to_string(), "--out", &out.display().to_string()];
    let limited = |blocks: u32| {
        let whole = program(&arguments);
        let mut shell = std::process::Command::new("sh");
        let limit = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
        shell.arg("-c").arg(limit).arg(whole.get_program()).args(whole.get_args());
        shell.current_dir(env!("CARGO_MANIFEST_DIR")).output().expect("there is a shell")
    };
    let output = limited(4);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(5), "{message}");
    assert!(message.contains("cannot be written") && message.lines().count() == 1, "{message}");
    let output = touchline(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let table = fs::read_to_string(out.join("rows.csv")).expect("there is a table");
    assert_eq!(
        table.lines().count(),
        9,
        "two treatments, two seeds, both sides, and the names of the columns"
    );
}
