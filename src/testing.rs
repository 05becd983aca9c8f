//! For unit tests: plain pieces of a match, and strategies from a few lines of text.

use bevy::prelude::*;

use crate::comms::radio::Radio;
use crate::data::{AssetFolder, Source};
use crate::pitch::{BallKind, Pitch};
use crate::robot::{Eyes, Landmarks, MemorySpans, RobotKind, Sensing};
use crate::strategy::Strategy;

/// A size 5 football that rolls straight.
pub const BALL: BallKind = BallKind {
    radius: 0.11,
    mass: 0.43,
    rolling: 0.3,
    sliding: 3.4,
    inertia: 0.667,
    friction: 0.3,
    restitution: 0.2,
    wander: 0.0,
};

/// The shipped pitch: 9 by 5 m.
pub fn pitch() -> Pitch {
    let text = include_str!("../assets/pitches/middle_size_2001.ron");
    Source::new("pitch.ron", text).parse().expect("the shipped pitch is sound")
}

/// The shipped radio that loses nothing.
pub fn perfect_radio() -> Radio {
    let text = include_str!("../assets/radios/perfect.ron");
    Source::new("perfect.ron", text).parse().expect("the shipped radio is sound")
}

/// A strategy of one player that does nothing.
pub fn idle() -> Strategy {
    let role =
        r#"Plays(tag: "I", machine: "m", danger_zone: (min: (0, 0), max: (1, 1)), homebases: [(0, 0)])"#;
    let machine = r#"machines: {"m": (start: "s", states: {"s": ()})}"#;
    strategy("idle", &format!("schemas: {{}}, assemblages: {{}}, {machine}, roles: {{\"idle\": {role}}}"))
}

/// The shipped robot, which decides 20 times a second.
pub fn cye() -> RobotKind {
    let text = include_str!("../assets/robots/cye.ron");
    Source::new("cye.ron", text).parse().expect("the shipped robot is sound")
}

/// A strategy of one player with these features, schemas, assemblages, machines and roles, as a file has them.
pub fn strategy(player: &str, pieces: &str) -> Strategy {
    let text = format!(
        "(name: \"test\", robot_kinds: [\"cye\"], players: [\"{player}\"],
          kick_off: (ours: [(-1.0, 0.0)], theirs: [(-1.0, 0.0)]), {pieces})"
    );
    let assets = AssetFolder::new("assets");
    Strategy::parse(&assets, &Source::new("test.ron", text), None).expect("the strategy of the test is sound")
}

/// What a Cye finds its place by, as far as a test is concerned.
pub const LANDMARKS: Landmarks =
    Landmarks { posts: 9.0, beacons: 0.0, lines: 2.0, one: 0.5, line: 0.2, looks_down: 0.0, settle: 1.5 };

/// Eyes that see everything.
pub fn perfect_sensing() -> Sensing {
    let memory = MemorySpans { ball: 3.0, robots: 2.0, ..MemorySpans::default() };
    Sensing { name: "perfect".into(), eyes: Eyes::Perfect, memory }
}
