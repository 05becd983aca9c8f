//! How robots and ball come into the world, with everything that the stages need of them.

use std::sync::Arc;

use bevy::prelude::*;
use bevy_rapier2d::prelude::*;

use super::MatchPlan;
use super::carry::beside_the_pitch;
use crate::clock::Clock;
use crate::comms::messages::Inbox;
use crate::comms::tcm::{Tcm, TcmClient, TcmSettings};
use crate::geometry::{Pose, Twist};
use crate::ids::{MatchEntity, RobotId};
use crate::mind::motor::{Contributions, MotorDice};
use crate::mind::perception::Memory;
use crate::mind::teamwork::{Booking, Swapping, TeamModel};
use crate::mind::world_model::WorldModel;
use crate::rng::Seed;
use crate::robot::handling::Handling;
use crate::robot::pilot::Pilot;
use crate::robot::{
    DriveCommand, Head, HeadIntent, KickIntent, Odometry, Orders, Percepts, Robot, RobotBodies, RobotKind,
    RobotState, Sensing, SteeringIntent, Trailer,
};
use crate::strategy::{Activity, Role, Strategy};
use crate::world::ball::{Ball, BallDice, Rolling};
use crate::world::drive::GaitError;
use crate::world::physics::{register_bodies, trailer_shape, unit_shapes};
use crate::world::referee::MatchState;
use crate::world::sense::Eyesight;

/// Spawns the ball where the match begins.
pub(super) fn spawn_ball(world: &mut World, plan: &MatchPlan, seed: Seed) {
    let kind = plan.ball;
    let (place, velocity) =
        (plan.situation.as_ref()).map_or_else(Default::default, |start| (start.ball, start.velocity));
    let pose = Pose { position: place, heading: 0.0 };
    world.spawn((
        Name::new("ball"),
        MatchEntity,
        Ball,
        BallDice::new(seed),
        Rolling(velocity),
        pose,
        Twist { linear: velocity, angular: 0.0 },
        Velocity::linear(velocity),
        rigid_body(Collider::ball(kind.radius), kind.mass, kind.friction, kind.restitution, pose),
        Ccd::enabled(),
    ));
    register_bodies(world);
}

/// Spawns one robot of a plan where the match begins, or beside the pitch, where it waits for the referee.
pub(super) fn spawn_planned(world: &mut World, plan: &MatchPlan, id: RobotId, seed: Seed, clock: &Clock) {
    let entry = Entry::of(plan, id, seed);
    let (unit, trailer) = spawn_robot(world, &entry, clock);
    let handle = |entity: Entity| world.get::<RapierRigidBodyHandle>(entity).copied();
    if let Some(unit_body) = handle(unit) {
        let bodies = RobotBodies { unit: unit_body, trailer: trailer.and_then(handle) };
        world.entity_mut(unit).insert(bodies);
    }
    add_protocols(world, unit, &entry, clock);
    if plan.pilot == Some(id) {
        world.entity_mut(unit).insert(Pilot::default());
    }
}

/// What a robot brings to a match.
#[derive(Clone, Debug)]
struct Entry<'a> {
    id: RobotId,
    role: usize,
    kind: Arc<RobotKind>,
    sensing: Arc<Sensing>,
    strategy: &'a Strategy,
    seed: Seed,
    /// In the pitch frame.
    pose: Pose,
    /// Whether it has been told where it is.
    told: bool,
    on: bool,
    tcm: TcmSettings,
}

impl Entry<'_> {
    fn of(plan: &MatchPlan, id: RobotId, seed: Seed) -> Entry<'_> {
        let team = plan.team(id.team);
        let start = plan.situation.as_ref().and_then(|situation| situation.robots.get(&id));
        Entry {
            id,
            role: team.strategy.players[usize::from(id.number)],
            kind: team.kind.clone(),
            sensing: team.sensing.clone(),
            strategy: &team.strategy,
            seed,
            pose: start.map_or_else(|| beside_the_pitch(&plan.pitch, id), |start| start.pose),
            told: start.is_some(),
            on: start.is_none_or(|start| start.on),
            tcm: plan.tcm,
        }
    }
}

