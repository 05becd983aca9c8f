//! The percepts and features of a strategy, worked out from one robot's beliefs. Pure: beliefs, time and memory are arguments.

mod desirability;
#[cfg(test)]
pub(in crate::mind) mod fixture;
mod input;
mod memory;
mod teammates;
#[cfg(test)]
mod tests;

use bevy::prelude::*;
use smallvec::SmallVec;

pub use input::{Decider, DecisionInput, perception};
pub use memory::Memory;

use crate::geometry::{Pose, Zone, angle, wrap_angle};
use crate::ids::Team;
use crate::mind::schemas::docking::misalignment;
use crate::mind::schemas::memory::Keep;
use crate::mind::schemas::operators::{
    average, closest, difference, farther_than, intercept, merge, midpoint, shifted, sweet_spot, within,
    within_or_closest,
};
use crate::mind::teamwork::{BookingStatus, TeamModel};
use crate::mind::world_model::{EXPECTED_ROLLING, WorldModel, roll_on};
use crate::pitch::Pitch;
use crate::strategy::RoleRef;
use crate::strategy::language::{Feature, Point, Points, ZoneName};
use crate::strategy::teamwork::{Mechanism, Teamwork};

/// A set of points in the team frame. Few enough to need no allocation.
pub type PointSet = SmallVec<[Vec2; 16]>;

/// What a robot has to go on when it decides.
#[derive(Clone, Copy, Debug)]
pub struct Perception<'a> {
    /// The robot's team.
    pub team: Team,
    /// The robot's role, as an index into the strategy's roles; not the sub-role that it acts in.
    pub role: usize,
    /// What the robot believes of the field.
    pub model: &'a WorldModel,
    /// What it believes of its team.
    pub team_model: &'a TeamModel,
    /// What its team arranges.
    pub teamwork: &'a Teamwork,
    /// The pitch.
    pub pitch: &'a Pitch,
    /// The zone of control of the robot's role.
    pub danger_zone: Zone,
    /// The homebase that the robot's role has chosen, m.
    pub homebase: Vec2,
    /// Seconds since the match began.
    pub now: f32,
    /// Seconds since the camera frame that showed the ball last.
    pub ball_age: Option<f32>,
    /// Seconds in the present state.
    pub time_in_state: f32,
    /// Whether the robot's chin holds the ball.
    pub holds_ball: bool,
    /// Whether the drive reports that it is blocked.
    pub bumped: bool,
    /// Which share of the team's messages is left, where somebody counts them.
    pub messages_left: Option<f32>,
    /// Seconds for which it has been told to move and has found itself not to.
    pub stalled_for: f32,
    /// From the robot's centre to its front and the radius of the ball, m.
    pub front: f32,
    /// m.
    pub ball_radius: f32,
}

/// How far ahead a wall is, at the least, for a robot that believes itself beyond it, m.
const MISTAKEN: f32 = 0.01;

