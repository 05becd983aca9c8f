//! What a robot sends to its team: whether it has the ball, whether the goalie is out, where it is (figure 3).

use bevy::ecs::query::QueryData;
use bevy::prelude::*;

use super::sight::carrier_in_sight;
use super::swap::Swapping;
use super::team_model::{Carrier, TeamModel};
use crate::clock::Clock;
use crate::comms::messages::{BallReport, GoalieNews, HaveBall, Position, TeamMessage, Values};
use crate::comms::tcm::TcmClient;
use crate::geometry::unit;
use crate::ids::RobotId;
use crate::mind::world_model::{BallBelief, WorldModel};
use crate::pitch::Pitch;
use crate::protocol::role_swap::RoleIndex;
use crate::robot::{OffPitch, Orders, Robot};
use crate::strategy::teamwork::{Mechanism, MessageTiming, Teamwork};
use crate::strategy::{Activity, Role, State, Strategies, Strategy};

/// A robot that may claim the ball.
#[derive(QueryData)]
#[query_data(mutable)]
pub(super) struct Claimant {
    id: &'static RobotId,
    robot: &'static Robot,
    model: &'static WorldModel,
    activity: &'static Activity,
    role: &'static Role,
    team_model: &'static mut TeamModel,
    orders: &'static Orders,
}

/// A robot claims the ball while it is within a metre of it in an acquire behaviour, unless somebody above it does.
pub(super) fn claim_ball(
    clock: Res<Clock>,
    pitch: Res<Pitch>,
    strategies: Res<Strategies>,
    mut robots: Query<Claimant>,
) {
    for mut robot in &mut robots {
        if !robot.robot.decides(&clock) {
            continue;
        }
        let strategy = strategies.of(robot.id.team);
        let teamwork = &strategy.teamwork;
        if !teamwork.has(Mechanism::Claims) {
            (robot.team_model.has_ball, robot.team_model.carrier) = (false, None);
            continue;
        }
        let own = robot.is_at_ball(strategy, &clock).then_some((robot.id.number, robot.role.0 as RoleIndex));
        let holder = robot.team_model.claims.holder(own, teamwork);
        let seen = robot.sees_carrier(teamwork, &pitch).filter(|seen| match holder {
            Some(holder) if Some(holder) == own => seen.outranks(robot.role.0, teamwork),
            other => other.is_none(),
        });
        let told = holder.filter(|_| holder != own).map(|(number, role)| Carrier::Known(number, role));
        robot.team_model.has_ball = holder.is_some() && holder == own && seen.is_none();
        robot.team_model.carrier = seen.or(told);
    }
}

impl ClaimantItem<'_, '_> {
    fn is_at_ball(&self, strategy: &Strategy, clock: &Clock) -> bool {
        let talk = &strategy.teamwork.talk;
        let at_it = |ball: &BallBelief| {
            let in_sight = clock.tick.saturating_sub(ball.seen) <= clock.ticks(talk.claim_sight);
            in_sight && ball.position.distance(self.model.pose.position) <= talk.claim_radius
        };
        !self.orders.is_penalised()
            && state(self.activity, strategy).acquires
            && self.model.ball.as_ref().is_some_and(at_it)
    }

    /// The team mate that it sees at the ball, if sight counts.
    fn sees_carrier(&self, teamwork: &Teamwork, pitch: &Pitch) -> Option<Carrier> {
        let area = pitch.own_penalty_area();
        let seen = || carrier_in_sight(self.model, &self.team_model, self.id.team, area, teamwork);
        teamwork.supports_by.sees().then(seen).flatten()
    }
}

fn state<'a>(activity: &Activity, strategy: &'a Strategy) -> &'a State {
    strategy.state(activity.machine(strategy), activity.state)
}

/// A robot that talks to its team.
#[derive(QueryData)]
#[query_data(mutable)]
pub(super) struct Speaker {
    id: &'static RobotId,
    robot: &'static Robot,
    model: &'static WorldModel,
    activity: &'static Activity,
    role: &'static Role,
    swapping: Option<&'static Swapping>,
    team_model: &'static mut TeamModel,
    client: &'static mut TcmClient,
}

