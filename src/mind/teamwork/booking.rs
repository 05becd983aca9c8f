//! Ball booking in a match (TeamChaos, section 4): runs each robot's side of the protocol.

use bevy::ecs::query::QueryData;
use bevy::prelude::*;

use super::team_model::{BookingStatus, TeamModel};
use crate::clock::Clock;
use crate::comms::messages::{Inbox, TeamMessage};
use crate::comms::tcm::TcmClient;
use crate::ids::RobotId;
use crate::mind::world_model::WorldModel;
use crate::protocol::b3p::{B3p, BookingInput, BookingSettings, Distance};
use crate::robot::{Orders, Robot};
use crate::strategy::teamwork::{BallBooking, Mechanism};
use crate::strategy::{Activity, Strategies, Strategy};

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
    activity: &'static Activity,
    inbox: &'static Inbox,
    booking: &'static mut Booking,
    team_model: &'static mut TeamModel,
    client: &'static mut TcmClient,
    orders: &'static Orders,
}

/// One turn of each robot's loop: what was announced, then what it does itself.
pub(super) fn book_ball(clock: Res<Clock>, strategies: Res<Strategies>, mut robots: Query<Booker>) {
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
        let input = robot.turn(strategy, &clock);
        if let Some(book) = robot.booking.0.step(clock.tick, input) {
            robot.client.broadcast(&TeamMessage::Book(book));
        }
        robot.team_model.booking = robot.status(clock.tick);
    }
}

impl BookerItem<'_, '_> {
    /// A robot that knows where it is books the ball that it sees, if that is where its role may go; one that serves a
    /// penalty, off the pitch or where it stands, lets it go.
    fn turn(&self, strategy: &Strategy, clock: &Clock) -> BookingInput {
        if self.orders.is_penalised() {
            return BookingInput::Withdraw;
        }
        let sight = strategy.teamwork.ball_booking.map_or(0, |spec| clock.ticks(spec.sight));
        let known = self.model.ball.filter(|_| self.model.is_localised());
        let in_sight = known.filter(|ball| clock.tick.saturating_sub(ball.seen) <= sight);
        let zone = self.activity.danger_zone(strategy);
        let ball = in_sight.map(|ball| ball.position).filter(|at| zone.contains(*at));
        let distance = ball.map(|at| Distance::from_metres(at.distance(self.model.pose.position)));
        BookingInput::Turn { distance }
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
