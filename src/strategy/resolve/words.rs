//! The words inside a strategy: points, sets, zones, features and motor schemas. Each is checked in place; a name is replaced
//! by what it stands for, and a stateful operator gets its slot.

use super::{Resolved, Resolver, unknown};
use crate::data::{Bound, Field};
use crate::strategy::RoleRef;
use crate::strategy::language::{Feature, Point, Points, Schema, ZoneName};

impl Resolver<'_> {
    pub(super) fn point(&mut self, point: &mut Point, at: &Field) -> Resolved<()> {
        self.nested(at, |s| s.point_inside(point, at))
    }

    fn point_inside(&mut self, point: &mut Point, at: &Field) -> Resolved<()> {
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
            Point::OptimalPosition(tasks) => {
                if tasks.is_empty() {
                    return self.fault(at, "needs a task at least");
                }
            }
            Point::Teammate(role) => self.role_ref(role, &at.index(0))?,
            Point::SupportSpot { behind, aside } => {
                self.within(*behind, Bound::PLACE, &at.key("behind"))?;
                self.within(*aside, Bound::PLACE, &at.key("aside"))?;
            }
            Point::AwayFromGoalie { x, y } => {
                self.within(*x, Bound::PLACE, &at.key("x"))?;
                self.within(*y, Bound::LENGTH, &at.key("y"))?;
                (*x, *y) = (*x * self.scale.x, *y * self.scale.y);
            }
            Point::BallIn(seconds) => self.within(*seconds, Bound::SECONDS, at)?,
            Point::At(place) => {
                self.place(*place, at)?;
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
                self.within(*distance, Bound::PLACE, &at.key("distance"))?;
            }
            Point::SweetSpot { of, toward, offset } => {
                self.point(of, &at.key("of"))?;
                self.point(toward, &at.key("toward"))?;
                self.within(*offset, Bound::PLACE, &at.key("offset"))?;
            }
            Point::Intercept { max_speed } => self.within(*max_speed, Bound::SPEED, &at.key("max_speed"))?,
            Point::Into { zone, point } => {
                self.zone(zone, &at.key("zone"))?;
                self.point(point, &at.key("point"))?;
            }
        }
        Ok(())
    }

    pub(super) fn points(&mut self, points: &mut Points, at: &Field) -> Resolved<()> {
        self.nested(at, |s| s.points_inside(points, at))
    }

    fn points_inside(&mut self, points: &mut Points, at: &Field) -> Resolved<()> {
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
                self.within(*radius, Bound::LENGTH, &at.key("radius"))?;
            }
            Points::FartherThan { of, from, radius } => {
                self.points(of, &at.key("of"))?;
                self.point(from, &at.key("from"))?;
                self.within(*radius, Bound::LENGTH, &at.key("radius"))?;
            }
            Points::Remember { of, seconds, merge, blend, slot } => {
                self.points(of, &at.key("of"))?;
                self.within(*seconds, Bound::SECONDS, &at.key("seconds"))?;
                self.within(*merge, Bound::LENGTH, &at.key("merge"))?;
                self.within(*blend, Bound::SHARE, &at.key("blend"))?;
                *slot = self.slot();
            }
            Points::Shifted { of, by } => {
                self.points(of, &at.key("of"))?;
                self.place(*by, &at.key("by"))?;
            }
        }
        Ok(())
    }

    pub(super) fn role_ref(&self, role: &mut RoleRef, at: &Field) -> Resolved<()> {
        role.index = self.roles.index(&role.name, at)?;
        Ok(())
    }

    fn zone(&mut self, zone: &mut ZoneName, at: &Field) -> Resolved<()> {
        match zone {
            ZoneName::Named(name) => match self.file.zones.get(name) {
                Some(known) => *zone = ZoneName::Exactly(known.scaled(self.scale)),
                None => return self.fault(at, unknown(&self.file.zones, "zone", name)),
            },
            ZoneName::Exactly(zone) => {
                self.sound_zone(*zone, at)?;
                *zone = zone.scaled(self.scale);
            }
            ZoneName::DangerZoneOf(role) => *zone = ZoneName::Exactly(self.danger_zone_of(&role.name, at)?),
            ZoneName::DangerZone | ZoneName::PenaltyArea => {}
        }
        Ok(())
    }

    pub(super) fn feature(&mut self, feature: &mut Feature, at: &Field) -> Resolved<()> {
        self.nested(at, |s| s.feature_inside(feature, at))
    }

    fn feature_inside(&mut self, feature: &mut Feature, at: &Field) -> Resolved<()> {
        match feature {
            Feature::Is(name) => {
                *feature = self.expand(&self.file.features, "feature", name, at, |s, f| s.feature(f, at))?;
            }
            Feature::Always
            | Feature::On(_)
            | Feature::HasBall
            | Feature::SuperiorHasBall
            | Feature::HasBooked
            | Feature::TeammateHasBooked
            | Feature::MayExecute(_)
            | Feature::HoldsBall
            | Feature::GoalieIsOut
            | Feature::Bumped => {}
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
                self.within(*seconds, Bound::SECONDS, at)?;
            }
            Feature::MessagesLeftBelow(share) => self.within(*share, Bound::SHARE, at)?,
            Feature::Near { a, b, radius } => {
                self.point(a, &at.key("a"))?;
                self.point(b, &at.key("b"))?;
                self.within(*radius, Bound::LENGTH, &at.key("radius"))?;
            }
            Feature::NearLatch { a, b, enter, leave, slot } => {
                self.point(a, &at.key("a"))?;
                self.point(b, &at.key("b"))?;
                self.within(*enter, Bound::LENGTH, &at.key("enter"))?;
                self.within(*leave, Bound::LENGTH, &at.key("leave"))?;
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
                self.within(*within, Bound::ANGLE, &at.key("within"))?;
            }
            Feature::BallInScoop { gap, aside } => {
                self.within(*gap, Bound::LENGTH, &at.key("gap"))?;
                self.within(*aside, Bound::LENGTH, &at.key("aside"))?;
            }
            Feature::HoldFor { what, seconds, slot } | Feature::Lasting { what, seconds, slot } => {
                self.feature(what, &at.key("what"))?;
                self.within(*seconds, Bound::SECONDS, &at.key("seconds"))?;
                *slot = self.slot();
            }
            Feature::Watchdog { what, patience, seconds, slot } => {
                self.feature(what, &at.key("what"))?;
                self.within(*patience, Bound::SECONDS, &at.key("patience"))?;
                self.within(*seconds, Bound::SECONDS, &at.key("seconds"))?;
                *slot = self.slot();
            }
        }
        Ok(())
    }

    pub(super) fn schema(&mut self, schema: &mut Schema, at: &Field) -> Resolved<()> {
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
                self.within(*period, Bound::SECONDS, &at.key("period"))?;
                *slot = self.slot();
            }
            Schema::DockBehind { ball, toward, standoff, enter_cone, leave_cone, slot } => {
                self.point(ball, &at.key("ball"))?;
                self.point(toward, &at.key("toward"))?;
                self.within(*standoff, Bound::LENGTH, &at.key("standoff"))?;
                self.within(*enter_cone, Bound::ANGLE, &at.key("enter_cone"))?;
                self.within(*leave_cone, Bound::ANGLE, &at.key("leave_cone"))?;
                *slot = self.slot();
            }
            Schema::Dribble { ball, toward, tight } => {
                self.point(ball, &at.key("ball"))?;
                self.point(toward, &at.key("toward"))?;
                self.within(*tight, Bound::ANGLE, &at.key("tight"))?;
            }
            Schema::Constant(vector) => self.source.vector_within(at, *vector, Bound::WEIGHT)?,
        }
        Ok(())
    }

    fn attraction(&self, controlled: f32, dead: f32, at: &Field) -> Resolved<()> {
        self.within(controlled, Bound::LENGTH, &at.key("controlled_zone"))?;
        self.within(dead, Bound::LENGTH, &at.key("dead_zone"))?;
        if dead > controlled {
            return self.fault(
                &at.key("dead_zone"),
                format!("the dead zone of {dead} m is larger than the controlled zone of {controlled} m"),
            );
        }
        Ok(())
    }

    fn repulsion(&self, sphere: f32, safety: f32, at: &Field) -> Resolved<()> {
        self.within(sphere, Bound::LENGTH, &at.key("sphere"))?;
        self.within(safety, Bound::LENGTH, &at.key("safety"))?;
        if safety > sphere {
            return self.fault(
                &at.key("safety"),
                format!("the safety radius of {safety} m is larger than the sphere of {sphere} m"),
            );
        }
        Ok(())
    }
}
