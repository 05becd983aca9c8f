//! `touchline tune` as a person calls it.

use std::fs;
use std::path::PathBuf;
use std::process::Output;

use super::{text, touchline};
use crate::support::assets;

/// Matches of six seconds a half.
pub(super) const TUNING: &str = r#"(
    name: "How far to keep",
    common: [HalfMinutes(0.1), Home("hammerheads_2001"), Away("ball_chasers")],
    parameters: [
        (name: "near", at: [(file: "strategies/hammerheads_2001.ron", path: "schemas.round_betters.Swirl.sphere")], low: 0.6, high: 1.5),
        (name: "far", at: [(file: "strategies/hammerheads_2001.ron", path: "schemas.avoid_betters.Avoid.sphere")], low: 0.8, high: 2.4),
    ],
    never_falling: [["near", "far"]],
    objective: (metric: Driven, better: Less),
    training: (first: 1, number: 6),
    held_out: (first: 50, number: 3),
    candidates: 4,
    races: 2,
)"#;

struct Stage {
    folder: tempfile::TempDir,
}

impl Stage {
    fn new(tuning: &str) -> Stage {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("mine.ron"), tuning).expect("the tuning is written");
        Stage { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn call(&self, out: &str) -> Output {
        let [file, out] = [self.path("mine.ron"), self.path(out)].map(|path| path.display().to_string());
        touchline(&["tune", &file, "--out", &out])
    }

    fn tune(&self, out: &str) -> String {
        let output = self.call(out);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stdout)
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect("it is there")
    }
}

/// The lines of a text with its numbers left out.
fn without_numbers(text: &str) -> Vec<String> {
    text.lines().map(|line| line.replace(|c: char| c.is_ascii_digit() || c == '.', "")).collect()
}

#[test]
fn a_tuned_strategy_is_the_strategy_with_other_numbers_and_says_what_it_is_worth() {
    let stage = Stage::new(TUNING);
    let said = stage.tune("out");
    assert_eq!(said.lines().filter(|line| line.starts_with("| held out | 3 |")).count(), 1, "{said}");
    assert!(said.contains("By the seeds that were held out: "), "{said}");
    assert!(said.starts_with(&stage.read("out/report.md")), "{said}");
    let name = "strategies/hammerheads_2001.ron";
    let before = fs::read_to_string(assets().root().join(name)).expect("it is shipped");
    let tuned = stage.read(&format!("out/{name}"));
    let (comment, rest) = tuned.split_once('\n').expect("there are lines");
    assert!(
        comment
            .starts_with("// Fitted by `touchline tune` (How far to keep): near, far; held out, 3 seeds: "),
        "{comment}"
    );
    assert_eq!(without_numbers(rest), without_numbers(&before));
    let changed = before.lines().zip(rest.lines()).filter(|(before, tuned)| before != tuned).count();
    assert!((1..=2).contains(&changed), "{changed}");
    let checked = touchline(&["check", &stage.path("out").join(name).display().to_string()]);
    assert_eq!(checked.status.code(), Some(0), "{}", text(&checked.stdout));
}

