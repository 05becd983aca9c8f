//! Where a robot's team mates are, in its eyes, and whom it gives way to.

use bevy::prelude::*;

use super::{Perception, PointSet};
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

    /// Where the team mate is that has claimed the ball.
    pub(super) fn carrier(&self) -> Option<Vec2> {
        let (number, _) = self.team_model.carrier?;
        Some(self.model.mate(number)?.position)
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
