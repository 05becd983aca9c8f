//! The Referee stage: looks at the truth and applies the rules, which are pure and live beside this file. What they decide is
//! carried out by [`crate::game`], as people around a pitch do.

mod decision;
mod followed;
mod orders;
mod phase;
mod restraints;
mod rulebook;
mod rules;
mod sight;
mod state;

use std::collections::VecDeque;

use bevy::prelude::*;

pub use decision::{Decision, NoGoalReason, PlacementReason, RemovalReason};
pub use followed::BoxStatement;
pub use orders::orders_of;
pub use phase::Phase;
pub use restraints::Restraints;
pub use rulebook::{
    BallHolding, Charging, DefenderRule, GoaliePushing, KickOffStyle, LocalGlobal, Out, Pushing, ReturnPlace,
    RuleBook, Stuck, ThrowIn,
};
pub use rules::{Laws, Observation, RULES, Rule, follow, referee};
pub use state::{MatchState, Removal};

use crate::clock::Clock;
use crate::ids::RobotId;
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use crate::world::gamecontroller::BoxNews;
use sight::RefereeView;

pub(super) fn plugin(app: &mut App) {
    app.match_resource::<MatchState>();
    app.match_resource::<RuleBook>();
    app.match_resource::<BoxNews>();
    app.match_resource::<Whistles>().starts_empty();
    app.match_resource::<Calls>().starts_empty();
    app.match_resource::<PenaltiesDue>().starts_empty();
    app.add_systems(Tick, judge.in_set(TickSystems::Referee));
}

/// The last decisions, oldest first, with their ticks.
#[derive(Resource, Clone, Debug, Default)]
pub struct Whistles {
    /// The newest decisions with their ticks.
    pub heard: VecDeque<(u64, Decision)>,
}

/// Decisions that are kept for people to see.
const HEARD: usize = 64;

/// The decisions of this tick, until they are carried out.
#[derive(Resource, Clone, Debug, Default)]
pub struct Calls(pub Vec<Decision>);

/// Robots that people or a scenario want off the pitch.
#[derive(Resource, Clone, Debug, Default)]
pub struct PenaltiesDue(pub Vec<RobotId>);

pub(crate) fn judge(
    clock: Res<Clock>,
    ground: RefereeView,
    (mut state, mut due): (ResMut<MatchState>, ResMut<PenaltiesDue>),
    (mut calls, mut whistles): (ResMut<Calls>, ResMut<Whistles>),
    news: Option<Res<BoxNews>>,
) {
    calls.0.clear();
    for robot in due.0.drain(..) {
        let reason = RemovalReason::Ordered;
        if state.remove(robot, f64::INFINITY, reason) {
            calls.0.push(Decision::RobotRemoved { robot, reason });
        }
    }
    if state.refereed {
        let (laws, sight, dt) = (ground.laws(), ground.sight(), f64::from(clock.dt));
        match &news {
            None => referee(&laws, &sight.observation(), dt, &mut state, &mut calls.0),
            // Nothing is decided before the box has spoken.
            Some(news) => {
                if let Some(view) = &news.view {
                    let word =
                        BoxStatement { view, silence: news.silence(&clock), is_lost: news.is_lost(&clock) };
                    follow(&word, &laws, &sight.observation(), dt, &mut state, &mut calls.0);
                }
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
