//! The words inside a strategy: points, sets, zones, features and motor schemas. Each is checked in place; a name is replaced
//! by what it stands for, and a stateful operator gets its slot.

use super::{Resolver, Result, unknown};
use crate::data::Field;
use crate::strategy::RoleRef;
use crate::strategy::language::{Feature, Point, Points, Schema, ZoneName};

impl Resolver<'_> {
    pub(super) fn point(&mut self, point: &mut Point, at: &Field) -> Result<()> {
        match point {
            Point::Named(name) => {
                *point = self.expand(&self.file.percepts, "percept", name, at, |s, p| s.point(p, at))?;
            }
            Point::Ball
            | Point::TeamBall
            | Point::OurGoal
            | Point::TheirGoal
            | Point::Homebase
            | Point::Own
            | Point::Carrier
            | Point::Booker => {}
            Point::Teammate(role) => self.role_ref(role, &at.index(0))?,
            Point::SupportSpot { behind, aside } => {
                self.finite(*behind, &at.key("behind"))?;
                self.finite(*aside, &at.key("aside"))?;
            }
            Point::AwayFromGoalie { x, y } => {
                self.finite(*x, &at.key("x"))?;
                self.not_negative(*y, &at.key("y"))?;
                (*x, *y) = (*x * self.scale.x, *y * self.scale.y);
            }
            Point::BallIn(seconds) => self.not_negative(*seconds, at)?,
            Point::At(place) => {
                self.finite_point(*place, at)?;
                *place *= self.scale;
            }
            Point::Closest(of) | Point::Average(of) => self.points(of, &at.index(0))?,
            Point::Midpoint(a, b) => {
                self.point(a, &at.index(0))?;
                self.point(b, &at.index(1))?;
            }
            Point::Moved { of, from, to } => {
                self.point(of, &at.key("of"))?;
                self.point(from, &at.key("from"))?;
                self.point(to, &at.key("to"))?;
            }
            Point::Toward { from, to, distance } => {
                self.point(from, &at.key("from"))?;
                self.point(to, &at.key("to"))?;
                self.finite(*distance, &at.key("distance"))?;
            }
            Point::SweetSpot { of, toward, offset } => {
                self.point(of, &at.key("of"))?;
                self.point(toward, &at.key("toward"))?;
                self.finite(*offset, &at.key("offset"))?;
            }
            Point::Intercept { max_speed } => self.not_negative(*max_speed, &at.key("max_speed"))?,
            Point::Into { zone, point } => {
                self.zone(zone, &at.key("zone"))?;
                self.point(point, &at.key("point"))?;
            }
        }
        Ok(())
    }

    pub(super) fn points(&mut self, points: &mut Points, at: &Field) -> Result<()> {
        match points {
            Points::Named(name) => {
                *points =
                    self.expand(&self.file.point_sets, "point set", name, at, |s, p| s.points(p, at))?;
            }
            Points::Teammates
            | Points::Opponents
            | Points::Superiors
            | Points::Peers
            | Points::Claimant
            | Points::Walls => {}
            Points::These(list) => {
                for (i, point) in list.iter_mut().enumerate() {
                    self.point(point, &at.index(i))?;
                }
            }
            Points::Union(sets) => {
                for (i, set) in sets.iter_mut().enumerate() {
                    self.points(set, &at.index(i))?;
                }
            }
            Points::Within { of, radius } | Points::WithinOrClosest { of, radius } => {
                self.points(of, &at.key("of"))?;
                self.not_negative(*radius, &at.key("radius"))?;
            }
            Points::FartherThan { of, from, radius } => {
                self.points(of, &at.key("of"))?;
                self.point(from, &at.key("from"))?;
                self.not_negative(*radius, &at.key("radius"))?;
            }
            Points::Remember { of, seconds, merge, blend, slot } => {
                self.points(of, &at.key("of"))?;
                self.not_negative(*seconds, &at.key("seconds"))?;
                self.not_negative(*merge, &at.key("merge"))?;
                self.share(*blend, &at.key("blend"))?;
                *slot = self.slot();
            }
            Points::Shifted { of, by } => {
                self.points(of, &at.key("of"))?;
                self.finite_point(*by, &at.key("by"))?;
            }
        }
        Ok(())
    }

    pub(super) fn role_ref(&self, role: &mut RoleRef, at: &Field) -> Result<()> {
        role.index = self.role_index(&role.name, at)?;
        Ok(())
    }

    fn zone(&mut self, zone: &mut ZoneName, at: &Field) -> Result<()> {
        match zone {
            ZoneName::Named(name) => match self.file.zones.get(name) {
                Some(known) => *zone = ZoneName::Exactly(known.scaled(self.scale)),
                None => return self.fault(at, unknown(&self.file.zones, "zone", name)),
            },
            ZoneName::Exactly(zone) => {
                self.finite_zone(*zone, at)?;
                *zone = zone.scaled(self.scale);
            }
            ZoneName::DangerZone | ZoneName::PenaltyArea => {}
        }
        Ok(())
    }

    pub(super) fn feature(&mut self, feature: &mut Feature, at: &Field) -> Result<()> {
        match feature {
            Feature::Is(name) => {
                *feature = self.expand(&self.file.features, "feature", name, at, |s, f| s.feature(f, at))?;
            }
            Feature::Always
            | Feature::On(_)
            | Feature::HasBall
            | Feature::HasBooked
            | Feature::TeammateHasBooked
            | Feature::HoldsBall
            | Feature::GoalieIsOut => {}
            Feature::InRole(role) => self.role_ref(role, at)?,
            Feature::TeammateHasBall(roles) => {
                for (i, role) in roles.iter_mut().enumerate() {
                    self.role_ref(role, &at.index(i))?;
                }
            }
            Feature::Not(what) => self.feature(what, &at.index(0))?,
            Feature::All(list) | Feature::Any(list) => {
                for (i, part) in list.iter_mut().enumerate() {
                    self.feature(part, &at.index(i))?;
                }
            }
            Feature::Known(point) => self.point(point, &at.index(0))?,
            Feature::BallSeenWithin(seconds) | Feature::Stalled(seconds) | Feature::After(seconds) => {
                self.not_negative(*seconds, at)?;
            }
            Feature::Near { a, b, radius } => {
                self.point(a, &at.key("a"))?;
                self.point(b, &at.key("b"))?;
                self.not_negative(*radius, &at.key("radius"))?;
            }
            Feature::NearLatch { a, b, enter, leave, slot } => {
                self.point(a, &at.key("a"))?;
                self.point(b, &at.key("b"))?;
                self.not_negative(*enter, &at.key("enter"))?;
                self.not_negative(*leave, &at.key("leave"))?;
                *slot = self.slot();
            }
            Feature::NearerThan { a, b } => {
                self.point(a, &at.key("a"))?;
                self.point(b, &at.key("b"))?;
            }
            Feature::In { zone, point } => {
                self.zone(zone, &at.key("zone"))?;
                self.point(point, &at.key("point"))?;
            }
            Feature::Facing { point, within } | Feature::BehindBall { toward: point, within } => {
                self.point(point, at)?;
                self.not_negative(*within, &at.key("within"))?;
            }
            Feature::BallInScoop { gap, aside } => {
                self.not_negative(*gap, &at.key("gap"))?;
                self.not_negative(*aside, &at.key("aside"))?;
            }
            Feature::HoldFor { what, seconds, slot } | Feature::Lasting { what, seconds, slot } => {
                self.feature(what, &at.key("what"))?;
                self.not_negative(*seconds, &at.key("seconds"))?;
                *slot = self.slot();
            }
            Feature::Watchdog { what, patience, seconds, slot } => {
                self.feature(what, &at.key("what"))?;
                self.not_negative(*patience, &at.key("patience"))?;
                self.not_negative(*seconds, &at.key("seconds"))?;
                *slot = self.slot();
            }
        }
        Ok(())
    }

    pub(super) fn schema(&mut self, schema: &mut Schema, at: &Field) -> Result<()> {
        match schema {
            Schema::GoTo { target, controlled_zone, dead_zone } => {
                self.point(target, &at.key("target"))?;
                self.attraction(*controlled_zone, *dead_zone, at)?;
            }
            Schema::GoToAll { targets, controlled_zone, dead_zone } => {
                self.points(targets, &at.key("targets"))?;
                self.attraction(*controlled_zone, *dead_zone, at)?;
            }
            Schema::AttractNear { to: points, sphere, safety }
            | Schema::Avoid { of: points, sphere, safety }
            | Schema::SwirlLeft { around: points, sphere, safety } => {
                self.points(points, at)?;
                self.repulsion(*sphere, *safety, at)?;
            }
            Schema::Swirl { around, toward, sphere, safety }
            | Schema::GeoField { around, toward, sphere, safety } => {
                self.points(around, &at.key("around"))?;
                self.point(toward, &at.key("toward"))?;
                self.repulsion(*sphere, *safety, at)?;
            }
            Schema::Noise { period, slot } => {
                self.not_negative(*period, &at.key("period"))?;
                *slot = self.slot();
            }
            Schema::DockBehind { ball, toward, standoff, enter_cone, leave_cone, slot } => {
                self.point(ball, &at.key("ball"))?;
                self.point(toward, &at.key("toward"))?;
                self.not_negative(*standoff, &at.key("standoff"))?;
                self.not_negative(*enter_cone, &at.key("enter_cone"))?;
                self.not_negative(*leave_cone, &at.key("leave_cone"))?;
                *slot = self.slot();
            }
            Schema::Dribble { ball, toward, tight } => {
                self.point(ball, &at.key("ball"))?;
                self.point(toward, &at.key("toward"))?;
                self.not_negative(*tight, &at.key("tight"))?;
            }
            Schema::Constant(vector) => self.finite_point(*vector, at)?,
        }
        Ok(())
    }

    fn attraction(&self, controlled: f32, dead: f32, at: &Field) -> Result<()> {
        self.not_negative(controlled, &at.key("controlled_zone"))?;
        self.not_negative(dead, &at.key("dead_zone"))?;
        if dead > controlled {
            return self.fault(
                &at.key("dead_zone"),
                format!("the dead zone of {dead} m is larger than the controlled zone of {controlled} m"),
            );
        }
        Ok(())
    }

    fn repulsion(&self, sphere: f32, safety: f32, at: &Field) -> Result<()> {
        self.not_negative(sphere, &at.key("sphere"))?;
        self.not_negative(safety, &at.key("safety"))?;
        if safety > sphere {
            return self.fault(
                &at.key("safety"),
                format!("the safety radius of {safety} m is larger than the sphere of {sphere} m"),
            );
        }
        Ok(())
    }
}
