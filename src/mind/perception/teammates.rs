//! Where a robot's team mates are, in its eyes, and whom it gives way to.

use bevy::prelude::*;
use smallvec::SmallVec;

use super::{Perception, PointSet};
use crate::ids::PlayerNumber;
use crate::mind::positioning::{FieldView, optimal_position};
use crate::mind::teamwork::{BallEstimate, BookingStatus, Carrier, fuse};
use crate::mind::world_model::MateBelief;
use crate::strategy::language::CoverTask;
use crate::strategy::teamwork::{Mechanism, TeammatesBy};

/// How far from the walls a supporting robot stays, m.
const SUPPORT_MARGIN: f32 = 0.4;

impl Perception<'_> {
    /// The team mates to be avoided, by what the strategy lets a robot know them.
    pub(super) fn teammates(&self) -> PointSet {
        if !self.teamwork.has(Mechanism::TeammateAvoidance) {
            return PointSet::new();
        }
        let heard = self.model.mates.iter().map(|mate| mate.position);
        match self.teamwork.teammates_by {
            TeammatesBy::Sight => self.model.of_team(self.team).collect(),
            TeammatesBy::Messages => heard.collect(),
            TeammatesBy::MessagesAndSight => heard.chain(self.model.strangers(self.team)).collect(),
        }
    }

    /// The team mates that rank above the robot. Markers tell no rank, so those known by sight alone count among them.
    pub(super) fn superiors(&self) -> PointSet {
        if !self.teamwork.has(Mechanism::HierarchicalAvoidance) {
            return PointSet::new();
        }
        let (own, ranks) = (self.role, self.teamwork);
        self.teammates_ranked(|role| ranks.outranks(role, own), true)
    }

    /// The team mates that rank neither above nor below the robot: all of them where there is no hierarchy.
    pub(super) fn peers(&self) -> PointSet {
        if !self.teamwork.has(Mechanism::HierarchicalAvoidance) {
            return self.teammates();
        }
        let (own, ranks) = (self.role, self.teamwork);
        self.teammates_ranked(|role| !ranks.outranks(role, own) && !ranks.outranks(own, role), false)
    }

    /// The team mates whose roles fit, and with `strangers` those whose roles are not known.
    fn teammates_ranked(&self, fits: impl Fn(usize) -> bool, strangers: bool) -> PointSet {
        if !self.teamwork.has(Mechanism::TeammateAvoidance) {
            return PointSet::new();
        }
        let role = |number| self.team_model.roles.of(number).map(usize::from);
        let heard = self.model.mates.iter().filter(|mate| role(mate.number).is_some_and(&fits));
        let heard = heard.map(|mate| mate.position);
        match self.teamwork.teammates_by {
            TeammatesBy::Messages => heard.collect(),
            TeammatesBy::MessagesAndSight if strangers => {
                heard.chain(self.model.strangers(self.team)).collect()
            }
            TeammatesBy::MessagesAndSight => heard.collect(),
            TeammatesBy::Sight if strangers => self.model.of_team(self.team).collect(),
            TeammatesBy::Sight => PointSet::new(),
        }
    }

    /// Where the team mate is that has the ball.
    pub(super) fn carrier(&self) -> Option<Vec2> {
        match self.team_model.carrier? {
            Carrier::Known(number, _) => Some(self.model.mate(number)?.position),
            Carrier::Seen { at, .. } => Some(at),
        }
    }

    /// Where the ball is by the global map: what the robot saw itself and what its mates tell, fused; or if the strategy does
    /// not fuse, its own belief or else the freshest report.
    pub(super) fn team_ball(&self) -> Option<Vec2> {
        let (own, fusion) = (self.own().position, &self.teamwork.global_map);
        let seen = self.model.ball.map(|ball| ball.position);
        if !fusion.fused {
            return seen.or(self.team_model.map.freshest());
        }
        let mine = seen.zip(self.ball_age).map(|(position, age)| BallEstimate {
            position,
            deviation: fusion.own_deviation(position.distance(own), age),
        });
        let place = |number| self.model.mate(number).map(|mate| mate.position);
        let heard = self.team_model.map.estimates(fusion, self.now, self.pitch.half_size().x, place);
        let estimates: SmallVec<[BallEstimate; 8]> = mine.into_iter().chain(heard).collect();
        Some(fuse(&estimates, fusion.gate)?.position)
    }

    /// The robot's own place among those of the team mates that leave the ball to another. It knows of the mates that tell it
    /// where they are.
    pub(super) fn optimal_position(&self, tasks: &[CoverTask]) -> Option<Vec2> {
        let (own, ball) = (self.own().position, self.team_ball()?);
        let goalie = self.teamwork.goalie.and_then(|role| self.team_model.holder_of(role));
        let at_ball = self.mate_at_ball(ball, goalie);
        let is_busy = |number: PlayerNumber| Some(number) == goalie || Some(number) == at_ball;
        let (busy, free): (Vec<_>, Vec<_>) = self.model.mates.iter().partition(|mate| is_busy(mate.number));
        let places = |mates: Vec<&MateBelief>| mates.into_iter().map(|mate| mate.position).collect();
        let (busy, mut robots): (PointSet, PointSet) = (places(busy), places(free));
        robots.insert(0, own);
        let opponents: PointSet = self.model.of_team(self.team.opponent()).collect();
        // A body's length.
        let room = 2.0 * self.front;
        let view = FieldView { pitch: self.pitch, ball, busy: &busy, opponents: &opponents, room };
        optimal_position(&view, tasks, &robots, 0)
    }

    /// The mate that has booked the ball; while nobody has, the one in the field that is nearest to it and nearer than the robot.
    fn mate_at_ball(&self, ball: Vec2, goalie: Option<PlayerNumber>) -> Option<PlayerNumber> {
        if let BookingStatus::Mate(number) = self.team_model.booking {
            return Some(number);
        }
        let way = |mate: &&MateBelief| mate.position.distance_squared(ball);
        let in_field = self.model.mates.iter().filter(|mate| Some(mate.number) != goalie);
        let nearest = in_field.min_by(|a, b| way(a).total_cmp(&way(b)))?;
        (way(&nearest) < self.own().position.distance_squared(ball)).then_some(nearest.number)
    }

    /// Behind and to one side of the carrier, on its way to the opponents' goal (section VI-C, figure 6).
    pub(super) fn support_spot(&self, behind: f32, aside: f32) -> Option<Vec2> {
        let carrier = self.carrier()?;
        let way = (self.pitch.goal_centre() - carrier).try_normalize().unwrap_or(Vec2::X);
        let half = self.pitch.half_size() - SUPPORT_MARGIN;
        let spot = |side: f32| carrier - way * behind + way.perp() * (side * aside);
        // The side where the robot is, unless a wall is there.
        let own_side = 1.0_f32.copysign(way.perp_dot(self.own().position - carrier));
        let fits = |place: &Vec2| place.abs().cmple(half).all();
        let preferred = spot(own_side);
        let place = if fits(&preferred) { preferred } else { spot(-own_side) };
        Some(place.clamp(-half, half))
    }
}