pub(super) fn send_news(
    clock: Res<Clock>,
    pitch: Res<Pitch>,
    strategies: Res<Strategies>,
    mut robots: Query<Speaker, Without<OffPitch>>,
) {
    for mut robot in &mut robots {
        let strategy = strategies.of(robot.id.team);
        if !robot.robot.decides(&clock) || !strategy.teamwork.has(Mechanism::Messages) {
            continue;
        }
        // Everything that it could say rests on where it is.
        if !robot.model.is_localised() {
            continue;
        }
        robot.send_have_ball(&strategy.teamwork.talk, &clock);
        if strategy.teamwork.goalie.is_some_and(|goalie| usize::from(goalie) == robot.role.0) {
            robot.send_goalie_news(strategy, &pitch, &clock);
        }
        robot.send_position(&strategy.teamwork.talk, &clock);
        if strategy.teamwork.has(Mechanism::BallReports) {
            robot.send_ball_report(&strategy.teamwork.talk, &clock);
        }
    }
}

impl SpeakerItem<'_, '_> {
    /// A claim is told when it begins, again and again while it lasts, and once when it ends.
    fn send_have_ball(&mut self, talk: &MessageTiming, clock: &Clock) {
        let (has, sent) = (self.team_model.has_ball, self.team_model.last_sent.have_ball);
        let is_due = match sent {
            Some(since) => !has || clock.tick >= since + clock.ticks(talk.claim_every),
            None => has,
        };
        if is_due {
            self.team_model.last_sent.have_ball = has.then_some(clock.tick);
            let (time, robot, role) = (milliseconds(clock), self.id.number, self.role.0 as RoleIndex);
            self.client.broadcast(&TeamMessage::HaveBall(HaveBall { time, robot, have_ball: has, role }));
        }
    }

    fn send_goalie_news(&mut self, strategy: &Strategy, pitch: &Pitch, clock: &Clock) {
        let own = self.model.pose.position;
        let acquires = state(self.activity, strategy).acquires;
        if let Some((behaviour, side)) =
            self.team_model.border.update(own, pitch.own_penalty_area(), acquires, &strategy.teamwork.watch)
        {
            let (time, robot) = (milliseconds(clock), self.id.number);
            self.client.broadcast(&TeamMessage::Goalie(GoalieNews { time, robot, behaviour, side }));
        }
    }

    fn send_position(&mut self, talk: &MessageTiming, clock: &Clock) {
        let is_due = |last: u64| clock.tick >= last + clock.ticks(talk.position_every);
        if !std::mem::take(&mut self.team_model.announce)
            && !self.team_model.last_sent.position.is_none_or(is_due)
        {
            return;
        }
        self.team_model.last_sent.position = Some(clock.tick);
        let pose = self.model.pose;
        let (time, robot) = (milliseconds(clock), self.id.number);
        self.client.broadcast(&TeamMessage::Position(Position {
            time,
            robot,
            position: pose.position,
            heading: unit(pose.heading),
            configuration: self.swapping.and_then(|swapping| swapping.machine.configuration()).cloned(),
        }));
        if let Some((values, wish)) = self.swapping.and_then(|swapping| swapping.values.clone()) {
            self.client.broadcast(&TeamMessage::Values(Values {
                time,
                robot,
                values: values.to_vec(),
                wish,
            }));
        }
    }

    /// A ball is reported again and again while it is in sight.
    fn send_ball_report(&mut self, talk: &MessageTiming, clock: &Clock) {
        let every = clock.ticks(talk.ball_every);
        let is_due = self.team_model.last_sent.ball.is_none_or(|last| clock.tick >= last + every);
        let in_sight = |seen: u64| clock.tick.saturating_sub(seen) <= every;
        if let Some(ball) = self.model.ball.filter(|ball| is_due && in_sight(ball.seen)) {
            self.team_model.last_sent.ball = Some(clock.tick);
            let age = clock.tick.saturating_sub(ball.seen) as f32 * clock.dt;
            let report = BallReport { time: milliseconds(clock), position: ball.position, age };
            self.client.broadcast(&TeamMessage::BallReport(report));
        }
    }
}

/// The time on a robot's clock. All clocks agree.
pub(super) fn milliseconds(clock: &Clock) -> u32 {
    (clock.now() * 1000.0) as u32
}
