//! What is kept of Rapier in a snapshot: everything but its workspace.

use std::fmt::Write;

use bevy::prelude::*;
use bevy_rapier2d::prelude::*;
use bevy_rapier2d::rapier::dynamics::{CCDSolver, IntegrationParameters, IslandManager};
use bevy_rapier2d::rapier::geometry::{DefaultBroadPhase, NarrowPhase};
use bevy_rapier2d::rapier::pipeline::PhysicsPipeline;

use super::pose::pose_of;
use crate::geometry::{Pose, Twist};
use crate::robot::RobotStart;
use crate::state::RegisterState;

pub(super) fn plugin(app: &mut App) {
    app.match_component::<Pose>().reflected().starts(|start: &RobotStart, _| start.pose);
    app.match_component::<Twist>().reflected().starts(|_: &RobotStart, _| Twist::default());
    app.match_component_by(RapierRigidBodySet::clone, |saved, set| set.clone_from(saved), tell_bodies);
    app.match_component_by(RapierContextColliders::clone, |saved, set| set.clone_from(saved), tell_colliders);
    app.match_component_by(RapierContextJoints::clone, |saved, set| set.clone_from(saved), tell_joints);
    app.match_component_by(SavedSimulation::of, SavedSimulation::put_back, SavedSimulation::tell);
}

/// What a step leaves for the next one.
struct SavedSimulation {
    islands: IslandManager,
    broad_phase: DefaultBroadPhase,
    narrow_phase: NarrowPhase,
    ccd_solver: CCDSolver,
    parameters: IntegrationParameters,
}

impl SavedSimulation {
    fn of(simulation: &RapierContextSimulation) -> SavedSimulation {
        SavedSimulation {
            islands: simulation.islands.clone(),
            broad_phase: simulation.broad_phase.clone(),
            narrow_phase: simulation.narrow_phase.clone(),
            ccd_solver: simulation.ccd_solver.clone(),
            parameters: simulation.integration_parameters,
        }
    }

    fn put_back(&self, simulation: &mut RapierContextSimulation) {
        simulation.islands.clone_from(&self.islands);
        simulation.broad_phase.clone_from(&self.broad_phase);
        simulation.narrow_phase.clone_from(&self.narrow_phase);
        simulation.ccd_solver.clone_from(&self.ccd_solver);
        simulation.integration_parameters = self.parameters;
        // It holds what it selected of joints and contacts that are no longer there.
        simulation.pipeline = PhysicsPipeline::new();
    }

    fn tell(&self) -> String {
        let mut text = String::new();
        for pair in self.narrow_phase.contact_pairs() {
            let (one, other) = (pair.collider1.into_raw_parts().0, pair.collider2.into_raw_parts().0);
            for contact in pair.manifolds.iter().flat_map(|manifold| &manifold.points) {
                let data = &contact.data;
                let _ = writeln!(
                    text,
                    "contact of {one} and {other}: depth {} impulses {} {:?}",
                    -contact.dist, data.warmstart_impulse, data.warmstart_tangent_impulse
                );
            }
        }
        text
    }
}

fn tell_bodies(set: &RapierRigidBodySet) -> String {
    let mut text = String::new();
    for (handle, body) in set.bodies.iter() {
        let (index, at, heading) = (handle.into_raw_parts().0, body.translation(), pose_of(body).heading);
        let (linear, angular) = (body.linvel(), body.angvel());
        let _ = writeln!(text, "body {index}: at {at} heading {heading} velocity {linear} turn {angular}");
    }
    text
}

fn tell_colliders(set: &RapierContextColliders) -> String {
    let mut text = String::new();
    for (handle, collider) in set.colliders.iter() {
        let (index, at) = (handle.into_raw_parts().0, collider.position());
        let _ = writeln!(text, "collider {index}: at {at:?}");
    }
    text
}

fn tell_joints(set: &RapierContextJoints) -> String {
    let mut text = String::new();
    for (handle, joint) in set.impulse_joints.iter() {
        let _ = writeln!(text, "joint {}: impulses {:?}", handle.into_raw_parts().0, joint.impulses);
    }
    text
}
