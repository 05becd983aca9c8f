//! What bodies cover of the carpet, and where there is room for one. Pure.

use bevy::prelude::*;
use bevy_rapier2d::parry::math::Pose as Isometry;
use bevy_rapier2d::parry::query::contact;
use bevy_rapier2d::parry::shape::SharedShape;
use bevy_rapier2d::rapier::dynamics::{RigidBody, RigidBodyHandle, RigidBodySet};
use bevy_rapier2d::rapier::geometry::{Collider, ColliderSet};

use super::pose::isometry;
use super::walls::wall_boxes;
use crate::geometry::{Pose, unit};
use crate::pitch::{BallKind, Pitch};
use crate::robot::{RobotKind, TrailerKind, jaws};

/// The shapes of a body or of several, each with its place as seen from the body's origin.
#[derive(Clone)]
pub struct Footprint {
    parts: Vec<(Isometry, SharedShape)>,
}

/// Bodies that reach less than this into each other only touch, m.
const TOUCH: f32 = 0.002;

impl Footprint {
    /// The circle that a ball covers.
    pub fn of_ball(kind: &BallKind) -> Footprint {
        Footprint { parts: vec![(Isometry::IDENTITY, SharedShape::ball(kind.radius))] }
    }

    /// Drive unit, jaws, and the trailer straight behind.
    pub fn of_robot(kind: &RobotKind) -> Footprint {
        let mut parts = unit_shapes(kind);
        parts.extend(kind.trailer.as_ref().and_then(trailer_shape));
        Footprint { parts: parts.into_iter().map(|shape| (Isometry::IDENTITY, shape)).collect() }
    }

    /// All walls of a pitch.
    pub fn of_walls(pitch: &Pitch) -> Footprint {
        let walls = wall_boxes(pitch).into_iter();
        let parts =
            walls.map(|(at, half)| (Isometry::from_translation(at), SharedShape::cuboid(half.x, half.y)));
        Footprint { parts: parts.collect() }
    }

    /// Bodies of the running match that are put down together, as seen from their common origin.
    pub(super) fn of_parts<'a>(
        bodies: impl IntoIterator<Item = &'a RigidBody>,
        colliders: &ColliderSet,
    ) -> Footprint {
        let handles = bodies.into_iter().flat_map(|body| body.colliders());
        let parts = handles.filter_map(|handle| colliders.get(*handle));
        Footprint { parts: parts.map(|part| (place_on_body(part), part.shared_shape().clone())).collect() }
    }

    /// Everything in the running match but some bodies, as seen from the pitch.
    pub(super) fn of_others(
        except: &[RigidBodyHandle],
        bodies: &RigidBodySet,
        colliders: &ColliderSet,
    ) -> Footprint {
        let parts = colliders.iter().map(|(_, collider)| collider);
        let others = parts.filter(|part| part.parent().is_none_or(|body| !except.contains(&body)));
        let placed = others.map(|part| (place_of(part, bodies), part.shared_shape().clone()));
        Footprint { parts: placed.collect() }
    }

    /// Whether this body, somewhere, and another one, elsewhere, would be inside each other.
    pub fn overlaps(&self, at: Pose, other: &Footprint, there: Pose) -> bool {
        let (at, there) = (isometry(at), isometry(there));
        let pairs = self.parts.iter().flat_map(|own| other.parts.iter().map(move |others| (own, others)));
        pairs.into_iter().any(|((own, shape), (others, other))| {
            let touch = contact(&(at * *own), &**shape, &(there * *others), &**other, 0.0);
            touch.ok().flatten().is_some_and(|contact| contact.dist < -TOUCH)
        })
    }

    /// How far ahead of its origin the body reaches at a heading of 0, m.
    pub fn front(&self) -> f32 {
        self.parts.iter().map(|(at, shape)| shape.compute_aabb(at).maxs.x).fold(f32::MIN, f32::max)
    }
}

/// The box of a drive unit and its jaws, around its centre.
pub fn unit_shapes(kind: &RobotKind) -> Vec<SharedShape> {
    let half = Vec2::new(kind.body.length, kind.body.width) / 2.0;
    let mut shapes = vec![SharedShape::cuboid(half.x, half.y)];
    shapes.extend(jaws(kind).iter().filter_map(|jaw| SharedShape::convex_hull(jaw)));
    shapes
}

