//! What robots make of claims, goalie news and values that they hear. Positions go to the world model.

use bevy::prelude::*;

use super::team_model::TeamModel;
use crate::clock::Clock;
use crate::comms::messages::{Inbox, Received, TeamMessage, Values};
use crate::ids::RobotId;
use crate::robot::Robot;
use crate::strategy::Strategies;
use crate::strategy::teamwork::Teamwork;

pub(super) fn hear_news(
    clock: Res<Clock>,
    strategies: Res<Strategies>,
    mut robots: Query<(&RobotId, &Robot, &Inbox, &mut TeamModel)>,
) {
    for (id, robot, inbox, mut team) in &mut robots {
        if !robot.decides(&clock) {
            continue;
        }
        let teamwork = &strategies.of(id.team).teamwork;
        for received in &inbox.0 {
            team.hear(received, teamwork, clock.tick);
        }
        team.claims.forget(clock.tick, clock.ticks(teamwork.talk.claim_memory));
        team.goalie.forget(clock.tick, clock.ticks(teamwork.watch.goalie_memory));
        team.map.forget(clock.tick, clock.ticks(teamwork.talk.ball_memory));
    }
}

/// The last system of the stage: a robot that has decided has read its inbox, and one that does not hear reads nothing.
pub(super) fn take_messages(clock: Res<Clock>, mut robots: Query<(&Robot, &mut Inbox)>) {
    for (robot, mut inbox) in &mut robots {
        if robot.is_due(clock.tick) || !robot.health.hears() {
            inbox.0.clear();
        }
    }
}

impl TeamModel {
    fn hear(&mut self, received: &Received, teamwork: &Teamwork, tick: u64) {
        match &received.message {
            TeamMessage::HaveBall(_) | TeamMessage::Goalie(_) if !teamwork.supports_by.hears() => {}
            TeamMessage::HaveBall(message) => {
                self.claims.hear(received.from, message, tick);
                self.note_role(received.from, message.role);
            }
            TeamMessage::Goalie(news) => self.goalie.hear(news, tick),
            TeamMessage::Values(values) => self.hear_values(received, values, tick),
            TeamMessage::BallReport(report) => self.map.hear(received.from, report, tick),
            TeamMessage::Position(_)
            | TeamMessage::RoleSwap(_)
            | TeamMessage::Book(_)
            | TeamMessage::Text(_) => {}
        }
    }

    fn hear_values(&mut self, received: &Received, values: &Values, tick: u64) {
        let heard = (received.from, values.clone(), tick);
        match self.values.iter_mut().find(|(from, ..)| *from == received.from) {
            Some((_, known, _)) if values.time < known.time => {}
            Some(known) => *known = heard,
            None => self.values.push(heard),
        }
    }
}
