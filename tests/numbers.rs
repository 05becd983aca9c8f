//! Numbers and places that files, options and hands bring in: refused in one line, or played safely.

mod files;

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use bevy::prelude::*;
use touchline::game::Match;
use touchline::game::requests::{BodyChange, Request, Requests};
use touchline::geometry::{Pose, Twist, unit};
use touchline::ids::{RobotId, Team};
use touchline::lab::scenario::ScenarioPlan;
use touchline::pitch::Pitch;
use touchline::robot::OffPitch;
use touchline::world::ball::Ball;

use crate::support::{assets, ball, robot};

/// A scenario of two robots a side and a script that does nothing bad.
const SCENARIO: &str = r#"(
    name: "Two and two",
    source: "test",
    seconds: 5,
    seeds: 30,
    home: (strategy: "ball_chasers", players: [
        (number: 0, at: (-1.0, 0.5), facing: 0),
        (number: 1, at: (-1.0, -0.5), facing: 0),
    ]),
    away: (strategy: "ball_chasers", players: [(number: 0, at: (1.5, 0.5), facing: 180)]),
    ball: (at: (2.5, 0.0), velocity: (0.5, 0.5)),
    faults: [(kind: Position, between: (1.0, 2.0), act: Delay(0.5))],
    script: [
        (at: 1.0, what: Push(robot: "home 0", by: (0.5, 0.0))),
        (at: 2.0, what: Kidnap(robot: "home 1", to: (-2.0, -1.0), facing: 90)),
        (at: 2.0, what: Ball(at: (0.0, 0.0), velocity: (0.5, 0.0))),
    ],
    expect: [
        Always(what: InZone(what: Ball, zone: Rectangle(min: (-9.0, -9.0), max: (9.0, 9.0)))),
        Eventually(what: Distance(from: Robot("home 0"), to: At(0.0, 0.0), below: 50.0), within: 4),
        Never(what: Speed(of: Ball, above: 40.0), from: 1.0, until: 3.0),
        Probability(of: Finally(what: Speed(of: Ball, below: 40.0)), at_least: 0.7, confidence: 0.9),
    ],
)"#;

/// A scenario's text as a file in a folder of its own.
fn written(text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scenario.ron");
    fs::write(&path, text).expect("the file is written");
    (folder, path)
}

fn refusal(from: &str, to: &str) -> String {
    assert!(SCENARIO.contains(from), "{from}");
    let (_folder, path) = written(&SCENARIO.replacen(from, to, 1));
    ScenarioPlan::read(&assets(), &path.into()).expect_err("the scenario is refused").to_string()
}

#[test]
fn absurd_numbers_of_a_scenario_are_errors_with_line_and_field() {
    let (_folder, path) = written(SCENARIO);
    assert!(ScenarioPlan::read(&assets(), &path.into()).is_ok());
    for (from, to, expected) in [
        ("seconds: 5", "seconds: 1e30", ":4:14: seconds: must be at most 86400 s, not 1e30"),
        (
            "velocity: (0.5, 0.5)",
            "velocity: (1e30, 0)",
            ":11:39: ball.velocity[0]: must be at most 50 m/s, not 1e30",
        ),
        (
            "by: (0.5, 0.0)",
            "by: (0, -1e30)",
            "script[0].what.Push.by[1]: must be at least -50 m/s, not -1e30",
        ),
        ("facing: 90", "facing: 1e9", "script[1].what.Kidnap.facing: must be at most 360°, not 1e9"),
        (
            "between: (1.0, 2.0)",
            "between: (1.0, 1e30)",
            "faults[0].between[1]: must be at most 86400 s, not 1e30",
        ),
        ("Delay(0.5)", "Delay(1e30)", "faults[0].act: must be at most 86400 s, not 1e30"),
        ("max: (9.0, 9.0)", "max: (1e30, 9.0)", "zone.Rectangle.max[0]: must be at most 1000 m, not 1e30"),
        ("below: 50.0", "below: 1e30", "Distance.below: must be at most 1000 m, not 1e30"),
        ("above: 40.0", "above: 1e30", "Speed.above: must be at most 50 m/s, not 1e30"),
        ("At(0.0, 0.0)", "At(1e30, 0.0)", "Distance.to.At[0]: must be at most 1000 m, not 1e30"),
    ] {
        let error = refusal(from, to);
        assert!(error.contains(expected), "{error}");
        assert_eq!(error.lines().count(), 1);
    }
}