#[test]
fn a_tuning_goes_on_from_the_matches_that_are_there_and_comes_to_the_same() {
    let stage = Stage::new(TUNING);
    let whole = stage.tune("out");
    let table = stage.read("out/matches.csv");
    let rows: Vec<&str> = table.split_inclusive('\n').collect();
    assert!(rows.len() > 2 * 4 * 5, "{table}");
    fs::create_dir(stage.path("part")).expect("a folder");
    let cut = [&rows[..rows.len() / 2].concat(), "1,5,tr"].concat();
    fs::write(stage.path("part/matches.csv"), cut).expect("a part is written");
    let part = stage.tune("part");
    assert_eq!(stage.read("part/matches.csv"), table);
    let report = |said: &str| said.rsplit_once("\nThe files").map(|(report, _)| report.to_owned());
    assert!(report(&part).is_some() && report(&part) == report(&whole), "{part}{whole}");

    // What is known is not played again: it is believed. The last match was held out, so that the search goes the same way.
    let last = rows[rows.len() - 1];
    let (match_of, _) = last.trim_end().rsplit_once(',').expect("there are columns");
    let doctored = table.replacen(last, &format!("{match_of},12345.0\n"), 1);
    fs::write(stage.path("out/matches.csv"), &doctored).expect("the table is written");
    stage.tune("out");
    assert!(stage.read("out/matches.csv").contains(",12345.0\n"));
    // Matches from other files are not mixed in.
    let hash = rows[1].split(',').nth(4).expect("a hash");
    fs::write(stage.path("out/matches.csv"), table.replace(hash, "0123456789abcdef")).expect("it is written");
    let refused = stage.call("out");
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("other files"), "{}", text(&refused.stderr));
}

#[test]
fn what_cannot_be_tuned_is_refused_in_one_line_before_anything_is_played() {
    for (was, is, named) in [
        ("Swirl.sphere", "Swirl.spere", "parameters[0].at[0].path"),
        ("low: 0.6, high: 1.5", "low: 0.6, high: 0.7", "parameters[0]"),
        ("[\"near\", \"far\"]", "[\"far\", \"near\"]", "never_falling"),
        ("first: 50", "first: 3", "held_out.first"),
        ("strategies/hammerheads_2001.ron", "radios/good.ron", "parameters[0].at[0].file"),
        ("strategies/hammerheads_2001.ron", "strategies/nobody.ron", "nobody.ron"),
        ("Home(\"hammerheads_2001\")", "Home(\"ball_chasers\")", "none of these numbers"),
        (
            "parameters: [",
            "teams: [(name: \"old\", changes: [Home(\"nobody\")])], parameters: [",
            "teams[0].changes[0].Home",
        ),
    ] {
        let tuning = TUNING.replacen(was, is, 1);
        assert_ne!(tuning, TUNING);
        let stage = Stage::new(&tuning);
        let output = stage.call("out");
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(named), "{message}");
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(!stage.path("out").exists());
    }
}

/// The same tuning of two teams, one of which has the opponent's files.
fn of_two_teams() -> String {
    let teams = "teams: [(name: \"old\", changes: [Home(\"hammerheads_2000\"), Away(\"hammerheads_2001\")]), (name: \"new\")], parameters: [";
    TUNING.replacen("parameters: [", teams, 1)
}

#[test]
fn several_teams_are_tuned_each_as_if_it_were_alone_and_are_reported_together() {
    let (stage, alone) = (Stage::new(&of_two_teams()), Stage::new(TUNING));
    let said = stage.tune("out");
    alone.tune("out");
    assert_eq!(stage.read("out/new/matches.csv"), alone.read("out/matches.csv"));
    assert_ne!(stage.read("out/old/matches.csv"), alone.read("out/matches.csv"));

    let together = stage.read("out/report.md");
    assert!(said.ends_with(&together), "{said}");
    let lines = |text: &str| {
        let lines = text.lines().filter(|line| line.starts_with("| old |") || line.starts_with("| new |"));
        lines.map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(lines(&together).len(), 2, "{together}");

    let folder = stage.path("out").display().to_string();
    let report = || touchline(&["report", &folder]);
    let chapter = text(&report().stdout);
    assert_eq!(lines(&chapter), lines(&together), "{chapter}");
    assert!(chapter.contains("## How far to keep\n"), "{chapter}");
    assert!(chapter.contains(&format!("touchline tune {folder}/design.ron --out {folder}\n")), "{chapter}");
    let table = stage.read("out/old/matches.csv");
    let (most, _) = table.trim_end().rsplit_once('\n').expect("there are rows");
    fs::write(stage.path("out/old/matches.csv"), format!("{most}\n")).expect("it is written");
    let output = report();
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("1 of its matches are missing"), "{}", text(&output.stderr));
}
