//! Robots: what they are made of, as data and as components that several stages share.

mod bump;
mod calibrated_camera;
mod events;
mod footing;
mod gait;
pub mod handling;
mod health;
mod intent;
mod kind;
mod legs;
mod orders;
pub mod pilot;
mod senses;
pub mod sensing;
mod wheel_speeds;

use std::sync::Arc;

use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;
use smallvec::SmallVec;

pub use bump::{BumpSensing, BumpSensor};
pub use calibrated_camera::{CalibratedCamera, CameraSet, ColoursSet};
pub use events::{Misled, PutDown, RobotStart, StrategyChanged, SwitchedOff, SwitchedOn};
pub use footing::{ContactCost, Falls, Footing};
pub use gait::Gait;
pub use health::{Health, Restart, RobotFailure};
pub use intent::{Head, HeadIntent, KickIntent, SteeringIntent};
pub use kind::{Body, DifferentialDrive, Drive, RobotKind, Scoop, TrailerKind};
pub use legs::{Chin, GaitNoise, Kick, Neck, Strike, Walker};
pub use orders::{Orders, RobotState};
pub use senses::{Fix, Frame, Odometry, Percepts, range_deviation, reckon, should_be_seen};
pub use sensing::{
    Camera, Eyes, Landmarks, Localisation, MemorySpans, OdometryNoise, OdometrySource, PlaceError, Sensing,
};
pub use wheel_speeds::WheelSpeeds;

use crate::clock::Clock;
use crate::ids::RobotId;
use crate::rng::DiceStirred;
use crate::state::RegisterState;
use handling::Handling;
use pilot::Pilot;

/// What lies between body and mind: every robot has it, in this process or another.
pub(crate) fn plugin(app: &mut App) {
    app.match_component::<Robot>().reflected().starts(Robot::at_start);
    app.match_component::<Pilot>()
        .reflected()
        .may_start(|start: &RobotStart, _| start.piloted.then(Pilot::default));
    app.match_component::<OffPitch>();
    app.match_component::<Orders>().reflected().starts(Orders::at_start);
    app.match_component::<Percepts>()
        .reflected()
        .starts(|_: &RobotStart, _| Percepts::default())
        .on(|percepts, _: &PutDown, _| *percepts = Percepts::default())
        .on(|percepts, _: &SwitchedOn, _| *percepts = Percepts::default());
    app.match_component::<CalibratedCamera>()
        .may_start(|start: &RobotStart, _| start.calibration.clone().map(CalibratedCamera))
        .on(|camera, set: &CameraSet, _| camera.set(set))
        .on(|camera, set: &ColoursSet, _| camera.set_colours(set));
    app.match_component::<Odometry>()
        .reflected()
        .starts(|start: &RobotStart, _| Odometry::new(start.seed, start.id))
        .on(|odometry, stirred: &DiceStirred, _| odometry.stir(*stirred));
    app.register_type::<RobotId>().register_type::<Trailer>();
    app.match_component::<SteeringIntent>()
        .reflected()
        .starts(|_: &RobotStart, _| SteeringIntent::Stop)
        .on(|intent, _: &PutDown, _| *intent = SteeringIntent::Stop)
        .on(|intent, _: &SwitchedOff, _| *intent = SteeringIntent::Stop);
    app.match_component::<KickIntent>().reflected().starts(|_: &RobotStart, _| KickIntent::Nothing);
    app.match_component::<HeadIntent>().reflected().starts(|_: &RobotStart, _| HeadIntent::default());
    app.match_component::<Head>().reflected().starts(|_: &RobotStart, _| Head::default());
    app.match_component::<DriveCommand>()
        .reflected()
        .starts(|start: &RobotStart, _| DriveCommand::idle(&start.kind))
        .on(DriveCommand::stop);
    app.match_component::<Footing>()
        .starts(|start: &RobotStart, _| Footing::new(start.seed, start.id))
        .on(|footing, _: &PutDown, _| footing.stand())
        .on(|footing, stirred: &DiceStirred, _| footing.dice.stir(*stirred));
    app.match_component::<Handling>()
        .starts(|start: &RobotStart, _| Handling::new(start.seed, start.id))
        .on(|handling, _: &PutDown, _| handling.let_go())
        .on(|handling, stirred: &DiceStirred, _| handling.dice.stir(*stirred));
}

