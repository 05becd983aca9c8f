//! The Referee stage: looks at the truth and applies the rules, which are pure and live beside this file. What they decide is
//! carried out by [`crate::game`], as people around a pitch do.

mod decision;
mod orders;
mod rulebook;
mod rules;
mod state;
mod witness;

use std::collections::VecDeque;

use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierContextSimulation;

pub use decision::{Decision, NoGoalReason, PlacementReason, RemovalReason};
pub use orders::{Orders, RobotState};
pub use rulebook::{
    BallHolding, DefenderRule, KickOffStyle, LocalGlobal, Out, Pushing, ReturnPlace, RuleBook, Stuck, ThrowIn,
};
pub use rules::{Laws, Observation, RULES, Rule, follow, referee};
pub use state::{MatchState, Phase, Removal};

use crate::clock::Clock;
use crate::gamecontroller::BoxNews;
use crate::ids::RobotId;
use crate::physics::Bodies;
use crate::pitch::Pitch;
use crate::schedule::{Tick, TickSystems};
use witness::{Players, Scene, SeenBall};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Whistles>()
        .init_resource::<Calls>()
        .init_resource::<PenaltiesDue>()
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

/// Robots that are to be taken off whatever they have done, since people or a scenario want it so.
#[derive(Resource, Clone, Debug, Default)]
pub struct PenaltiesDue(pub Vec<RobotId>);

pub(crate) fn judge(
    clock: Res<Clock>,
    (pitch, book): (Res<Pitch>, Res<RuleBook>),
    (mut state, mut due): (ResMut<MatchState>, ResMut<PenaltiesDue>),
    (mut calls, mut whistles): (ResMut<Calls>, ResMut<Whistles>),
    (bodies, simulation): (Bodies, Single<&RapierContextSimulation>),
    ball: Single<SeenBall>,
    players: Players,
    news: Option<Res<BoxNews>>,
) {
    calls.0.clear();
    for robot in due.0.drain(..) {
        if state.remove(robot, f64::INFINITY) {
            calls.0.push(Decision::RobotRemoved { robot, reason: RemovalReason::Ordered });
        }
    }
    if !state.refereed {
        whistles.note(clock.tick, &calls.0);
        return;
    }
    let (ball, ball_pose, ball_body) = *ball;
    let laws = Laws { pitch: &pitch, book: &book, ball_radius: ball.kind.radius };
    let scene = if book.watches_contacts() {
        Scene::whole((ball_pose, ball_body), &players, &bodies, &simulation)
    } else {
        Scene::of_places(ball_pose.position, &players)
    };
    let (seen, dt) = (scene.observation(), f64::from(clock.dt));
    match news {
        None => referee(&laws, &seen, dt, &mut state, &mut calls.0),
        Some(news) => {
            if let Some(view) = &news.view {
                follow(view, &laws, &seen, dt, &mut state, &mut calls.0);
            }
        }
    }
    whistles.note(clock.tick, &calls.0);
}

impl Whistles {
    fn note(&mut self, tick: u64, calls: &[Decision]) {
        for call in calls {
            if self.heard.len() == HEARD {
                self.heard.pop_front();
            }
            self.heard.push_back((tick, *call));
        }
    }
}
