//! Puts bodies down where nothing else is.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_rapier2d::prelude::{RapierContextColliders, RapierRigidBodyHandle};
use bevy_rapier2d::rapier::dynamics::RigidBodyHandle;

use super::Bodies;
use super::footprint::{Footprint, nearest_free};
use crate::geometry::Pose;
use crate::pitch::Pitch;

/// The bodies and what is in their way.
#[derive(SystemParam)]
pub struct Room<'w, 's> {
    /// Where the bodies are.
    pub bodies: Bodies<'w, 's>,
    colliders: Single<'w, 's, &'static RapierContextColliders>,
    pitch: Res<'w, Pitch>,
}

/// How far from the wanted place another one is looked for, m.
const REACH: f32 = 10.0;

impl Room<'_, '_> {
    /// Puts bodies that belong together down, at rest: where they are wanted or, if something is there, as near to it as there
    /// is room; if there is none, where they were. Bodies that are `lifted` are in no one's way. Returns the pose.
    pub fn put_down(
        &mut self,
        moved: &[RapierRigidBodyHandle],
        wanted: Pose,
        lifted: &[RapierRigidBodyHandle],
    ) -> Pose {
        let at = self.free_pose(moved, wanted, lifted);
        for handle in moved {
            self.bodies.place(handle, at);
        }
        at
    }

    fn free_pose(
        &self,
        moved: &[RapierRigidBodyHandle],
        wanted: Pose,
        lifted: &[RapierRigidBodyHandle],
    ) -> Pose {
        let colliders = &self.colliders.colliders;
        let away: Vec<RigidBodyHandle> = moved.iter().chain(lifted).map(|handle| handle.0).collect();
        let own = Footprint::of_parts(moved.iter().filter_map(|handle| self.bodies.get(handle)), colliders);
        let others = Footprint::of_others(&away, &self.bodies.set.bodies, colliders);
        let side = |place: Vec2| (self.pitch.holds(place, 0.0), self.pitch.holds(place, self.pitch.margin()));
        let is_free = |pose: Pose| {
            side(pose.position) == side(wanted.position) && !own.overlaps(pose, &others, Pose::default())
        };
        nearest_free(wanted, REACH, is_free)
            .or_else(|| moved.first().and_then(|handle| self.bodies.pose(handle)))
            .unwrap_or(wanted)
    }
}
