//! What robots make of claims, goalie news and values that they hear. Positions go to the world model.

use bevy::prelude::*;

use super::picture::TeamPicture;
use crate::clock::Clock;
use crate::comms::messages::{Inbox, Message, Received, Values};
use crate::ids::RobotId;
use crate::robot::Robot;
use crate::strategy::Strategies;

/// A goalie that has not been heard for this long is taken to be back, s.
const GOALIE_MEMORY: f32 = 20.0;

pub(super) fn hear_news(
    clock: Res<Clock>,
    strategies: Res<Strategies>,
    mut robots: Query<(&RobotId, &Robot, &Inbox, &mut TeamPicture)>,
) {
    for (id, robot, inbox, mut picture) in &mut robots {
        if !robot.decides(&clock) {
            continue;
        }
        let memory = clock.ticks(strategies.of(id.team).teamwork.talk.claim_memory);
        for received in &inbox.0 {
            picture.hear(received, clock.tick);
        }
        picture.claims.forget(clock.tick, memory);
        picture.goalie.forget(clock.tick, clock.ticks(GOALIE_MEMORY));
        let ball_memory = clock.ticks(strategies.of(id.team).teamwork.talk.ball_memory);
        picture.reports.forget(clock.tick, ball_memory);
    }
}

/// The last system of the stage: a robot that has decided has read its inbox, and one that does not hear reads nothing.
pub(super) fn take_messages(clock: Res<Clock>, mut robots: Query<(&Robot, &mut Inbox)>) {
    for (robot, mut inbox) in &mut robots {
        if robot.is_due(clock.tick) || !robot.condition.hears() {
            inbox.0.clear();
        }
    }
}

impl TeamPicture {
    fn hear(&mut self, received: &Received, tick: u64) {
        match &received.message {
            Message::HaveBall(message) => {
                self.claims.hear(received.from, message, tick);
                self.note_role(received.from, message.role);
            }
            Message::Goalie(news) => self.goalie.hear(news, tick),
            Message::Values(values) => self.hear_values(received, values, tick),
            Message::BallReport(report) => self.reports.hear(received.from, report, tick),
            Message::Position(_) | Message::RoleSwap(_) | Message::Book(_) | Message::Text(_) => {}
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
