//! What people see when a strategy file is wrong: file, line, column and field, in one line.

use touchline::data::{AssetKind, Source};
use touchline::protocol::b3p::{Rules, Update};
use touchline::strategy::Strategy;
use touchline::strategy::teamwork::Mechanism;

use crate::support::{assets, strategy_text};

/// The message for the shipped Hammerheads with a piece of text replaced.
fn message_for(from: &str, to: &str) -> String {
    let (_, text) = strategy_text("hammerheads_2001");
    assert!(text.contains(from), "`{from}` is not in the strategy");
    let source = Source::new("hammerheads_2001.ron", text.replacen(from, to, 1));
    Strategy::parse(&assets(), &source, None).expect_err("the strategy is wrong").to_string()
}

#[test]
fn every_shipped_strategy_is_sound() {
    let names = assets().names(AssetKind::Strategy);
    assert!(names.len() >= 2);
    for name in names {
        let path = assets().file(AssetKind::Strategy, &name);
        let strategy = Strategy::read(&assets(), &path, None).strategy;
        let strategy = strategy.unwrap_or_else(|error| panic!("{error}"));
        assert!(!strategy.players.is_empty());
    }
}

#[test]
fn faults_are_named_with_their_place() {
    let faults = [
        ("an unknown state", "go: \"track\"", "go: \"trak\""),
        ("an unknown schema", "(1.0, \"dock\")", "(1.0, \"dok\")"),
        ("an unknown assemblage", "run: \"acquire\"", "run: \"aquire\""),
        ("an unknown feature", "Is(\"stuck\")", "Is(\"stukk\")"),
        ("an unknown machine", "machine: \"forward\"", "machine: \"foreward\""),
        ("an unknown role", "\"floater\", \"forward\"]", "\"floater\", \"striker\"]"),
        ("an unknown zone", "Named(\"goal_area\")", "Named(\"goal\")"),
        ("an unknown word", "turn: Face(Ball)", "turn: Look(Ball)"),
        ("an unknown field", "speed: 0.7", "sped: 0.7"),
        ("a weight that is no number", "(1.0, \"dock\")", "(NaN, \"dock\")"),
        ("a weight in words", "(1.0, \"dock\")", "(\"much\", \"dock\")"),
        ("a speed out of range", "speed: 0.7", "speed: 7.0"),
        ("a wrong type", "robot_kinds: [\"cye\", \"aibo_ers7\"]", "robot_kinds: 3"),
        ("a dead zone that is too large", "dead_zone: 0.15", "dead_zone: 0.9"),
        ("a missing comma", "players: [\"goalie\",", "players: [\"goalie\""),
        (
            "a name that is defined by itself",
            "\"ball_known\": Known(Ball)",
            "\"ball_known\": Not(Is(\"ball_known\"))",
        ),
        ("too few places", "(-4.2, 0.0), (-2.2, 0.8), (-1.2, -1.0), (-0.6, 0.0)", "(-4.2, 0.0)"),
        ("a place in the wrong half", "(-0.6, 0.0)],", "(0.6, 0.0)],"),
        ("no bracket at the end", "    },\n)\n", "    },\n"),
    ];
    let report: String =
        faults.iter().map(|(what, from, to)| format!("{what}:\n    {}\n", message_for(from, to))).collect();
    insta::assert_snapshot!(report);
}

#[test]
fn a_missing_file_is_said_to_be_missing() {
    let path = assets().file(AssetKind::Strategy, "nobody");
    let read = Strategy::read(&assets(), &path, None);
    let message = read.strategy.expect_err("there is no such file").to_string();
    assert!(message.contains("nobody.ron") && message.contains("hammerheads_2001"), "{message}");
}

fn shipped(name: &str) -> Strategy {
    let path = assets().file(AssetKind::Strategy, name);
    Strategy::read(&assets(), &path, None).strategy.unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_teams_of_teamchaos_share_everything_but_the_booking() {
    let (with, without, paper) = (shipped("chaos_b3p"), shipped("chaos_plain"), shipped("chaos_b3p_paper"));
    let mut stripped = with.clone();
    stripped.name.clone_from(&without.name);
    stripped.description.clone_from(&without.description);
    assert!(with.teamwork.has(Mechanism::BallBooking) && with.teamwork.ball_booking.is_some());
    stripped.teamwork.mechanisms = with.teamwork.mechanisms.without(Mechanism::BallBooking);
    stripped.teamwork.ball_booking = None;
    assert_eq!(stripped, without);

    let mut by_the_letter = with.clone();
    by_the_letter.name.clone_from(&paper.name);
    by_the_letter.description.clone_from(&paper.description);
    if let Some(booking) = &mut by_the_letter.teamwork.ball_booking {
        booking.rules = Rules::Paper(Update::Always);
    }
    assert_eq!(by_the_letter, paper);
}

#[test]
fn in_every_state_at_the_ball_a_robot_of_teamchaos_leaves_when_it_loses_the_booking() {
    for machine in &shipped("chaos_b3p").machines {
        let at_ball = machine.states.iter().filter(|state| state.acquires || !state.kicks.is_empty());
        for state in at_ball {
            let ways_out = state.within.iter().flat_map(|outer| &machine.composites[*outer].transitions);
            let leaves = ways_out.into_iter().any(|way| way.label == "must_leave");
            assert!(leaves, "{} of {} has no way out", state.name, machine.name);
        }
    }
}