/// A robot; its entity is its drive unit. Its health is changed by the Script stage only.
#[derive(Component, Clone, Debug, Reflect)]
#[reflect(Component, from_reflect = false)]
pub struct Robot {
    /// What it is built as.
    #[reflect(ignore)]
    pub kind: Arc<RobotKind>,
    /// How well it senses.
    #[reflect(ignore)]
    pub sensing: Arc<Sensing>,
    /// What is wrong with it.
    pub health: Health,
    /// Its decisions are made in another process.
    pub remote: bool,
    /// Ticks between two decisions.
    decision_ticks: u64,
}

impl Robot {
    /// A robot that is well.
    pub fn new(kind: Arc<RobotKind>, sensing: Arc<Sensing>, clock: &Clock) -> Robot {
        let decision_ticks = clock.ticks(1.0 / kind.control_hz);
        Robot { kind, sensing, health: Health::default(), remote: false, decision_ticks }
    }

    fn at_start(start: &RobotStart, _: &World) -> Robot {
        let mut robot = Robot::new(start.kind.clone(), start.sensing.clone(), &start.clock);
        robot.health.crashed = !start.on;
        robot
    }

    /// Whether the robot's control system decides in this tick, and here.
    pub fn decides(&self, clock: &Clock) -> bool {
        !self.remote && self.senses(clock)
    }

    /// Whether its sensors are read in this tick.
    pub fn senses(&self, clock: &Clock) -> bool {
        !self.health.crashed && self.is_due(clock.tick)
    }

    /// Whether a decision falls into a tick, as long as the robot is on.
    pub fn is_due(&self, tick: u64) -> bool {
        tick.is_multiple_of(self.decision_ticks)
    }
}

/// The trailer of a robot, a body of its own.
#[derive(Component, Clone, Copy, Debug, Reflect)]
#[reflect(Component)]
#[component(immutable)]
pub struct Trailer {
    /// The robot that pulls it.
    pub of: RobotId,
    /// The middle of its outline as seen from the hitch, m.
    pub middle: Vec2,
    /// Radius around that middle that holds the outline, m.
    pub radius: f32,
}

/// What a robot's motors are told, after the limits of acceleration. Written by the Drive stage.
#[derive(Component, Clone, Copy, Debug, PartialEq, Reflect)]
#[reflect(Component)]
pub enum DriveCommand {
    /// For two wheels.
    Wheels(WheelSpeeds),
    /// For legs.
    Gait(Gait),
}

impl DriveCommand {
    /// A robot that is told to stand.
    pub fn idle(kind: &RobotKind) -> DriveCommand {
        match kind.drive {
            Drive::Differential(_) => DriveCommand::Wheels(WheelSpeeds::default()),
            Drive::Walker(_) => DriveCommand::Gait(Gait::default()),
        }
    }

    fn stop(&mut self, _: &PutDown, owner: EntityRef) {
        if let Some(robot) = owner.get::<Robot>() {
            *self = DriveCommand::idle(&robot.kind);
        }
    }

    /// Where the robot is told to go: m/s ahead and to the left.
    pub fn velocity(&self) -> Vec2 {
        match self {
            DriveCommand::Wheels(speeds) => Vec2::X * ((speeds.left + speeds.right) / 2.0),
            DriveCommand::Gait(gait) => Vec2::new(gait.ahead, gait.left),
        }
    }

    /// The fastest that a wheel or the legs are told to move, m/s.
    pub fn speed(&self) -> f32 {
        match self {
            DriveCommand::Wheels(speeds) => speeds.left.abs().max(speeds.right.abs()),
            DriveCommand::Gait(gait) => gait.speed().max(0.1 * gait.turn.abs()),
        }
    }
}

/// Rapier's handles of a robot's bodies.
#[derive(Component, Clone, Copy, Debug)]
#[component(immutable)]
pub struct RobotBodies {
    /// The drive unit.
    pub unit: RapierRigidBodyHandle,
    /// The trailer.
    pub trailer: Option<RapierRigidBodyHandle>,
}

impl RobotBodies {
    /// The drive unit and, if there is one, the trailer.
    pub fn all(&self) -> SmallVec<[RapierRigidBodyHandle; 2]> {
        [Some(self.unit), self.trailer].into_iter().flatten().collect()
    }
}

/// On a robot that the referee has taken off the pitch.
#[derive(Component, Clone, Copy, Debug)]
pub struct OffPitch;

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
