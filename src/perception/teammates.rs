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

    /// The team mates to be avoided that rank above the robot. Markers tell no rank, so those known by sight alone count
    /// among them.
    pub(super) fn superiors(&self) -> PointSet {
        let ranked = self.teamwork.has(Mechanism::HierarchicalAvoidance);
        if !ranked || self.teamwork.teammates_by == TeammatesBy::Sight {
            return self.teammates();
        }
        if !self.teamwork.has(Mechanism::TeammateAvoidance) {
            return PointSet::new();
        }
        let outranks = |number| {
            let role = self.picture.roles.of(number);
            role.is_some_and(|role| self.teamwork.outranks(usize::from(role), self.role))
        };
        let heard = self.model.mates.iter().filter(|mate| outranks(mate.number)).map(|mate| mate.position);
        match self.teamwork.teammates_by {
            TeammatesBy::MessagesAndSight => heard.chain(self.model.strangers(self.team)).collect(),
            TeammatesBy::Messages | TeammatesBy::Sight => heard.collect(),
        }
    }

    /// Where the team mate is that has claimed the ball.
    pub(super) fn carrier(&self) -> Option<Vec2> {
        let (number, _) = self.picture.carrier?;
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
