//! `touchline league` as a person calls it.

use std::fs;
use std::path::Path;
use std::process::Output;

use super::{program, text};

const TEAMS: [&str; 3] = ["hammerheads_2001", "ball_chasers", "rmit"];

fn league(folder: &Path, more: &[&str]) -> Output {
    let call = [&["league"], &TEAMS[..], &["--minutes", "0.1", "--seed", "3"], more].concat();
    program(&call).current_dir(folder).output().expect("the program starts")
}

#[test]
fn everybody_plays_everybody_and_the_table_can_be_gone_on_with() {
    let folder = tempfile::tempdir().expect("a folder");
    let play = |more: &[&str]| {
        let output = league(folder.path(), more);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let said = play(&["--matches", "4", "--markdown", "league.md"]);
    assert!(said.contains("12 of 12 matches in league.results"), "{said}");
    let written = fs::read_to_string(folder.path().join("league.md")).expect("the table is written");
    for team in TEAMS {
        let line = said.lines().find(|line| line.contains(team)).expect("it is in the table");
        let words: Vec<&str> = line.split_whitespace().collect();
        let counts = &words[words.len() - 4..words.len() - 1];
        let matches: u32 = counts.iter().map(|count| count.parse::<u32>().expect("a count")).sum();
        assert_eq!(matches, 8, "{line}");
        assert!(written.contains(&format!("| {team} |")), "{written}");
    }
    let command = "touchline league hammerheads_2001 ball_chasers rmit --matches 4 --seed 3 --minutes 0.1";
    assert!(written.contains(command), "{written}");
    let table = folder.path().join("league.results/rows.csv");
    let rows = fs::read_to_string(&table).expect("the matches are there");
    assert_eq!(rows.lines().count(), 13);
    // A match that is missing is played again, and nothing else is.
    let mut lines: Vec<&str> = rows.lines().collect();
    lines.pop();
    fs::write(&table, lines.join("\n") + "\n").expect("it is changed");
    let json: serde_json::Value = serde_json::from_str(&play(&["--matches", "4", "--json"])).expect("JSON");
    assert_eq!(json["seeds"], 2);
    assert_eq!(json["rows"].as_array().map(Vec::len), Some(3));
    assert_eq!(fs::read_to_string(&table).expect("the matches are there"), rows);
}

#[test]
fn a_league_that_cannot_be_is_refused_in_one_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let refused = |call: &[&str], named: &str| {
        let output = program(call).current_dir(folder.path()).output().expect("the program starts");
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(named) && message.lines().count() == 1, "{message}");
        assert!(!folder.path().join("league.results").exists());
    };
    refused(&["league", "rmit", "nobody"], "there is no strategy `nobody`");
    refused(&["league", "rmit", "rmit"], "rmit is given twice");
    refused(&["league", "rmit", "art", "--matches", "5"], "--matches: must be even");
    refused(&["league", "rmit", "art", "--minutes", "NaN"], "--minutes: ");
}
