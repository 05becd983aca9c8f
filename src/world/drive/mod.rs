//! The Drive stage: what a robot wants, or its pilot, becomes forces of its wheels or legs.
//!
//! Pilot and strategy share the limits of speed, acceleration and force.

mod differential;
mod footing;
mod neck;
mod walker;
mod wheels;

use bevy::ecs::query::QueryData;
use bevy::prelude::*;
use bevy_rapier2d::rapier::dynamics::RigidBody as Body;
use smallvec::SmallVec;

pub use differential::steer;
pub use walker::{GaitError, Trunk, push_legs, stride};
pub use wheels::{Rigid, WheelContacts, push_wheels};

use crate::clock::Clock;
use crate::geometry::wrap_angle;
use crate::ops;
use crate::rng::DiceStirred;
use crate::robot::handling::Handling;
use crate::robot::pilot::Pilot;
use crate::robot::{
    DifferentialDrive, Drive, DriveCommand, Footing, Gait, GaitNoise, Odometry, Orders, Robot, RobotBodies,
    RobotStart, SteeringIntent, Walker, WheelSpeeds,
};
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use crate::world::body_events::BodyEvents;
use crate::world::physics::Bodies;

pub(super) fn plugin(app: &mut App) {
    app.match_component::<GaitError>()
        .starts(|start: &RobotStart, _| GaitError::new(start.seed, start.id))
        .on(|error, stirred: &DiceStirred, _| error.dice.stir(*stirred));
    app.match_resource::<BodyEvents>().starts_empty();
    let driving = (footing::keep_footing, command_motors, push_bodies).chain();
    app.add_systems(Tick, (driving, neck::turn_heads).in_set(TickSystems::Drive));
}

/// A robot whose motors are told what to do.
#[derive(QueryData)]
#[query_data(mutable)]
struct Driven {
    robot: &'static Robot,
    intent: &'static SteeringIntent,
    pilot: Option<&'static Pilot>,
    odometry: &'static Odometry,
    handling: &'static Handling,
    footing: &'static Footing,
    orders: &'static Orders,
    command: &'static mut DriveCommand,
}

fn command_motors(clock: Res<Clock>, mut robots: Query<Driven>) {
    for mut driven in &mut robots {
        let is_able = driven.robot.health.drives() && driven.footing.stands();
        let may_move = driven.orders.may_move() && is_able;
        let next = match (&driven.robot.kind.drive, *driven.command) {
            (Drive::Differential(drive), DriveCommand::Wheels(speeds)) => {
                let wanted = if may_move { driven.wheels(drive) } else { WheelSpeeds::default() };
                DriveCommand::Wheels(speeds.towards(wanted, drive.acceleration * clock.dt))
            }
            (Drive::Walker(walker), DriveCommand::Gait(gait)) => {
                let wanted = if may_move { driven.gait(walker) } else { Gait::default() };
                DriveCommand::Gait(gait.towards(wanted, walker, clock.dt))
            }
            (Drive::Differential(_) | Drive::Walker(_), _) => DriveCommand::idle(&driven.robot.kind),
        };
        *driven.command = next;
    }
}

impl DrivenItem<'_, '_> {
    fn wheels(&self, drive: &DifferentialDrive) -> WheelSpeeds {
        if let Some(pilot) = self.pilot {
            let turn = pilot.turn * drive.turn_rate.to_radians();
            return WheelSpeeds::from_motion(pilot.throttle * drive.max_speed, turn, drive);
        }
        match *self.intent {
            SteeringIntent::Stop => WheelSpeeds::default(),
            SteeringIntent::Spin(rate) => WheelSpeeds::from_motion(0.0, rate, drive),
            SteeringIntent::Steer { heading, speed, .. } => {
                steer(wrap_angle(heading - self.odometry.pose.heading), speed * drive.max_speed, drive)
            }
        }
    }

    /// Robots that kick or catch do not walk, and one that holds the ball goes gently.
    fn gait(&self, walker: &Walker) -> Gait {
        if self.handling.is_busy() {
            return Gait::default();
        }
        let gait = self.wanted_gait(walker);
        match self.robot.kind.chin.filter(|_| self.handling.holds()) {
            Some(chin) => {
                let fastest = chin.turn.to_radians();
                Gait {
                    ahead: gait.ahead * chin.walk,
                    left: gait.left * chin.walk,
                    turn: gait.turn.clamp(-fastest, fastest),
                }
            }
            None => gait,
        }
    }

