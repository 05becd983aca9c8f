//! Ball booking in a match (TeamChaos, section 4): runs each robot's side of the protocol.

use bevy::ecs::query::QueryData;
use bevy::prelude::*;

use super::bid::{Pace, bid};
use super::team_model::{BookingStatus, TeamModel};
use crate::clock::Clock;
use crate::comms::messages::{Inbox, TeamMessage};
use crate::comms::tcm::TcmClient;
use crate::ids::RobotId;
use crate::mind::world_model::WorldModel;
use crate::pitch::Pitch;
use crate::protocol::b3p::{B3p, BookingInput, BookingSettings, Distance};
use crate::robot::{Orders, Robot};
use crate::strategy::teamwork::{BallBooking, Mechanism};
use crate::strategy::{Role, Strategies, Strategy};

/// A robot's side of the ball booking.
#[derive(Component, Clone, Debug, PartialEq, Eq)]
pub struct Booking(pub B3p);

impl Booking {
    /// The side of a robot whose team has just kicked off; `None` if its strategy books no balls.
    pub fn new(strategy: &Strategy, id: RobotId, clock: &Clock) -> Option<Booking> {
        let spec = strategy.teamwork.ball_booking.as_ref()?;
        Some(Booking(B3p::new(id.number, settings(spec, clock))))
    }
}

fn settings(spec: &BallBooking, clock: &Clock) -> BookingSettings {
    BookingSettings {
        rules: spec.rules,
        threshold: Distance::from_metres(spec.threshold),
        timeout: clock.ticks(spec.timeout),
        renewal: clock.ticks(spec.renewal),
    }
}

/// A robot that books the ball.
#[derive(QueryData)]
#[query_data(mutable)]
pub(super) struct Booker {
    id: &'static RobotId,
    robot: &'static Robot,
    model: &'static WorldModel,
    role: &'static Role,
    inbox: &'static Inbox,
    booking: &'static mut Booking,
    team_model: &'static mut TeamModel,
    client: &'static mut TcmClient,
    orders: &'static Orders,
}

/// One turn of each robot's loop: what was announced, then what it does itself.
pub(super) fn book_ball(
    clock: Res<Clock>,
    pitch: Res<Pitch>,
    strategies: Res<Strategies>,
    mut robots: Query<Booker>,
) {
    for mut robot in &mut robots {
        let strategy = strategies.of(robot.id.team);
        if !robot.robot.decides(&clock) || !strategy.teamwork.has(Mechanism::BallBooking) {
            continue;
        }
        for received in &robot.inbox.0 {
            if let TeamMessage::Book(book) = received.message {
                robot.booking.0.step(clock.tick, BookingInput::Hear { from: received.from, book });
            }
        }
        let input = robot.turn(strategy, &pitch);
        if let Some(book) = robot.booking.0.step(clock.tick, input) {
            robot.client.broadcast(&TeamMessage::Book(book));
        }
        robot.team_model.booking = robot.status(clock.tick);
    }
}

impl BookerItem<'_, '_> {
    /// A robot that knows where it and the ball are tries to book it, wherever its role may go. Only a ball in the own
    /// penalty area is the goalie's alone, by the laws of the game. One that serves a penalty, off the pitch or where it stands,
    /// lets the ball go.
    fn turn(&self, strategy: &Strategy, pitch: &Pitch) -> BookingInput {
        if self.orders.is_penalised() {
            return BookingInput::Withdraw;
        }
        let goalie = strategy.teamwork.goalie.map(usize::from);
        let is_barred = |at: Vec2| {
            goalie.is_some_and(|goalie| goalie != self.role.0) && pitch.own_penalty_area().contains(at)
        };
        let known = self.model.ball.filter(|ball| self.model.is_localised() && !is_barred(ball.position));
        let bid = known.zip(strategy.teamwork.ball_booking).map(|(ball, spec)| {
            let pace = Pace { speed: self.robot.kind.max_speed(), turn: self.robot.kind.max_turn() };
            bid(spec.bid, self.model.pose, ball.position, pitch.goal_centre(), pace)
        });
        BookingInput::Turn { distance: bid.map(Distance::from_metres) }
    }

    fn status(&self, tick: u64) -> BookingStatus {
        let machine = &self.booking.0;
        match machine.booking().filter(|_| machine.is_booked(tick)) {
            _ if machine.goes() => BookingStatus::Own,
            Some(known) if known.robot_booker != self.id.number => BookingStatus::Mate(known.robot_booker),
            _ => BookingStatus::Free,
        }
    }
}
