//! Which robot may execute which action (section II: Italian Golem): each tells what actions are worth to it, and does what the
//! latest values of all grant to it.

use bevy::ecs::query::QueryData;
use bevy::prelude::*;

use super::swap::has_tight_control;
use super::talk::milliseconds;
use super::team_model::TeamModel;
use crate::clock::Clock;
use crate::comms::messages::{TeamMessage, Values};
use crate::comms::tcm::TcmClient;
use crate::ids::RobotId;
use crate::mind::world_model::WorldModel;
use crate::pitch::{BallKind, Pitch};
use crate::protocol::arbitration::{Bid, QValues, Standing};
use crate::robot::{OffPitch, Orders, Robot};
use crate::strategy::teamwork::Mechanism;
use crate::strategy::{Role, Strategies, Strategy};

/// A robot that bids for actions.
#[derive(QueryData)]
#[query_data(mutable)]
pub(super) struct Bidding {
    id: &'static RobotId,
    robot: &'static Robot,
    model: &'static WorldModel,
    role: &'static Role,
    team_model: &'static mut TeamModel,
    client: &'static mut TcmClient,
    orders: &'static Orders,
    off_pitch: Has<OffPitch>,
}

pub(super) fn arbitrate(
    clock: Res<Clock>,
    pitch: Res<Pitch>,
    strategies: Res<Strategies>,
    ball: Res<BallKind>,
    mut robots: Query<Bidding>,
) {
    for mut robot in &mut robots {
        let strategy = strategies.of(robot.id.team);
        let Some(rules) = &strategy.teamwork.action_arbitration else { continue };
        if !robot.robot.decides(&clock) || !strategy.teamwork.has(Mechanism::ActionArbitration) {
            continue;
        }
        let standing = robot.standing(strategy, &pitch, ball.radius);
        let Some(values) = standing.map(|standing| rules.values(&standing)) else {
            robot.team_model.action = None;
            continue;
        };
        let own = Bid { number: robot.id.number, values: values.into(), age: 0.0 };
        let bids: Vec<Bid> = robot.team_model.bids(&clock).chain([own]).collect();
        robot.team_model.action = rules.allowed(robot.id.number, &bids);
        if strategy.teamwork.has(Mechanism::Messages) {
            robot.tell(values, rules.every, &clock);
        }
    }
}

impl BiddingItem<'_, '_> {
    /// What its values rest upon; `None` for the goalie, who bids for nothing, and for a robot that cannot play or knows no ball.
    fn standing(&self, strategy: &Strategy, pitch: &Pitch, ball_radius: f32) -> Option<Standing> {
        let is_goalie = strategy.teamwork.goalie.is_some_and(|goalie| usize::from(goalie) == self.role.0);
        if is_goalie || self.off_pitch || self.orders.is_penalised() || !self.model.is_localised() {
            return None;
        }
        Some(Standing {
            position: self.model.pose.position,
            heading: self.model.pose.heading,
            ball: self.model.ball?.position,
            tight_control: has_tight_control(self.model, self.robot, ball_radius),
            goal: pitch.goal_centre(),
            doing: self.team_model.action,
        })
    }

    fn tell(&mut self, values: QValues, every: f32, clock: &Clock) {
        let last = &mut self.team_model.last_sent.values;
        if last.is_some_and(|last| clock.tick < last + clock.ticks(every)) {
            return;
        }
        *last = Some(clock.tick);
        let (time, robot, values) = (milliseconds(clock), self.id.number, values.to_vec());
        self.client.broadcast(&TeamMessage::Values(Values { time, robot, values, wish: None }));
    }
}
