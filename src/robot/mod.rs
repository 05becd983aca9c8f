//! Robots: what they are made of, and how one is put on the pitch with everything that its stages need.

mod kind;

use std::sync::Arc;

use bevy::prelude::*;
use bevy_rapier2d::prelude::*;

pub use kind::{Body, DifferentialDrive, Drive, RobotKind, Scoop, TrailerKind};

use crate::behaviour::Activity;
use crate::clock::Clock;
use crate::drive::WheelCommand;
use crate::game::MatchEntity;
use crate::geometry::{Pose, Twist};
use crate::ids::RobotId;
use crate::motor::{Contributions, MotorDice, SteeringIntent};
use crate::perception::Memory;
use crate::rng::Seed;
use crate::sense::{Eyesight, Odometry, Percepts, Sensing};
use crate::strategy::Strategy;
use crate::teamwork::Role;
use crate::world_model::WorldModel;

/// A robot; its entity is its drive unit.
#[derive(Component, Clone, Debug)]
#[component(immutable)]
pub struct Robot {
    pub kind: Arc<RobotKind>,
    /// Ticks between two decisions.
    decision_ticks: u64,
}

impl Robot {
    pub fn new(kind: Arc<RobotKind>, clock: &Clock) -> Robot {
        let decision_ticks = clock.ticks(1.0 / kind.control_hz);
        Robot { kind, decision_ticks }
    }

    /// Whether the robot's control system decides in this tick.
    pub fn decides(&self, clock: &Clock) -> bool {
        clock.tick.is_multiple_of(self.decision_ticks)
    }
}

/// The trailer of a robot, a body of its own.
#[derive(Component, Clone, Copy, Debug)]
#[component(immutable)]
pub struct Trailer {
    pub of: RobotId,
    /// The middle of its outline as seen from the hitch, m.
    pub middle: Vec2,
    /// Radius around that middle that holds the outline, m.
    pub radius: f32,
}

/// What a robot brings to a match.
#[derive(Clone, Debug)]
pub struct Entry<'a> {
    pub id: RobotId,
    pub role: usize,
    pub kind: Arc<RobotKind>,
    pub sensing: Arc<Sensing>,
    pub strategy: &'a Strategy,
    pub seed: Seed,
}

/// Spawns a robot and its trailer at the origin, not yet known to the physics; returns both.
pub fn spawn_robot(world: &mut World, entry: &Entry, clock: &Clock) -> (Entity, Option<Entity>) {
    let kind = &entry.kind;
    let unit = world
        .spawn((
            (
                Name::new(format!("robot {}", entry.id)),
                MatchEntity,
                entry.id,
                Robot::new(kind.clone(), clock),
                Pose::default(),
                Twist::default(),
                WheelCommand::default(),
                SteeringIntent::default(),
                Contributions::default(),
                MotorDice::new(entry.seed, entry.id),
            ),
            (
                Role(entry.role),
                Activity::new(entry.strategy, entry.role, 0),
                Memory::new(entry.strategy.slots),
                WorldModel::default(),
                Percepts::default(),
                Eyesight::new(entry.sensing.clone(), entry.seed, entry.id),
                Odometry::new(entry.seed, entry.id),
            ),
            rigid_body(unit_collider(kind), kind.body.mass, kind.body.friction, kind.body.restitution),
        ))
        .id();
    let trailer = kind.trailer.as_ref().and_then(|trailer| {
        let outline = Collider::convex_hull(&trailer.outline)?;
        let middle = trailer.outline.iter().sum::<Vec2>() / trailer.outline.len() as f32;
        let radius = trailer.outline.iter().map(|corner| corner.distance(middle)).fold(0.0, f32::max);
        let hitch = TypedJoint::RevoluteJoint(RevoluteJointBuilder::new().build());
        let mut joint = ImpulseJoint::new(unit, hitch);
        joint.data.as_mut().set_contacts_enabled(false);
        let spawned = world.spawn((
            Name::new(format!("trailer {}", entry.id)),
            MatchEntity,
            Trailer { of: entry.id, middle, radius },
            Pose::default(),
            Twist::default(),
            rigid_body(outline, trailer.mass, trailer.friction, trailer.restitution),
            joint,
        ));
        Some(spawned.id())
    });
    (unit, trailer)
}

/// Body and jaws of a drive unit, around its centre.
fn unit_collider(kind: &RobotKind) -> Collider {
    let half = Vec2::new(kind.body.length, kind.body.width) / 2.0;
    let mut parts = vec![(Vec2::ZERO, 0.0, Collider::cuboid(half.x, half.y))];
    for jaw in jaws(kind) {
        parts.extend(Collider::convex_hull(&jaw).map(|jaw| (Vec2::ZERO, 0.0, jaw)));
    }
    if parts.len() == 1 { Collider::cuboid(half.x, half.y) } else { Collider::compound(parts) }
}

/// The outlines of the scoop's jaws, from the drive unit's centre: wide at the body, flared at the tip.
pub fn jaws(kind: &RobotKind) -> Vec<[Vec2; 3]> {
    let Some(scoop) = &kind.scoop else { return Vec::new() };
    let front = kind.body.length / 2.0;
    let outer = scoop.half_gap + scoop.jaw;
    let jaw = |side: f32| {
        [
            Vec2::new(front, side * scoop.half_gap),
            Vec2::new(front, side * outer),
            Vec2::new(front + scoop.depth, side * outer),
        ]
    };
    vec![jaw(1.0), jaw(-1.0)]
}

fn rigid_body(collider: Collider, mass: f32, friction: f32, restitution: f32) -> impl Bundle {
    (
        RigidBody::Dynamic,
        Transform::default(),
        collider,
        ColliderMassProperties::Mass(mass),
        Friction { coefficient: friction, combine_rule: CoefficientCombineRule::Min },
        Restitution { coefficient: restitution, combine_rule: CoefficientCombineRule::Max },
        Sleeping::disabled(),
    )
}

/// The ball's rigid body.
pub fn ball_body(radius: f32, mass: f32, friction: f32, restitution: f32) -> impl Bundle {
    (rigid_body(Collider::ball(radius), mass, friction, restitution), Ccd::enabled())
}