/// A trailer's outline, seen from the hitch.
pub fn trailer_shape(kind: &TrailerKind) -> Option<SharedShape> {
    SharedShape::convex_hull(&kind.outline)
}

fn place_on_body(part: &Collider) -> Isometry {
    part.position_wrt_parent().copied().unwrap_or(Isometry::IDENTITY)
}

/// Where a shape is. It follows a body that was put elsewhere only in the next step; its own position lags behind.
pub(super) fn place_of(part: &Collider, bodies: &RigidBodySet) -> Isometry {
    let body = part.parent().and_then(|body| bodies.get(body));
    body.map_or(*part.position(), |body| *body.position() * place_on_body(part))
}

/// Between two places that are tried, m.
const STEP: f32 = 0.05;
/// Directions in which places are tried.
const DIRECTIONS: u8 = 16;

/// The pose that is free and nearest to a wanted one, with the same heading, no farther away than `reach` metres: the wanted
/// one itself, if it is free.
pub fn nearest_free(wanted: Pose, reach: f32, is_free: impl Fn(Pose) -> bool) -> Option<Pose> {
    let rings = (1..=(reach / STEP) as u32).flat_map(|ring| {
        (0..DIRECTIONS).map(move |direction| {
            let way = unit(f32::from(direction) * std::f32::consts::TAU / f32::from(DIRECTIONS));
            Pose { position: wanted.position + way * (ring as f32 * STEP), ..wanted }
        })
    });
    std::iter::once(wanted).chain(rings).find(|pose| is_free(*pose))
}

#[cfg(test)]
mod tests {
    use std::f32::consts::{FRAC_PI_2, PI};

    use super::*;
    use crate::testing::{BALL, cye, pitch};

    #[test]
    fn a_robot_covers_its_trailer_and_what_its_jaws_cover() {
        let (robot, ball) = (Footprint::of_robot(&cye()), Footprint::of_ball(&BALL));
        let covers = |x, y| robot.overlaps(Pose::default(), &ball, Pose::new(x, y, 0.0));
        assert!(covers(0.0, 0.0) && covers(-0.5, 0.0), "body and trailer");
        assert!(!covers(-0.56, 0.0), "behind the trailer");
        assert!(!covers(0.226, 0.0), "between the jaws");
        assert!(covers(0.226, 0.12), "in a jaw");
        assert!((robot.front() - 0.165).abs() < 1e-4, "{}", robot.front());
    }

    #[test]
    fn a_heading_turns_the_trailer_along() {
        let (robot, ball) = (Footprint::of_robot(&cye()), Footprint::of_ball(&BALL));
        let south = Pose::new(0.0, -0.45, 0.0);
        assert!(!robot.overlaps(Pose::default(), &ball, south));
        assert!(robot.overlaps(Pose::new(0.0, 0.0, FRAC_PI_2), &ball, south));
        assert!(!robot.overlaps(Pose::new(0.0, 0.0, -FRAC_PI_2), &ball, south));
    }

    #[test]
    fn a_trailer_can_stand_in_a_wall() {
        let (robot, walls) = (Footprint::of_robot(&cye()), Footprint::of_walls(&pitch()));
        let in_wall = |pose| robot.overlaps(pose, &walls, Pose::default());
        assert!(in_wall(Pose::new(4.2, 2.0, PI)) && !in_wall(Pose::new(4.2, 2.0, 0.0)));
        assert!(!in_wall(Pose::new(4.2, 0.0, PI)), "it reaches into the goal");
    }

    #[test]
    fn the_nearest_free_place_is_taken() {
        let wanted = Pose::new(1.0, 1.0, 0.5);
        assert_eq!(nearest_free(wanted, 1.0, |_| true), Some(wanted));
        let found = nearest_free(wanted, 2.0, |pose| pose.position.distance(wanted.position) > 0.33).unwrap();
        assert!((found.position.distance(wanted.position) - 0.35).abs() < 1e-4 && found.heading == 0.5);
        assert_eq!(nearest_free(wanted, 0.3, |pose| pose.position.distance(wanted.position) > 0.33), None);
    }
}
