//! Rapier in the service of a [`Tick`]: walls, the step, and poses read back as truth.
//!
//! Bodies are spawned as bevy_rapier components and registered once, when a match starts. During a match the stages work on
//! Rapier's own body set, so a tick costs little more than Rapier itself.

mod footprint;
mod overlaps;
mod pose;
mod put;
mod room;
mod saved;
mod walls;

use bevy::ecs::schedule::{ScheduleLabel, SingleThreadedExecutor};
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_rapier2d::prelude::*;
use bevy_rapier2d::rapier::dynamics::{IntegrationParameters, RigidBody as Body, RigidBodySet};
use bevy_rapier2d::rapier::geometry::{ColliderHandle, NarrowPhase};

use crate::clock::Clock;
use crate::geometry::{Pose, Twist};
use crate::pitch::Pitch;
use crate::schedule::{Tick, TickSystems};
pub use footprint::{Footprint, nearest_free, trailer_shape, unit_shapes};
pub use overlaps::Overlaps;
use pose::{pose_of, turn};
pub use put::{Put, push};
pub use walls::wall_boxes;

pub(super) fn plugin(app: &mut App) {
    // Registering bodies runs Bevy's transform systems, which in a build with a window want threads and a resource.
    if !app.is_plugin_added::<TaskPoolPlugin>() {
        app.add_plugins(TaskPoolPlugin::default());
    }
    if !app.is_plugin_added::<TransformPlugin>() {
        app.add_plugins(TransformPlugin);
    }
    saved::plugin(app);
    app.insert_resource(RapierContextInitialization::NoAutomaticRapierContext)
        .add_plugins(RapierPhysicsPlugin::<NoUserData>::default().with_default_system_setup(false))
        .init_resource::<TimestepMode>()
        .init_schedule(RegisterBodies)
        .edit_schedule(RegisterBodies, |schedule| {
            schedule.set_executor(SingleThreadedExecutor::new());
            schedule.add_systems(RapierPhysicsPlugin::<NoUserData>::get_systems(PhysicsSet::SyncBackend));
        })
        .add_systems(Tick, (step, read_back).chain().in_set(TickSystems::Physics));
    if cfg!(debug_assertions) {
        app.add_systems(Tick, assert_finite.in_set(TickSystems::Physics).after(read_back));
    }
}

/// Run after a body was spawned: makes it known to Rapier.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
struct RegisterBodies;

/// Solver iterations of a step. Two keep the hitch within 0.1 mm, since our wheel model solves it as well.
const SOLVER_ITERATIONS: usize = 2;
/// Those while a light body is between two others, into which it would sink.
const SQUEEZE_ITERATIONS: usize = 4;
/// How stiff contacts between bodies are, Hz. At Rapier's 30 Hz a ball of 90 g gives way to legs by 3 mm.
const CONTACT_FREQUENCY: f32 = 120.0;
/// The gap that continuous collision leaves between fast bodies, m; Rapier's 5 mm is a tenth of a ball.
const CONTACT_SLOP: f32 = 0.001;

/// Rapier's contacts suit bodies of a metre. Its stale contacts, which it keeps until a pair has moved by 5 cm, let a small
/// ball sink into robots by its radius and more.
fn set_contacts(parameters: &mut IntegrationParameters) {
    parameters.contact_softness.natural_frequency = CONTACT_FREQUENCY;
    parameters.normalized_allowed_linear_error = CONTACT_SLOP;
    parameters.contact_recycling = false;
}

/// A body so light that it is squeezed between others: the ball.
#[derive(Component, Clone, Copy, Debug)]
pub struct Squeezable;

/// More where the last step has found a light body in touch with two others, or within 2 cm of touching.
fn solver_iterations(narrow_phase: &NarrowPhase, light: Option<&Body>) -> usize {
    let is_squeezed = |part: &ColliderHandle| {
        narrow_phase.contact_pairs_with(*part).filter(|pair| pair.has_any_active_contact()).nth(1).is_some()
    };
    if light.is_some_and(|body| body.colliders().iter().any(is_squeezed)) {
        SQUEEZE_ITERATIONS
    } else {
        SOLVER_ITERATIONS
    }
}

/// Rapier's bodies, for the stages that push them.
#[derive(SystemParam)]
pub struct Bodies<'w, 's> {
    set: Single<'w, 's, &'static mut RapierRigidBodySet>,
}

impl Bodies<'_, '_> {
    /// A body.
    pub fn get(&self, handle: &RapierRigidBodyHandle) -> Option<&Body> {
        self.set.bodies.get(handle.0)
    }

    /// A body, to be changed.
    pub fn get_mut(&mut self, handle: &RapierRigidBodyHandle) -> Option<&mut Body> {
        self.set.bodies.get_mut(handle.0)
    }

    /// Where a body is.
    pub fn pose(&self, handle: &RapierRigidBodyHandle) -> Option<Pose> {
        self.get(handle).map(pose_of)
    }

