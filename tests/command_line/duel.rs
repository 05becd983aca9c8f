//! `touchline duel` as a person or a script calls it.

use serde_json::Value;

use super::{text, touchline};

const SHORT: [&str; 5] = ["duel", "--robots", "2v1", "--trials", "4"];

fn json(arguments: &[&str]) -> Value {
    let output = touchline(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("the report is JSON")
}

#[test]
fn a_duel_tells_both_sides_and_their_shares_and_repeats() {
    let call = [&SHORT[..], &["--home", "hammerheads_2001", "--away", "ball_chasers", "--json"]].concat();
    let report = json(&call);
    assert_eq!((&report["first"]["robots"], &report["second"]["robots"]), (&2.into(), &1.into()));
    assert_eq!(report["trials"], 4);
    let count = |value: &Value| value.as_u64().expect("a number of trials");
    let won = ["first", "second"].map(|side| count(&report[side]["brought_out"]["won"]));
    assert_eq!(won[0] + won[1] + count(&report["undecided"]), 4, "{report}");
    assert!(won[0] + won[1] > 0, "nobody ever brought the ball out: {report}");
    assert_eq!(report, json(&call), "equal seeds give equal duels");
}

#[test]
fn people_read_a_share_with_its_interval() {
    let output = touchline(&SHORT);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains(" % [") && said.contains("4 trials, "), "{said}");
}

#[test]
fn a_duel_that_cannot_be_is_refused_in_a_line_that_names_the_option() {
    for (call, named) in [
        (&["duel", "--trials", "3"][..], "--trials: must be even, not 3"),
        (&["duel", "--robots", "5v1"], "--robots: 5 robots are more than the 4 players"),
        (&["duel", "--home", "no_such_team"], "no_such_team"),
    ] {
        let output = touchline(call);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{call:?}: {message}");
        assert!(message.contains(named) && message.lines().count() == 1, "{call:?}: {message}");
    }
    for call in [&["duel", "--robots", "two"][..], &["duel", "--seconds", "0"], &["duel", "--trials", "0"]] {
        let output = touchline(call);
        assert_eq!(output.status.code(), Some(2), "{call:?}");
        assert!(text(&output.stderr).contains(call[1]), "{call:?}: {}", text(&output.stderr));
    }
}
