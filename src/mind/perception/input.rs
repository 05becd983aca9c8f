//! What a robot decides upon, and how that becomes its [`Perception`].

use bevy::ecs::query::QueryData;

use super::{Memory, Perception};
use crate::clock::Clock;
use crate::ids::RobotId;
use crate::mind::teamwork::TeamModel;
use crate::mind::world_model::WorldModel;
use crate::pitch::{BallKind, Pitch};
use crate::robot::handling::Handling;
use crate::robot::{Odometry, Orders, Robot};
use crate::strategy::{Activity, Role, Strategy};

/// The input of a robot's decisions, with the memory of its operators, for the Behaviour and Motor stages.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct Decider {
    /// What the robot knows.
    pub input: DecisionInput,
    /// What its operators remember.
    pub memory: &'static mut Memory,
}

/// The input of a robot's decisions.
#[derive(QueryData)]
pub struct DecisionInput {
    /// The robot.
    pub id: &'static RobotId,
    /// What it is built as.
    pub robot: &'static Robot,
    /// What it believes of the field.
    pub model: &'static WorldModel,
    /// What its own wheels or legs report.
    pub odometry: &'static Odometry,
    /// What it believes of its team.
    pub team_model: &'static TeamModel,
    /// Its role.
    pub role: &'static Role,
    /// What it does with the ball.
    pub handling: &'static Handling,
    /// What the referee orders.
    pub orders: &'static Orders,
}

/// The perception of a robot in an activity.
pub fn perception<'a>(
    input: &DecisionInputItem<'a, '_>,
    activity: &Activity,
    strategy: &'a Strategy,
    (clock, pitch, ball): (&Clock, &'a Pitch, &BallKind),
) -> Perception<'a> {
    Perception {
        team: input.id.team,
        role: input.role.0,
        model: input.model,
        team_model: input.team_model,
        teamwork: &strategy.teamwork,
        pitch,
        danger_zone: activity.danger_zone(strategy),
        homebase: activity.homebase,
        now: clock.now() as f32,
        ball_age: input.model.ball.map(|ball| clock.seconds_since(ball.seen)),
        time_in_state: clock.seconds_since(activity.since),
        holds_ball: input.handling.holds(),
        bumped: input.odometry.bump.reports,
        messages_left: input.orders.messages_left,
        stalled_for: input.model.stalled_for(clock),
        front: input.robot.kind.body.length / 2.0,
        ball_radius: ball.radius,
    }
}
