//! A bare rapier2d pipeline that steps what a match steps.

use std::time::{Duration, Instant};

use bevy::ecs::system::SystemState;
use bevy::prelude::*;
use bevy_rapier2d::prelude::*;
use bevy_rapier2d::rapier::prelude::{
    CCDSolver, DefaultBroadPhase, IntegrationParameters, IslandManager, NarrowPhase, PhysicsPipeline,
};
use touchline::clock::TICK_HZ;
use touchline::game::Match;

/// The physical world of a match, cut loose from it.
#[derive(Clone)]
pub struct BareWorld {
    colliders: RapierContextColliders,
    joints: RapierContextJoints,
    bodies: RapierRigidBodySet,
    islands: IslandManager,
    broad_phase: DefaultBroadPhase,
    narrow_phase: NarrowPhase,
    ccd: CCDSolver,
    parameters: IntegrationParameters,
}

impl BareWorld {
    pub fn of(game: &mut Match) -> BareWorld {
        type World<'a> = (
            &'a RapierContextColliders,
            &'a RapierContextJoints,
            &'a RapierRigidBodySet,
            &'a RapierContextSimulation,
        );
        let mut state: SystemState<Query<World>> = SystemState::new(game.world_mut());
        let worlds = state.get(game.world()).expect("the query is sound");
        let (colliders, joints, bodies, simulation) = worlds.single().expect("one physical world");
        BareWorld {
            colliders: colliders.clone(),
            joints: joints.clone(),
            bodies: bodies.clone(),
            islands: simulation.islands.clone(),
            broad_phase: simulation.broad_phase.clone(),
            narrow_phase: simulation.narrow_phase.clone(),
            ccd: simulation.ccd_solver.clone(),
            parameters: simulation.integration_parameters,
        }
    }

    /// Steps for half a second of match time after one step to warm up, and returns the time and the number of steps.
    pub fn run(mut self) -> (Duration, u64) {
        let steps = (TICK_HZ / 2.0) as u64;
        let mut pipeline = PhysicsPipeline::new();
        let mut step = || {
            pipeline.step(
                Vec2::ZERO,
                &self.parameters,
                &mut self.islands,
                &mut self.broad_phase,
                &mut self.narrow_phase,
                &mut self.bodies.bodies,
                &mut self.colliders.colliders,
                &mut self.joints.impulse_joints,
                &mut self.joints.multibody_joints,
                &mut self.ccd,
                &(),
                &(),
            );
        };
        step();
        let started = Instant::now();
        (0..steps).for_each(|_| step());
        (started.elapsed(), steps)
    }
}