#[test]
fn starting_places_in_each_other_or_in_a_wall_are_refused_with_both_places() {
    for (from, to, expected) in [
        (
            "at: (-1.0, -0.5)",
            "at: (-1.0, 0.5)",
            ":8:25: home.players[1].at: home 1 at (-1, 0.5) would stand in home 0, which is at (-1, 0.5) by \
             home.players[0].at",
        ),
        (
            "at: (1.5, 0.5)",
            "at: (-0.95, 0.5)",
            "away.players[0].at: away 0 at (-0.95, 0.5) would stand in home 0",
        ),
        (
            "at: (1.5, 0.5)",
            "at: (4.4, 2.4)",
            "away.players[0].at: away 0 at (4.4, 2.4) would stand in a wall",
        ),
        (
            "at: (2.5, 0.0)",
            "at: (-4.89, 0.99)",
            ":11:16: ball.at: the ball at (-4.89, 0.99) would stand in a wall",
        ),
        ("at: (2.5, 0.0)", "at: (1.6, 0.6)", "ball.at: the ball at (1.6, 0.6) would stand in away 0"),
    ] {
        let error = refusal(from, to);
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn the_program_refuses_absurd_numbers_with_one_line() {
    let (_folder, path) = written(&SCENARIO.replacen("seconds: 5", "seconds: 1e30", 1));
    let path = path.to_string_lossy();
    for arguments in [
        &["run", "--minutes", "1e30"][..],
        &["run", "--minutes", "inf"],
        &["run", "--minutes", "0"],
        &["run", "--minutes=-1"],
        &["play", "--minutes", "1e30"],
        &["play", &path],
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_touchline"))
            .args(arguments)
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .env_remove("DISPLAY")
            .env_remove("WAYLAND_DISPLAY")
            .output()
            .expect("the program starts");
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert_eq!(message.trim().lines().count(), 1, "{arguments:?}: {message}");
        assert!(message.contains("must be at"), "{message}");
    }
}

/// The scenario with another script, as a running match.
fn playing(script: &str) -> Match {
    let (start, rest) = SCENARIO.split_once("script: [").expect("it has a script");
    let (_, end) = rest.split_once("    ],\n").expect("the script ends");
    let (_folder, path) = written(&format!("{start}script: [{script}],\n{end}"));
    let plan = ScenarioPlan::read(&assets(), &path.into()).unwrap_or_else(|error| panic!("{error}"));
    Match::new(&plan.with_seed(1))
}

/// The fastest that anything moves within a second, m/s, while the match's own robots drive no faster than 0.92.
fn fastest(game: &mut Match) -> f32 {
    let mut fastest = 0.0_f32;
    for _ in 0..60 {
        game.tick();
        for (team, number) in [(Team::Home, 0), (Team::Home, 1), (Team::Away, 0)] {
            fastest = fastest.max(robot(game, team, number).1.linear.length());
        }
        fastest = fastest.max(ball(game).1.linear.length());
    }
    fastest
}

#[test]
fn what_a_script_puts_where_something_is_finds_room_and_nothing_flies_off() {
    for script in [
        r#"(at: 0, what: Kidnap(robot: "home 1", to: (-1.0, 0.5), facing: 90))"#,
        r#"(at: 0, what: Kidnap(robot: "home 1", to: (4.4, 2.4), facing: 180))"#,
        r#"(at: 0, what: Kidnap(robot: "home 1", to: (2.5, 0.0), facing: 0))"#,
        r#"(at: 0, what: Ball(at: (-1.0, 0.5)))"#,
        r#"(at: 0, what: Ball(at: (-4.89, 0.99)))"#,
    ] {
        let mut game = playing(script);
        let fastest = fastest(&mut game);
        assert!(fastest < 1.4, "{script}: {fastest} m/s");
    }
}

#[test]
fn what_is_put_down_in_a_free_place_is_put_exactly_there() {
    let mut game = playing(r#"(at: 0, what: Kidnap(robot: "home 1", to: (-3.0, -1.5), facing: 90))"#);
    game.tick();
    let (pose, _) = robot(&mut game, Team::Home, 1);
    assert!(pose.position.distance(Vec2::new(-3.0, -1.5)) < 0.02, "{pose:?}");
}

#[test]
fn however_hard_something_is_pushed_it_stays_on_the_pitch() {
    let mut game = playing("");
    for tick in 0..200 {
        let (push, at) = (Vec2::new(1e30, -1e30), Vec2::new(0.0, 1e30));
        let mut requests = game.world_mut().resource_mut::<Requests>();
        if tick % 20 == 0 {
            for team in [Team::Home, Team::Away] {
                requests.ask(Request::Body(BodyChange::Push { robot: RobotId::new(team, 0), by: push }));
            }
            requests.ask(Request::Body(BodyChange::Ball { at: Vec2::ZERO, velocity: push }));
        }
        if tick == 190 {
            requests.ask(Request::Body(BodyChange::Ball { at, velocity: Vec2::ZERO }));
        }
        game.tick();
        if tick < 190 {
            assert_on_pitch(&mut game);
        }
        assert!(ball(&mut game).0.is_finite());
    }
}

#[test]
fn nothing_moves_faster_than_50_metres_or_turns_faster_than_100_radians_a_second_whatever_pushes_it() {
    let mut game = playing("");
    let (mut fastest, mut fastest_turn) = (0.0_f32, 0.0_f32);
    for tick in 0..300_u16 {
        let way = unit(f32::from(tick));
        let mut requests = game.world_mut().resource_mut::<Requests>();
        // Each push is bounded; that so many add up is what the limit is for.
        for (team, number) in [(Team::Home, 0), (Team::Home, 1), (Team::Away, 0)].repeat(8) {
            requests
                .ask(Request::Body(BodyChange::Push { robot: RobotId::new(team, number), by: 1e30 * way }));
        }
        game.tick();
        assert_on_pitch(&mut game);
        let mut bodies = game.world_mut().query::<(NameOrEntity, &Twist)>();
        for (name, twist) in bodies.iter(game.world()) {
            let (speed, turn) = (twist.linear.length(), twist.angular.abs());
            assert!(speed < 50.01 && turn < 100.01, "{name} at tick {tick}: {speed} m/s, {turn} rad/s");
            (fastest, fastest_turn) = (fastest.max(speed), fastest_turn.max(turn));
        }
    }
    assert!(fastest > 40.0 && fastest_turn > 30.0, "they are pushed: {fastest} m/s, {fastest_turn} rad/s");
}

#[track_caller]
fn assert_on_pitch(game: &mut Match) {
    let pitch = game.world().resource::<Pitch>().clone();
    let mut bodies = game
        .world_mut()
        .query_filtered::<(NameOrEntity, &Pose), (Or<(With<RobotId>, With<Ball>)>, Without<OffPitch>)>();
    for (name, pose) in bodies.iter(game.world()) {
        assert!(pose.is_finite(), "{name} is nowhere: {pose:?}");
        let edge = pitch.margin() + 0.01;
        assert!(pitch.holds(pose.position, edge), "{name} is off the pitch: {pose:?}");
    }
}
