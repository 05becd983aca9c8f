//! The Drive stage: what a robot wants, or its pilot, becomes forces of its wheels.
//!
//! Pilot and strategy share the limits of speed, acceleration and force.

mod differential;
mod wheels;

use bevy::prelude::*;
use bevy_rapier2d::rapier::dynamics::RigidBody as Body;
use smallvec::SmallVec;

pub use differential::steer;
pub use wheels::{Rigid, push_wheels};

use crate::clock::Clock;
use crate::geometry::wrap_angle;
use crate::ids::RobotId;
use crate::motor::SteeringIntent;
use crate::physics::Bodies;
use crate::pilot::Pilot;
use crate::referee::{MatchState, Phase};
use crate::robot::{
    DifferentialDrive, Drive, OffPitch, Robot, RobotBodies, TrailerKind, WheelCommand, WheelSpeeds,
};
use crate::schedule::{Tick, TickSystems};
use crate::sense::Odometry;

pub(super) fn plugin(app: &mut App) {
    app.add_systems(Tick, (command_wheels, push_bodies).chain().in_set(TickSystems::Drive));
}

type Commanded<'a> =
    (&'a Robot, &'a SteeringIntent, Option<&'a Pilot>, &'a Odometry, &'a mut WheelCommand, Has<OffPitch>);

fn command_wheels(clock: Res<Clock>, state: Res<MatchState>, mut robots: Query<Commanded>) {
    for (robot, intent, pilot, odometry, mut command, off_pitch) in &mut robots {
        let Drive::Differential(drive) = &robot.kind.drive;
        let wanted = if state.phase != Phase::Playing || off_pitch || !robot.condition.drives() {
            WheelSpeeds::default()
        } else if let Some(pilot) = pilot {
            piloted(pilot, drive)
        } else {
            intended(*intent, odometry.pose.heading, drive)
        };
        command.speeds = command.speeds.towards(wanted, drive.acceleration * clock.dt);
    }
}

fn piloted(pilot: &Pilot, drive: &DifferentialDrive) -> WheelSpeeds {
    let turn = pilot.turn * drive.turn_rate.to_radians();
    WheelSpeeds::from_motion(pilot.throttle * drive.max_speed, turn, drive)
}

fn intended(intent: SteeringIntent, heading: f32, drive: &DifferentialDrive) -> WheelSpeeds {
    match intent {
        SteeringIntent::Stop => WheelSpeeds::default(),
        SteeringIntent::Spin(rate) => WheelSpeeds::from_motion(0.0, rate, drive),
        SteeringIntent::Steer { heading: wanted, speed } => {
            steer(wrap_angle(wanted - heading), speed * drive.max_speed, drive)
        }
    }
}

type Pushed<'a> = (&'a RobotId, &'a Robot, &'a RobotBodies, &'a WheelCommand);

/// In order, since Rapier remembers the order in which bodies are touched.
fn push_bodies(clock: Res<Clock>, mut bodies: Bodies, robots: Query<Pushed>) {
    let mut in_order: SmallVec<[_; 16]> = robots.iter().collect();
    in_order.sort_unstable_by_key(|(id, ..)| **id);
    for (_, robot, handles, command) in in_order {
        let Drive::Differential(drive) = &robot.kind.drive;
        let Some(mut unit) = bodies.get(&handles.unit).map(rigid) else { continue };
        let kind: Option<&TrailerKind> = robot.kind.trailer.as_ref();
        let mut trailer = handles.trailer.and_then(|handle| bodies.get(&handle)).map(rigid);
        push_wheels(&mut unit, trailer.as_mut().zip(kind), command.speeds, drive, clock.dt);
        let moved = [Some(handles.unit).zip(Some(unit)), handles.trailer.zip(trailer)];
        for (handle, state) in moved.into_iter().flatten() {
            if let Some(body) = bodies.get_mut(&handle) {
                body.set_linvel(state.linear, false);
                body.set_angvel(state.angular, false);
            }
        }
    }
}

fn rigid(body: &Body) -> Rigid {
    let properties = body.mass_properties();
    let rotation = body.rotation();
    Rigid {
        hitch: body.translation(),
        forward: Vec2::new(rotation.cos(), rotation.sin()),
        centre: properties.world_com,
        linear: body.linvel(),
        angular: body.angvel(),
        mass: body.mass(),
        inverse_inertia: properties.effective_world_inv_inertia,
    }
}