/// Everything of a robot but its body.
fn parts(entry: &Entry, clock: &Clock) -> impl Bundle + use<> {
    let mut robot = Robot::new(entry.kind.clone(), entry.sensing.clone(), clock);
    robot.health.crashed = !entry.on;
    let attacking = MatchState::attacking_at_start(entry.id.team);
    let model =
        if entry.told { WorldModel::told(attacking.turn_pose(entry.pose)) } else { WorldModel::default() };
    let state = if entry.told { RobotState::Playing } else { RobotState::Initial };
    let body = (
        Name::new(format!("robot {}", entry.id)),
        MatchEntity,
        entry.id,
        robot,
        entry.pose,
        Twist::default(),
        DriveCommand::idle(&entry.kind),
        GaitError::new(entry.seed, entry.id),
        Head::default(),
        Handling::new(entry.seed, entry.id),
        Orders { state, place: None },
    );
    let wants = (
        SteeringIntent::default(),
        Contributions::default(),
        MotorDice::new(entry.seed, entry.id),
        HeadIntent::default(),
        KickIntent::default(),
    );
    let mind = (
        Role(entry.role),
        TeamModel::new(entry.strategy),
        Inbox::default(),
        TcmClient::new(entry.id, entry.tcm.queue),
        Tcm::new(entry.tcm, clock),
        Activity::new(entry.strategy, entry.role, 0),
        Memory::new(entry.strategy.slots),
        model,
        Percepts::default(),
        Eyesight::new(&entry.sensing, entry.seed, entry.id),
        Odometry::new(entry.seed, entry.id),
    );
    (body, wants, mind)
}

/// The parts of a robot's mind that only some strategies need.
fn add_protocols(world: &mut World, robot: Entity, entry: &Entry, clock: &Clock) {
    if let Some(swapping) = Swapping::new(entry.strategy, entry.id, entry.seed) {
        world.entity_mut(robot).insert(swapping);
    }
    if let Some(booking) = Booking::new(entry.strategy, entry.id, clock) {
        world.entity_mut(robot).insert(booking);
    }
}

/// Spawns a robot without a body.
pub(super) fn spawn_mind(
    world: &mut World,
    plan: &MatchPlan,
    id: RobotId,
    seed: Seed,
    clock: &Clock,
) -> Entity {
    let entry = Entry::of(plan, id, seed);
    let robot = world.spawn(parts(&entry, clock)).id();
    add_protocols(world, robot, &entry, clock);
    robot
}

/// Spawns a robot and its trailer; returns both.
fn spawn_robot(world: &mut World, entry: &Entry, clock: &Clock) -> (Entity, Option<Entity>) {
    let kind = &entry.kind;
    let body = &kind.body;
    let rigid = rigid_body(unit_collider(kind), body.mass, body.friction, body.restitution, entry.pose);
    let unit = world.spawn((parts(entry, clock), rigid)).id();
    register_bodies(world);
    let trailer = kind.trailer.as_ref().and_then(|trailer| {
        let outline = Collider::from(trailer_shape(trailer)?);
        let middle = trailer.outline.iter().sum::<Vec2>() / trailer.outline.len() as f32;
        let radius = trailer.outline.iter().map(|corner| corner.distance(middle)).fold(0.0, f32::max);
        let hitch = TypedJoint::RevoluteJoint(RevoluteJointBuilder::new().build());
        let mut joint = ImpulseJoint::new(unit, hitch);
        joint.data.as_mut().set_contacts_enabled(false);
        let spawned = world.spawn((
            Name::new(format!("trailer {}", entry.id)),
            MatchEntity,
            Trailer { of: entry.id, middle, radius },
            entry.pose,
            Twist::default(),
            rigid_body(outline, trailer.mass, trailer.friction, trailer.restitution, entry.pose),
            joint,
        ));
        Some(spawned.id())
    });
    register_bodies(world);
    (unit, trailer)
}

/// Body and jaws of a drive unit, around its centre.
fn unit_collider(kind: &RobotKind) -> Collider {
    let mut parts: Vec<_> =
        unit_shapes(kind).into_iter().map(|shape| (Vec2::ZERO, 0.0, Collider::from(shape))).collect();
    if parts.len() == 1 { parts.remove(0).2 } else { Collider::compound(parts) }
}

fn rigid_body(collider: Collider, mass: f32, friction: f32, restitution: f32, pose: Pose) -> impl Bundle {
    (
        RigidBody::Dynamic,
        Transform::from_translation(pose.position.extend(0.0))
            .with_rotation(Quat::from_rotation_z(pose.heading)),
        collider,
        ColliderMassProperties::Mass(mass),
        Friction { coefficient: friction, combine_rule: CoefficientCombineRule::Min },
        Restitution { coefficient: restitution, combine_rule: CoefficientCombineRule::Max },
        Sleeping::disabled(),
    )
}