    /// Puts a body somewhere, at rest.
    fn place(&mut self, handle: &RapierRigidBodyHandle, pose: Pose) {
        if let Some(body) = self.get_mut(handle) {
            body.set_translation(pose.position, true);
            turn(body, pose.heading);
            body.set_linvel(Vec2::ZERO, true);
            body.set_angvel(0.0, true);
        }
    }
}

/// Opens an empty physical world with the walls of a pitch, all with a mark; whatever was there before is gone.
pub fn open_world(world: &mut World, pitch: &Pitch, mark: impl Bundle + Copy) {
    let mut contexts = world.query_filtered::<Entity, With<RapierContextSimulation>>();
    for context in contexts.iter(world).collect::<Vec<_>>() {
        world.despawn(context);
    }
    let mut simulation = RapierContextSimulation::default();
    set_contacts(&mut simulation.integration_parameters);
    world.spawn((Name::new("physics"), mark, DefaultRapierContext, simulation));
    for (at, half) in wall_boxes(pitch) {
        world.spawn((
            Name::new("wall"),
            mark,
            Transform::from_translation(at.extend(0.0)),
            Collider::cuboid(half.x, half.y),
            Friction { coefficient: pitch.walls.friction, combine_rule: CoefficientCombineRule::Min },
            Restitution { coefficient: pitch.walls.restitution, combine_rule: CoefficientCombineRule::Max },
        ));
        register_bodies(world);
    }
}

/// Makes a freshly spawned body known to Rapier. Once for each body: Rapier's order is the order of registration, while
/// bevy_rapier takes several new bodies in an order that differs from world to world.
pub fn register_bodies(world: &mut World) {
    world.run_schedule(RegisterBodies);
    world.flush();
}

/// Turns all bodies as their poses say, once they are registered: bevy_rapier has turned them by the platform's sines.
pub fn turn_to_poses(mut bodies: Bodies, poses: Query<(&RapierRigidBodyHandle, &Pose)>) {
    for (handle, pose) in &poses {
        if let Some(body) = bodies.get_mut(handle) {
            turn(body, pose.heading);
        }
    }
}

pub(crate) fn step(
    clock: Res<Clock>,
    light: Option<Single<&RapierRigidBodyHandle, With<Squeezable>>>,
    world: Single<(
        &mut RapierContextSimulation,
        &mut RapierContextColliders,
        &mut RapierContextJoints,
        &mut RapierRigidBodySet,
    )>,
) {
    let (mut simulation, mut colliders, mut joints, mut bodies) = world.into_inner();
    let simulation = &mut *simulation;
    let joints = &mut *joints;
    simulation.integration_parameters.dt = clock.dt;
    let light = light.and_then(|handle| bodies.bodies.get(handle.0));
    simulation.integration_parameters.num_solver_iterations =
        solver_iterations(&simulation.narrow_phase, light);
    limit_speeds(&mut bodies.bodies);
    simulation.pipeline.step(
        Vec2::ZERO,
        &simulation.integration_parameters,
        &mut simulation.islands,
        &mut simulation.broad_phase,
        &mut simulation.narrow_phase,
        &mut bodies.bodies,
        &mut colliders.colliders,
        &mut joints.impulse_joints,
        &mut joints.multibody_joints,
        &mut simulation.ccd_solver,
        &(),
        &(),
    );
    // A light body that a heavy one strikes leaves faster than that came.
    limit_speeds(&mut bodies.bodies);
}

/// The fastest that a body moves, m/s, and turns, rad/s, however it is pushed.
const FASTEST: f32 = 50.0;
const FASTEST_TURN: f32 = 100.0;

fn limit_speeds(bodies: &mut RigidBodySet) {
    let is_fast = |body: &Body| {
        body.linvel().length_squared() > FASTEST * FASTEST || body.angvel().abs() > FASTEST_TURN
    };
    // Whatever is borrowed mutably counts as changed.
    let fast: Vec<_> = bodies.iter().filter(|(_, body)| is_fast(body)).map(|(handle, _)| handle).collect();
    for handle in fast {
        if let Some(body) = bodies.get_mut(handle) {
            body.set_linvel(body.linvel().clamp_length_max(FASTEST), true);
            body.set_angvel(body.angvel().clamp(-FASTEST_TURN, FASTEST_TURN), true);
        }
    }
}

fn read_back(bodies: Bodies, mut truth: Query<(&RapierRigidBodyHandle, &mut Pose, &mut Twist)>) {
    for (handle, mut pose, mut twist) in &mut truth {
        let Some(body) = bodies.get(handle) else { continue };
        *pose = pose_of(body);
        *twist = Twist { linear: body.linvel(), angular: body.angvel() };
    }
}

fn assert_finite(truth: Query<(NameOrEntity, &Pose, &Twist)>) {
    for (name, pose, twist) in &truth {
        assert!(pose.is_finite() && twist.is_finite(), "{name} is nowhere: {pose:?}, {twist:?}");
    }
}
