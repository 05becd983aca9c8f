//! How robots and ball come into the world: their bodies, and what the stages have registered.

use bevy::prelude::*;
use bevy_rapier2d::prelude::*;

use super::MatchPlan;
use super::carry::beside_the_pitch;
use crate::clock::Clock;
use crate::geometry::{Pose, Twist};
use crate::ids::{MatchEntity, RobotId};
use crate::rng::Seed;
use crate::robot::{RobotBodies, RobotKind, RobotStart, Trailer, TrailerKind};
use crate::state::apply_event;
use crate::world::ball::{Ball, BallDice, Rolling};
use crate::world::physics::{Squeezable, register_bodies, trailer_shape, unit_shapes};
use crate::world::referee::MatchState;

/// Spawns the ball where the match begins.
pub(super) fn spawn_ball(world: &mut World, plan: &MatchPlan) {
    let kind = plan.ball;
    let (place, velocity) =
        (plan.situation.as_ref()).map_or_else(Default::default, |start| (start.ball, start.velocity));
    let pose = Pose { position: place, heading: 0.0 };
    world.spawn((
        Name::new("ball"),
        MatchEntity,
        Ball,
        BallDice::new(Seed(plan.seed)),
        Rolling(velocity),
        pose,
        Twist { linear: velocity, angular: 0.0 },
        Velocity::linear(velocity),
        rigid_body(Collider::ball(kind.radius), kind.mass, kind.friction, kind.restitution, pose),
        Ccd::enabled(),
        Squeezable,
    ));
    register_bodies(world);
}

/// Spawns one robot of a plan where the match begins, or beside the pitch, where it waits for the referee.
pub(super) fn spawn_robot(world: &mut World, plan: &MatchPlan, id: RobotId) {
    let start = robot_start(world, plan, id);
    let (kind, body) = (&start.kind, &start.kind.body);
    let rigid = rigid_body(unit_collider(kind), body.mass, body.friction, body.restitution, start.pose);
    let unit = spawn_parts(world, &start);
    world.entity_mut(unit).insert(rigid);
    register_bodies(world);
    let trailer = kind.trailer.as_ref().and_then(|trailer| spawn_trailer(world, trailer, &start, unit));
    let handle = |entity: Entity| world.get::<RapierRigidBodyHandle>(entity).copied();
    if let Some(unit_body) = handle(unit) {
        let bodies = RobotBodies { unit: unit_body, trailer: trailer.and_then(handle) };
        world.entity_mut(unit).insert(bodies);
    }
}

/// Spawns a robot without a body.
pub(super) fn spawn_mind(world: &mut World, plan: &MatchPlan, id: RobotId) -> Entity {
    let start = robot_start(world, plan, id);
    spawn_parts(world, &start)
}

/// Everything of a robot but its body: what the stages have registered.
fn spawn_parts(world: &mut World, start: &RobotStart) -> Entity {
    let robot = world.spawn((Name::new(format!("robot {}", start.id)), MatchEntity, start.id)).id();
    apply_event(world, robot, start);
    robot
}

fn robot_start(world: &World, plan: &MatchPlan, id: RobotId) -> RobotStart {
    let team = plan.team(id.team);
    let senses = team.senses(id.number);
    let placed = plan.situation.as_ref().and_then(|situation| situation.robots.get(&id));
    RobotStart {
        id,
        role: team.strategy.players[usize::from(id.number)],
        kind: team.kind.clone(),
        sensing: senses.sensing.clone(),
        calibration: senses.calibration.clone(),
        strategy: team.strategy.clone(),
        seed: Seed(plan.seed),
        clock: *world.resource::<Clock>(),
        pose: placed.map_or_else(|| beside_the_pitch(&plan.pitch, id), |placed| placed.pose),
        told: placed.map(|placed| MatchState::attacking_at_start(id.team).turn_pose(placed.pose)),
        on: placed.is_none_or(|placed| placed.on),
        piloted: plan.pilot == Some(id),
    }
}

fn spawn_trailer(world: &mut World, kind: &TrailerKind, start: &RobotStart, unit: Entity) -> Option<Entity> {
    let outline = Collider::from(trailer_shape(kind)?);
    let (middle, radius) = kind.round();
    let hitch = TypedJoint::RevoluteJoint(RevoluteJointBuilder::new().build());
    let mut joint = ImpulseJoint::new(unit, hitch);
    joint.data.as_mut().set_contacts_enabled(false);
    let trailer = world.spawn((
        Name::new(format!("trailer {}", start.id)),
        MatchEntity,
        Trailer { of: start.id, middle, radius },
        start.pose,
        Twist::default(),
        rigid_body(outline, kind.mass, kind.friction, kind.restitution, start.pose),
        joint,
    ));
    let trailer = trailer.id();
    register_bodies(world);
    Some(trailer)
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
