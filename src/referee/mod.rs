//! The Referee stage: looks at the truth and applies the rules, which are pure and live beside this file. What they decide is
//! carried out by [`crate::game`], as people around a pitch do.

mod decision;
mod rulebook;
mod rules;
mod state;

use std::collections::VecDeque;

use bevy::prelude::*;
use smallvec::SmallVec;

pub use decision::{Decision, PlacementReason, RemovalReason};
pub use rulebook::RuleBook;
pub use rules::{Laws, Observation, RULES, Rule, referee};
pub use state::{MatchState, Phase, Removal};

use crate::ball::Ball;
use crate::clock::Clock;
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::pitch::Pitch;
use crate::robot::OffPitch;
use crate::schedule::{Tick, TickSystems};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Whistles>()
        .init_resource::<Calls>()
        .add_systems(Tick, judge.in_set(TickSystems::Referee));
}

/// The last decisions, oldest first, with their ticks.
#[derive(Resource, Clone, Debug, Default)]
pub struct Whistles {
    pub heard: VecDeque<(u64, Decision)>,
}

/// Decisions that are kept for people to see.
const HEARD: usize = 64;

/// The decisions of this tick, until they are carried out.
#[derive(Resource, Clone, Debug, Default)]
pub struct Calls(pub Vec<Decision>);

pub(crate) fn judge(
    clock: Res<Clock>,
    (pitch, book): (Res<Pitch>, Res<RuleBook>),
    mut state: ResMut<MatchState>,
    (mut calls, mut whistles): (ResMut<Calls>, ResMut<Whistles>),
    ball: Single<(&Ball, &Pose)>,
    robots: Query<(&RobotId, &Pose), Without<OffPitch>>,
) {
    calls.0.clear();
    if !state.refereed {
        return;
    }
    let (ball, ball_pose) = *ball;
    let mut seen: SmallVec<[(RobotId, Vec2); 8]> =
        robots.iter().map(|(id, pose)| (*id, pose.position)).collect();
    seen.sort_unstable_by_key(|(id, _)| *id);
    let laws = Laws { pitch: &pitch, book: &book, ball_radius: ball.kind.radius };
    let observation = Observation { ball: ball_pose.position, robots: &seen };
    referee(&laws, &observation, f64::from(clock.dt), &mut state, &mut calls.0);
    for call in &calls.0 {
        if whistles.heard.len() == HEARD {
            whistles.heard.pop_front();
        }
        whistles.heard.push_back((clock.tick, *call));
    }
}
