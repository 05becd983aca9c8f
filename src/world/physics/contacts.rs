//! Which bodies touch, for those who watch a match.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_rapier2d::prelude::{RapierContextColliders, RapierContextSimulation};
use bevy_rapier2d::rapier::dynamics::RigidBodyHandle;
use bevy_rapier2d::rapier::geometry::ContactPair;

/// The contacts of all bodies after the last step.
#[derive(SystemParam)]
pub struct Contacts<'w, 's> {
    context: Option<Single<'w, 's, (&'static RapierContextSimulation, &'static RapierContextColliders)>>,
}

impl Contacts<'_, '_> {
    /// The pairs of bodies that touch, in no particular order; walls are no bodies.
    pub fn pairs(&self) -> impl Iterator<Item = [RigidBodyHandle; 2]> {
        let context = self.context.as_ref().map(|context| **context);
        let found = context.map(|(simulation, colliders)| {
            let parent = |collider| colliders.colliders.get(collider)?.parent();
            let bodies = move |pair: &ContactPair| {
                let pair = Some(pair).filter(|pair| pair.has_any_active_contact())?;
                Some([parent(pair.collider1)?, parent(pair.collider2)?])
            };
            simulation.narrow_phase.contact_pairs().filter_map(bodies)
        });
        found.into_iter().flatten()
    }
}
