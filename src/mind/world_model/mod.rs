//! The WorldModel stage: percepts and messages become each robot's beliefs.

mod ball_filter;
mod beliefs;
mod progress;
#[cfg(test)]
mod tests;

use bevy::ecs::query::QueryData;
use bevy::prelude::*;

pub use ball_filter::{BallFilter, roll_on};
pub use beliefs::{BallBelief, EXPECTED_ROLLING, MateBelief, RobotBelief, WorldModel};

use crate::clock::Clock;
use crate::comms::messages::Inbox;
use crate::ids::RobotId;
use crate::pitch::Pitch;
use crate::robot::handling::Handling;
use crate::robot::{Odometry, OffPitch, Percepts, PutDown, Robot, RobotStart, SwitchedOn};
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use crate::strategy::Strategies;

pub(super) fn plugin(app: &mut App) {
    app.match_component::<WorldModel>()
        .reflected()
        .starts(|start: &RobotStart, _| start.told.map_or_else(WorldModel::default, WorldModel::told))
        .on(|model, put: &PutDown, _| *model = WorldModel::told(put.told))
        .on(|model, _: &SwitchedOn, _| *model = WorldModel::default());
    app.add_systems(Tick, update_world_models.in_set(TickSystems::WorldModel));
}

/// A robot and what its senses tell.
#[derive(QueryData)]
#[query_data(mutable)]
struct Believer {
    id: &'static RobotId,
    robot: &'static Robot,
    inbox: &'static Inbox,
    percepts: &'static Percepts,
    odometry: &'static Odometry,
    handling: &'static Handling,
    model: &'static mut WorldModel,
}

fn update_world_models(
    clock: Res<Clock>,
    pitch: Res<Pitch>,
    strategies: Res<Strategies>,
    mut robots: Query<Believer, Without<OffPitch>>,
) {
    for believer in &mut robots {
        let BelieverItem { id, robot, inbox, percepts, odometry, handling, mut model } = believer;
        if !robot.decides(&clock) {
            continue;
        }
        let model = &mut *model;
        model.dead_reckon(odometry, &clock);
        if let Some(frame) = &percepts.frame {
            model.see(frame, &robot.sensing, &clock);
        }
        if let Some(chin) = robot.kind.chin.filter(|_| handling.holds()) {
            model.feel_ball(chin.pocket(), clock.tick);
        }
        model.roll_ball(&pitch, &clock);
        model.hear(inbox, clock.tick);
        model.forget_mates(clock.tick, clock.ticks(strategies.of(id.team).teamwork.talk.position_memory));
        model.forget(robot.sensing.memory, &clock);
    }
}