impl Perception<'_> {
    fn own(&self) -> Pose {
        self.model.pose
    }

    /// A point as the vector from the robot to it, along the team frame's axes.
    pub fn relative(&self, point: &Point, memory: &mut Memory) -> Option<Vec2> {
        Some(self.point(point, memory)? - self.own().position)
    }

    /// The place of a point in the team frame, if it is known.
    pub fn point(&self, point: &Point, memory: &mut Memory) -> Option<Vec2> {
        match point {
            Point::Ball => Some(self.model.ball?.position),
            Point::TeamBall => self.team_ball(),
            Point::BallIn(seconds) => {
                let ball = self.model.ball?;
                Some(roll_on(ball.position, ball.velocity, EXPECTED_ROLLING, *seconds).0)
            }
            Point::OurGoal => Some(-self.pitch.goal_centre()),
            Point::TheirGoal => Some(self.pitch.goal_centre()),
            Point::Homebase => Some(self.homebase),
            Point::Own => Some(self.own().position),
            Point::Carrier => self.carrier(),
            Point::Booker => match self.team_model.booking {
                BookingStatus::Mate(number) => Some(self.model.mate(number)?.position),
                BookingStatus::Free | BookingStatus::Own => None,
            },
            Point::Teammate(role) => Some(self.model.mate(self.team_model.holder_of(role.index)?)?.position),
            Point::SupportSpot { behind, aside } => self.support_spot(*behind, *aside),
            Point::AwayFromGoalie { x, y } => {
                Some(Vec2::new(*x, self.team_model.goalie.away(*y, self.own().position)))
            }
            Point::OptimalPosition(tasks) => self.optimal_position(tasks),
            Point::At(place) => Some(*place),
            Point::Closest(of) => {
                let own = self.own().position;
                closest(shifted(self.points(of, memory), -own)).map(|offset| offset + own)
            }
            Point::Average(of) => average(self.points(of, memory)),
            Point::Midpoint(a, b) => Some(midpoint(self.point(a, memory)?, self.point(b, memory)?)),
            Point::Moved { of, from, to } => {
                let way = difference(self.point(to, memory)?, self.point(from, memory)?);
                Some(self.point(of, memory)? + way)
            }
            Point::Toward { from, to, distance } => {
                let from = self.point(from, memory)?;
                let way = (self.point(to, memory)? - from).normalize_or_zero();
                Some(from + way * *distance)
            }
            Point::SweetSpot { of, toward, offset } => {
                Some(sweet_spot(self.point(of, memory)?, self.point(toward, memory)?, *offset))
            }
            Point::Intercept { max_speed } => {
                let ball = self.model.ball?;
                let own = self.own().position;
                Some(own + intercept(ball.position - own, ball.velocity, *max_speed))
            }
            Point::Into { zone, point } => Some(self.zone(zone).clamp(self.point(point, memory)?)),
            Point::Named(name) => unreachable!("the name {name} was replaced when the strategy was loaded"),
        }
    }

    /// The places of a set in the team frame.
    pub fn points(&self, points: &Points, memory: &mut Memory) -> PointSet {
        let own = self.own().position;
        match points {
            Points::Teammates => self.teammates(),
            Points::Superiors => self.superiors(),
            Points::Peers => self.peers(),
            Points::Claimant => self.carrier().into_iter().collect(),
            Points::Opponents => self.model.of_team(self.team.opponent()).collect(),
            Points::Walls => {
                // A robot that believes itself beyond a wall is mistaken, and the wall is still between it and the world.
                let half = self.pitch.half_size().max(own.abs() + MISTAKEN);
                let feet = [(half.x, own.y), (-half.x, own.y), (own.x, half.y), (own.x, -half.y)];
                feet.into_iter().map(Vec2::from).collect()
            }
            Points::These(list) => list.iter().filter_map(|point| self.point(point, memory)).collect(),
            Points::Union(sets) => {
                (sets.iter()).fold(PointSet::new(), |all, set| merge(all, self.points(set, memory)).collect())
            }
            Points::Within { of, radius } => {
                let relative = shifted(self.points(of, memory), -own);
                shifted(within(relative, *radius), own).collect()
            }
            Points::WithinOrClosest { of, radius } => {
                let relative: PointSet = shifted(self.points(of, memory), -own).collect();
                shifted(within_or_closest(relative, *radius), own).collect()
            }
            Points::FartherThan { of, from, radius } => {
                let set = self.points(of, memory);
                match self.point(from, memory) {
                    Some(from) => farther_than(set, *radius, from).collect(),
                    None => set,
                }
            }
            Points::Shifted { of, by } => shifted(self.points(of, memory), *by).collect(),
            Points::Remember { of, seconds, merge, blend, slot } => {
                let readings = self.points(of, memory);
                let remembered = memory.remembered(*slot);
                let keep = Keep { seconds: *seconds, merge: *merge, blend: *blend };
                remembered.update(readings, self.now, &keep);
                remembered.points().collect()
            }
            Points::Named(name) => unreachable!("the name {name} was replaced when the strategy was loaded"),
        }
    }

    fn zone(&self, zone: &ZoneName) -> Zone {
        match zone {
            ZoneName::DangerZone => self.danger_zone,
            ZoneName::PenaltyArea => self.pitch.own_penalty_area(),
            ZoneName::Exactly(zone) => *zone,
            ZoneName::Named(name) | ZoneName::DangerZoneOf(RoleRef { name, .. }) => {
                unreachable!("the name {name} was replaced when the strategy was loaded")
            }
        }
    }

    /// Whether a statement holds. Every part of it is asked, so that memories do not depend on the order of its parts.
    pub fn holds(&self, feature: &Feature, memory: &mut Memory) -> bool {
        match feature {
            Feature::Always => true,
            Feature::Not(what) => !self.holds(what, memory),
            Feature::All(list) => self.count(list, memory) == list.len(),
            Feature::Any(list) => self.count(list, memory) > 0,
            Feature::Known(point) => self.point(point, memory).is_some(),
            Feature::BallSeenWithin(seconds) => self.ball_age.is_some_and(|age| age <= *seconds),
            Feature::Near { a, b, radius } => {
                self.distance(a, b, memory).is_some_and(|distance| distance < *radius)
            }
            Feature::NearLatch { a, b, enter, leave, slot } => {
                let distance = self.distance(a, b, memory).unwrap_or(f32::INFINITY);
                memory.hysteresis(*slot).update(distance, *enter, *leave)
            }
            Feature::NearerThan { a, b } => match (self.relative(a, memory), self.relative(b, memory)) {
                (Some(a), Some(b)) => a.length_squared() < b.length_squared(),
                (Some(_), None) => true,
                (None, _) => false,
            },
            Feature::In { zone, point } => {
                self.point(point, memory).is_some_and(|point| self.zone(zone).contains(point))
            }
            Feature::Facing { point, within } => self.relative(point, memory).is_some_and(|offset| {
                let off = wrap_angle(angle(offset) - self.own().heading).abs();
                offset != Vec2::ZERO && off <= within.to_radians()
            }),
            Feature::BehindBall { toward, within } => {
                let ball = self.relative(&Point::Ball, memory);
                let goal = self.relative(toward, memory);
                ball.zip(goal).is_some_and(|(ball, goal)| misalignment(ball, goal) <= within.to_radians())
            }
            Feature::BallInScoop { gap, aside } => self.model.ball.is_some_and(|ball| {
                let local = self.own().to_local(ball.position);
                let free = local.x - self.front - self.ball_radius;
                local.x > 0.0 && free <= *gap && local.y.abs() <= *aside
            }),
            Feature::On(mechanism) => self.teamwork.has(*mechanism),
            Feature::InRole(role) => usize::from(role.index) == self.role,
            Feature::HasBall => self.team_model.has_ball,
            Feature::TeammateHasBall(roles) => self.team_model.carrier.is_some_and(|carrier| {
                carrier.has_one_of(roles.iter().map(|role| role.index), self.teamwork)
            }),
            Feature::SuperiorHasBall => {
                self.team_model.carrier.is_some_and(|carrier| carrier.outranks(self.role, self.teamwork))
            }
            Feature::HasBooked => self.team_model.booking == BookingStatus::Own,
            Feature::TeammateHasBooked => matches!(self.team_model.booking, BookingStatus::Mate(_)),
            Feature::MayExecute(action) => self.team_model.action == Some(*action),
            Feature::HoldsBall => self.holds_ball,
            Feature::GoalieIsOut => {
                self.teamwork.has(Mechanism::GoalieSupport) && self.team_model.goalie.is_out
            }
            Feature::Bumped => self.bumped,
            Feature::MessagesLeftBelow(share) => self.messages_left.is_some_and(|left| left < *share),
            Feature::Stalled(seconds) => self.stalled_for >= *seconds,
            Feature::After(seconds) => self.time_in_state >= *seconds,
            Feature::HoldFor { what, seconds, slot } => {
                let input = self.holds(what, memory);
                memory.hold_for(*slot).update(input, self.now, *seconds)
            }
            Feature::Lasting { what, seconds, slot } => {
                let input = self.holds(what, memory);
                memory.lasting(*slot).update(input, self.now, *seconds)
            }
            Feature::Watchdog { what, patience, seconds, slot } => {
                let input = self.holds(what, memory);
                memory.watchdog(*slot).update(input, self.now, *patience, *seconds)
            }
            Feature::Is(name) => unreachable!("the name {name} was replaced when the strategy was loaded"),
        }
    }

    /// How many statements hold.
    fn count(&self, list: &[Feature], memory: &mut Memory) -> usize {
        list.iter().filter(|part| self.holds(part, memory)).count()
    }

    fn distance(&self, a: &Point, b: &Point, memory: &mut Memory) -> Option<f32> {
        Some(self.point(a, memory)?.distance(self.point(b, memory)?))
    }
}
