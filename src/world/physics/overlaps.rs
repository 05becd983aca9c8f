//! Solid bodies that share a place, for those who judge the physics.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_rapier2d::prelude::*;
use bevy_rapier2d::rapier::dynamics::RigidBodyHandle;
use bevy_rapier2d::rapier::geometry::{ColliderHandle, ContactPair};

use super::footprint::place_of;

/// What overlaps what.
#[derive(SystemParam)]
pub struct Overlaps<'w, 's> {
    context: Option<
        Single<
            'w,
            's,
            (&'static RapierContextSimulation, &'static RapierContextColliders, &'static RapierRigidBodySet),
        >,
    >,
}

impl Overlaps<'_, '_> {
    /// How deep a ball has sunk into each shape that it touches, m; shapes of robots and walls alike.
    pub fn of_ball(&self, ball: &RapierRigidBodyHandle, radius: f32) -> impl Iterator<Item = f32> {
        let context = self.context.as_ref().map(|context| **context);
        let found = context.and_then(|(simulation, colliders, bodies)| {
            let ball = bodies.bodies.get(ball.0)?;
            let own = *ball.colliders().first()?;
            let depth = move |pair: &ContactPair| {
                let other = if pair.collider1 == own { pair.collider2 } else { pair.collider1 };
                let collider = colliders.colliders.get(other)?;
                let place = place_of(collider, &bodies.bodies);
                let nearest = collider.shape().project_point(&place, ball.translation(), false);
                let gap = nearest.point.distance(ball.translation());
                Some(radius - if nearest.is_inside { -gap } else { gap })
            };
            Some(simulation.narrow_phase.contact_pairs_with(own).filter_map(depth))
        });
        found.into_iter().flatten().filter(|depth| *depth > 0.0)
    }

    /// Bodies that the last step found deeper than this in each other, m. Nobody's is a wall.
    pub fn deeper_than(&self, depth: f32) -> impl Iterator<Item = [Option<RigidBodyHandle>; 2]> {
        let context = self.context.as_ref().map(|context| **context);
        context.into_iter().flat_map(move |(simulation, colliders, _)| {
            let body = |collider: ColliderHandle| colliders.colliders.get(collider)?.parent();
            let is_deep = move |pair: &&ContactPair| {
                pair.find_deepest_contact().is_some_and(|(_, contact)| contact.dist < -depth)
            };
            let pairs = simulation.narrow_phase.contact_pairs().filter(is_deep);
            pairs.map(move |pair| [pair.collider1, pair.collider2].map(body))
        })
    }
}