    fn wanted_gait(&self, walker: &Walker) -> Gait {
        if let Some(pilot) = self.pilot {
            let (ahead, left) = (pilot.throttle * walker.ahead, pilot.aside * walker.aside);
            return Gait { ahead, left, turn: pilot.turn * walker.turn.to_radians() }.limited(walker);
        }
        let heading = self.odometry.pose.heading;
        match *self.intent {
            SteeringIntent::Stop => Gait::default(),
            SteeringIntent::Spin(rate) => Gait { turn: rate, ..Gait::default() }.limited(walker),
            SteeringIntent::Steer { heading: wanted, facing, speed } => {
                let course = wanted - heading;
                // In reverse the heading is where the nose points.
                stride(course, facing - heading, speed, walker)
            }
        }
    }
}

/// A robot whose bodies are pushed.
#[derive(QueryData)]
#[query_data(mutable)]
pub(crate) struct Pushed {
    robot: &'static Robot,
    handles: &'static RobotBodies,
    command: &'static DriveCommand,
    footing: &'static Footing,
    error: &'static mut GaitError,
}

/// In the order of registration, since Rapier remembers the order in which bodies are touched.
pub(crate) fn push_bodies(clock: Res<Clock>, mut bodies: Bodies, mut robots: Query<Pushed>) {
    let mut in_order: SmallVec<[_; 8]> = robots.iter_mut().collect();
    in_order.sort_unstable_by_key(|pushed| pushed.handles.unit.0.into_raw_parts());
    let (mut rolling, mut wheels) =
        (SmallVec::<[RobotBodies; 8]>::new(), SmallVec::<[WheelContacts; 8]>::new());
    for mut pushed in in_order {
        match (&pushed.robot.kind.drive, *pushed.command) {
            (Drive::Differential(drive), DriveCommand::Wheels(speeds)) => {
                if let Some(pushing) = pushed.wheel_contacts(speeds, drive, &bodies, &clock) {
                    rolling.push(*pushed.handles);
                    wheels.push(pushing);
                }
            }
            (Drive::Walker(walker), DriveCommand::Gait(gait)) => {
                pushed.walk(gait, walker, &mut bodies, &clock);
            }
            (Drive::Differential(_) | Drive::Walker(_), _) => {}
        }
    }
    push_wheels(&mut wheels);
    for (handles, wheels) in rolling.iter().zip(&wheels) {
        let moved = [Some(handles.unit), handles.trailer].into_iter().zip(wheels.bodies());
        for (handle, state) in moved.filter_map(|(handle, state)| handle.zip(state)) {
            if let Some(body) = bodies.get_mut(&handle) {
                body.set_linvel(state.linear, false);
                body.set_angvel(state.angular, false);
            }
        }
    }
}

impl PushedItem<'_, '_> {
    /// The share of its force that is there, and the error of a walker's turn in degrees/s, by how entangled it is.
    fn cost(&self) -> (f32, f32) {
        let strain = self.footing.strain;
        self.robot.kind.contact.map_or((1.0, 0.0), |cost| (cost.share(strain), cost.turn_error(strain)))
    }

    fn wheel_contacts(
        &self,
        speeds: WheelSpeeds,
        drive: &DifferentialDrive,
        bodies: &Bodies,
        clock: &Clock,
    ) -> Option<WheelContacts> {
        let unit = bodies.get(&self.handles.unit).map(rigid)?;
        let trailer = self.handles.trailer.and_then(|handle| bodies.get(&handle)).map(rigid);
        let (share, _) = self.cost();
        let (wheel_force, grip) = (drive.wheel_force * share, drive.grip * share);
        let drive = &DifferentialDrive { wheel_force, grip, ..*drive };
        Some(WheelContacts::new(unit, trailer.zip(self.robot.kind.trailer.as_ref()), speeds, drive, clock.dt))
    }

    fn walk(&mut self, gait: Gait, walker: &Walker, bodies: &mut Bodies, clock: &Clock) {
        let Some(body) = bodies.get_mut(&self.handles.unit) else { return };
        let (share, turn_error) = self.cost();
        let noise = GaitNoise { turn: ops::hypot(walker.noise.turn, turn_error), ..walker.noise };
        let step = clock.ticks(walker.noise.step);
        let gait = self.error.applied(gait, &noise, clock.tick, step).times(share);
        let rigid = rigid(body);
        let trunk = Trunk {
            forward: rigid.forward,
            linear: rigid.linear,
            angular: rigid.angular,
            mass: rigid.mass,
            inverse_inertia: rigid.inverse_inertia,
            lever: self.robot.kind.body.length / 2.0,
        };
        let (linear, angular) = push_legs(&trunk, gait, walker.push * share, clock.dt);
        body.set_linvel(linear, false);
        body.set_angvel(angular, false);
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
        inverse_mass: 1.0 / body.mass(),
        inverse_inertia: properties.effective_world_inv_inertia,
    }
}
