//! The four requirements on ball booking (TeamChaos, section 4), watched in a match: for how long each was not met.

use bevy::prelude::*;
use serde::Serialize;
use smallvec::SmallVec;

use super::Record;
use crate::clock::Clock;
use crate::ids::{RobotId, Team};
use crate::mind::teamwork::Booking;
use crate::mind::world_model::WorldModel;
use crate::protocol::b3p::Distance;
use crate::robot::{Orders, Robot, RobotState};
use crate::strategy::Strategies;
use crate::strategy::teamwork::BallBooking;

/// How well a team that books the ball has met the requirements so far. Times are seconds of play.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct BookingFigures {
    /// Requirement 1: a robot that knows the ball was nearer than the one that goes, by more than the threshold.
    pub farther_goes: Span,
    /// Requirement 2: some robot knows the ball, and nobody goes for it.
    pub nobody_goes: Span,
    /// Requirement 3: the ball went from one robot to another and back within [`PING_PONG`].
    pub alternations: u64,
    /// Requirement 4: several go for the ball.
    pub several_go: Span,
    /// How often another robot began to go for the ball.
    pub takeovers: u64,
    #[serde(skip)]
    last: [Option<(u8, f64)>; 2],
}

/// How long something lasted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Span {
    /// In all, s.
    pub total: f64,
    /// At a stretch, s.
    pub longest: f64,
    #[serde(skip)]
    now: f64,
}

/// Two takeovers within this time, back to where the ball was, are an alternation, s.
pub const PING_PONG: f64 = 3.0;

impl Span {
    fn update(&mut self, holds: bool, dt: f64) {
        if holds {
            self.total += dt;
            self.now += dt;
            self.longest = self.longest.max(self.now);
        } else {
            self.now = 0.0;
        }
    }
}

/// A robot in play that knows where the ball is.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bidder {
    number: u8,
    /// From the ball, as the robot believes.
    distance: Distance,
    goes: bool,
}

impl BookingFigures {
    fn update(&mut self, bidders: &[Bidder], threshold: Distance, now: f64, dt: f64) {
        let mut going = bidders.iter().filter(|bidder| bidder.goes);
        let first = going.next();
        let several = going.next().is_some();
        let is_nearer = |booker: &Bidder| {
            bidders.iter().any(|other| !other.goes && other.distance.is_nearer(threshold, booker.distance))
        };
        self.nobody_goes.update(first.is_none() && !bidders.is_empty(), dt);
        self.several_go.update(several, dt);
        self.farther_goes.update(!several && first.is_some_and(is_nearer), dt);
        if let Some(booker) = first.filter(|_| !several) {
            self.note_booker(booker.number, now);
        }
    }

    fn note_booker(&mut self, booker: u8, now: f64) {
        let [before, last] = self.last;
        if last.is_some_and(|(number, _)| number == booker) {
            return;
        }
        self.takeovers += u64::from(last.is_some());
        let is_back = |(number, since): (u8, f64)| number == booker && now - since < PING_PONG;
        // The booker before the last went until the last one began.
        let went_until = before.zip(last).map(|((number, _), (_, until))| (number, until));
        self.alternations += u64::from(went_until.is_some_and(is_back));
        self.last = [last, Some((booker, now))];
    }
}

type Bidding<'a> = (&'a RobotId, &'a Robot, &'a WorldModel, &'a Booking, &'a Orders);

/// Robots that are penalised or off take no part.
pub(super) fn watch_bookings(
    clock: Res<Clock>,
    strategies: Res<Strategies>,
    mut record: ResMut<Record>,
    robots: Query<Bidding>,
) {
    for team in Team::BOTH {
        let Some(spec) = &strategies.of(team).teamwork.ball_booking else { continue };
        let mut bidders: SmallVec<[Bidder; 8]> = (robots.iter())
            .filter(|(id, robot, .., orders)| {
                id.team == team && !robot.health.crashed && orders.state == RobotState::Playing
            })
            .filter_map(|(id, _, model, booking, _)| {
                let goes = booking.0.goes();
                let ball = model.ball.filter(|_| goes || booking.0.sees())?;
                let distance = Distance::from_metres(ball.position.distance(model.pose.position));
                Some(Bidder { number: id.number, distance, goes })
            })
            .collect();
        bidders.sort_unstable_by_key(|bidder| bidder.number);
        let BallBooking { threshold, .. } = *spec;
        let threshold = Distance::from_metres(threshold);
        record.bookings[team.index()].update(&bidders, threshold, clock.now(), f64::from(clock.dt));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const THRESHOLD: Distance = Distance(300);

    fn bidder(number: u8, distance: u32, goes: bool) -> Bidder {
        Bidder { number, distance: Distance(distance), goes }
    }

    #[test]
    fn each_requirement_has_its_own_time() {
        let mut figures = BookingFigures::default();
        let rounds: [&[Bidder]; 4] = [
            &[bidder(1, 900, true), bidder(2, 500, false)],
            &[bidder(1, 900, false), bidder(2, 500, false)],
            &[bidder(1, 900, true), bidder(2, 500, true)],
            &[],
        ];
        for (round, bidders) in rounds.into_iter().enumerate() {
            figures.update(bidders, THRESHOLD, round as f64, 1.0);
        }
        let total = |span: Span| span.total;
        assert_eq!(total(figures.farther_goes), 1.0);
        assert_eq!(total(figures.nobody_goes), 1.0, "a ball that nobody knows is nobody's");
        assert_eq!(total(figures.several_go), 1.0);
    }

    #[test]
    fn the_longest_stretch_is_kept() {
        let mut span = Span::default();
        for holds in [true, true, false, true, true, true, false, true] {
            span.update(holds, 0.5);
        }
        assert_eq!((span.total, span.longest), (3.0, 1.5));
    }

    #[test]
    fn a_ball_that_comes_back_soon_has_alternated() {
        let mut figures = BookingFigures::default();
        for (now, number) in [(0.0, 1), (10.0, 2), (12.0, 1), (20.0, 2), (24.0, 1), (24.1, 1)] {
            figures.update(&[bidder(number, 500, true)], THRESHOLD, now, 0.1);
        }
        assert_eq!((figures.takeovers, figures.alternations), (4, 1));
    }
}
