//! The match harness that all tests share.

pub mod explorer;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use bevy::prelude::*;
use touchline::data::{AssetFolder, AssetKind, Source};
use touchline::game::{Choice, Match, MatchPlan};
use touchline::geometry::{Pose, Twist};
use touchline::ids::{RobotId, Team};
use touchline::strategy::Strategy;
use touchline::world::ball::Ball;

/// The folder of the shipped assets.
pub fn assets() -> AssetFolder {
    AssetFolder::new(Path::new(env!("CARGO_MANIFEST_DIR")).join("assets"))
}

/// The default match with this seed and halves of this many minutes.
pub fn friendly(seed: u64, half_minutes: f32) -> MatchPlan {
    let choice = Choice { seed, half_minutes: Some(half_minutes), ..Choice::default() };
    MatchPlan::read(&assets(), &choice).expect("the shipped match is sound")
}

/// Plays a match to its end and returns its digest.
pub fn digest_of(plan: &MatchPlan) -> u64 {
    let mut game = Match::new(plan);
    while !game.is_over() {
        game.tick();
    }
    game.record().digest
}

/// The text of a shipped strategy.
pub fn strategy_text(name: &str) -> (PathBuf, String) {
    let path = assets().file(AssetKind::Strategy, name);
    let text = std::fs::read_to_string(&path).expect("the shipped strategy can be read");
    (path, text)
}

/// A shipped strategy with a piece of its text replaced, which must be there.
pub fn changed_strategy(name: &str, from: &str, to: &str) -> Arc<Strategy> {
    let (path, text) = strategy_text(name);
    assert!(text.contains(from), "`{from}` is not in {}", path.display());
    let changed = Source::new(path, text.replace(from, to));
    Arc::new(Strategy::parse(&assets(), &changed, None).expect("the changed strategy is sound"))
}

/// The truth about a robot.
pub fn robot(game: &mut Match, team: Team, number: u8) -> (Pose, Twist) {
    let wanted = RobotId::new(team, number);
    let mut robots = game.world_mut().query::<(&RobotId, &Pose, &Twist)>();
    let found = robots.iter(game.world()).find(|(id, ..)| **id == wanted);
    found.map(|(_, pose, twist)| (*pose, *twist)).expect("the robot is in the match")
}

/// The truth about the ball.
pub fn ball(game: &mut Match) -> (Pose, Twist) {
    let mut balls = game.world_mut().query_filtered::<(&Pose, &Twist), With<Ball>>();
    balls.single(game.world()).map(|(pose, twist)| (*pose, *twist)).expect("a match has one ball")
}
