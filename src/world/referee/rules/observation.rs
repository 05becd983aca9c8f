//! What rules go by: the laws, what the referee sees, and the questions that several rules ask.

use bevy::prelude::Vec2;

use crate::ids::RobotId;
use crate::pitch::Pitch;
use crate::world::referee::decision::{Decision, RemovalReason};
use crate::world::referee::rulebook::RuleBook;
use crate::world::referee::state::MatchState;

/// What stays the same during a match.
#[derive(Clone, Copy, Debug)]
pub struct Laws<'a> {
    /// The pitch.
    pub pitch: &'a Pitch,
    /// The rule book.
    pub book: &'a RuleBook,
    /// In metres.
    pub ball_radius: f32,
}

/// What the referee sees at one moment, in the pitch frame and in metres.
#[derive(Clone, Copy, Debug)]
pub struct Observation<'a> {
    /// Where the ball is, m.
    pub ball: Vec2,
    /// The robots on the field, sorted by id.
    pub robots: &'a [(RobotId, Vec2)],
    /// The robots that touch the ball, in any order; the robot that holds it need not be among them.
    pub touching: &'a [RobotId],
    /// The robot that has the ball so firmly that nobody else gets at it, under its chin for instance.
    pub held_by: Option<RobotId>,
    /// The robots that touch each other, in any order.
    pub contacts: &'a [(RobotId, RobotId)],
    /// Who pushes whom, in any order: they touch, and the first one drives against the second one.
    pub shoving: &'a [(RobotId, RobotId)],
    /// The robots that stand still, in any order.
    pub still: &'a [RobotId],
}

impl<'a> Observation<'a> {
    /// Ball and robots, of which none touches the ball or another one and none is known to stand still.
    pub fn of(ball: Vec2, robots: &'a [(RobotId, Vec2)]) -> Observation<'a> {
        Observation { ball, robots, touching: &[], held_by: None, contacts: &[], shoving: &[], still: &[] }
    }

    /// Whether two robots touch each other.
    pub(super) fn touch(&self, one: RobotId, other: RobotId) -> bool {
        self.contacts.iter().any(|&(a, b)| (a, b) == (one, other) || (b, a) == (one, other))
    }

    /// Where a robot is that has not been taken off the field.
    pub(super) fn place(&self, robot: RobotId, state: &MatchState) -> Option<Vec2> {
        self.on_field(state).find(|(other, _)| *other == robot).map(|(_, at)| at)
    }

    /// The robots that have not been taken off the field, by id.
    pub(super) fn on_field<'s>(
        &self,
        state: &'s MatchState,
    ) -> impl Iterator<Item = (RobotId, Vec2)> + use<'a, 's> {
        self.robots.iter().copied().filter(|(robot, _)| !state.is_removed(*robot))
    }

    /// The robot on the field that is nearest to a point, of those that are asked for; of equals the first by id.
    pub(super) fn nearest(
        &self,
        state: &MatchState,
        to: Vec2,
        asked: impl Fn(RobotId) -> bool,
    ) -> Option<(RobotId, Vec2)> {
        let asked = self.on_field(state).filter(|(robot, _)| asked(*robot));
        asked.min_by(|(_, a), (_, b)| a.distance(to).total_cmp(&b.distance(to)))
    }
}

/// Where the ball has been put in this sample.
pub(super) fn placed_ball(made: &[Decision]) -> Option<Vec2> {
    made.iter().rev().find_map(|decision| match decision {
        Decision::BallPlaced { at, .. } => Some(*at),
        _ => None,
    })
}

/// Takes a robot off the field, unless another rule has already done so or people have just put it where it is.
pub(super) fn send_off(
    state: &mut MatchState,
    made: &mut Vec<Decision>,
    robot: RobotId,
    seconds: f64,
    reason: RemovalReason,
) {
    let placed = made.iter().any(|decision| match decision {
        Decision::RobotPlaced { robot: placed, .. } => *placed == robot,
        _ => false,
    });
    if !placed && state.remove(robot, seconds.max(0.0), reason) {
        made.push(Decision::RobotRemoved { robot, reason });
    }
}

/// Whether a robot is in its own penalty area.
pub(super) fn is_in_own_area(laws: &Laws, state: &MatchState, robot: RobotId, at: Vec2) -> bool {
    laws.pitch.own_penalty_area().contains(state.attacking(robot.team).turn(at))
}

/// Whether a span of time is over, with room for the rounding of a sum of many steps.
pub(super) fn is_over(seconds: f64, limit: f32) -> bool {
    seconds + ROUNDING >= f64::from(limit)
}

/// Seconds by which a sum of steps may miss its true value.
pub(super) const ROUNDING: f64 = 1e-6;

/// Where robots stand after this sample's decisions.
pub(super) fn standing<'a>(
    observation: &'a Observation,
    state: &'a MatchState,
    made: &'a [Decision],
) -> impl Iterator<Item = Vec2> + 'a {
    let seen = observation.on_field(state).map(move |(robot, at)| {
        let put = made.iter().rev().find_map(|decision| match decision {
            Decision::RobotPlaced { robot: placed, at } if *placed == robot => Some(at.position),
            _ => None,
        });
        put.unwrap_or(at)
    });
    let returned = made.iter().filter_map(|decision| match decision {
        Decision::RobotReturned { at, .. } => Some(at.position),
        _ => None,
    });
    seen.chain(returned)
}
