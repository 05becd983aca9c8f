//! Tyre forces of a drive unit and its trailer, at impulse level: driven wheels push up to their force limit, every axle
//! resists sliding sideways up to its grip, the trailer rolls with a little resistance, and the hitch couples the two.
//!
//! A few Gauss-Seidel passes with accumulated, clamped impulses, right before the rigid-body step.

use bevy::prelude::*;

use crate::robot::{DifferentialDrive, TrailerKind, WheelSpeeds};

const PASSES: usize = 4;
const GRAVITY: f32 = 9.81;

/// The velocity state of one rigid body, with what is needed to push it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    /// The hitch point, at which drive unit and trailer meet, m.
    pub hitch: Vec2,
    /// Unit vector ahead.
    pub forward: Vec2,
    /// Centre of mass, m.
    pub centre: Vec2,
    /// m/s.
    pub linear: Vec2,
    /// rad/s, counter-clockwise.
    pub angular: f32,
    /// kg.
    pub mass: f32,
    /// 1/kg.
    pub inverse_mass: f32,
    /// 1/(kg·m²).
    pub inverse_inertia: f32,
}

/// An arm goes from the centre of mass to a point of the body, m.
impl Rigid {
    fn velocity_at(&self, arm: Vec2) -> Vec2 {
        self.linear + self.angular * arm.perp()
    }

    fn push(&mut self, impulse: Vec2, arm: Vec2) {
        self.linear += impulse * self.inverse_mass;
        self.angular += self.inverse_inertia * arm.perp_dot(impulse);
    }

    /// How much the velocity at the end of an arm changes for an impulse along a direction, 1/kg.
    fn yields(&self, direction: Vec2, arm: Vec2) -> Vec2 {
        self.inverse_mass * direction + self.inverse_inertia * arm.perp_dot(direction) * arm.perp()
    }
}

/// An impulse along one direction that drives the velocity there to a target, within a limit over all passes.
#[derive(Clone, Debug)]
struct Contact {
    arm: Vec2,
    direction: Vec2,
    target: f32,
    limit: f32,
    /// What an impulse along the direction has to move, kg.
    mass: f32,
    applied: f32,
}

impl Contact {
    fn new(body: &Rigid, point: Vec2, direction: Vec2, target: f32, limit: f32) -> Contact {
        let arm = point - body.centre;
        let mass = 1.0 / direction.dot(body.yields(direction, arm));
        Contact { arm, direction, target, limit, mass, applied: 0.0 }
    }

    fn solve(&mut self, body: &mut Rigid) {
        let missing = self.target - body.velocity_at(self.arm).dot(self.direction);
        let wanted = (self.applied + missing * self.mass).clamp(-self.limit, self.limit);
        body.push((wanted - self.applied) * self.direction, self.arm);
        self.applied = wanted;
    }
}

/// What keeps the hitch points of a drive unit and its trailer together.
#[derive(Clone, Debug)]
struct Hitch {
    /// The drive unit's arm and the trailer's.
    arms: [Vec2; 2],
    /// The impulses for a difference of velocities of 1 m/s along x and along y, kg m/s.
    impulses: [Vec2; 2],
}

impl Hitch {
    fn new(unit: &Rigid, trailer: &Rigid) -> Hitch {
        let arms = [unit, trailer].map(|body| body.hitch - body.centre);
        let [x, y] =
            [Vec2::X, Vec2::Y].map(|axis| unit.yields(axis, arms[0]) + trailer.yields(axis, arms[1]));
        let impulses = [Vec2::new(y.y, -x.y), Vec2::new(-y.x, x.x)].map(|column| column / x.perp_dot(y));
        Hitch { arms, impulses }
    }

    /// Takes away the difference of the two bodies' velocities there.
    fn solve(&self, unit: &mut Rigid, trailer: &mut Rigid) {
        let gap = trailer.velocity_at(self.arms[1]) - unit.velocity_at(self.arms[0]);
        let impulse = self.impulses[0] * gap.x + self.impulses[1] * gap.y;
        unit.push(impulse, self.arms[0]);
        trailer.push(-impulse, self.arms[1]);
    }
}

/// A drive unit and its trailer, if it has one, and what their wheels do in a tick.
#[derive(Clone, Debug)]
pub struct WheelContacts {
    unit: Rigid,
    contacts: [Contact; 3],
    trailer: Option<TrailerContacts>,
}

#[derive(Clone, Debug)]
struct TrailerContacts {
    body: Rigid,
    contacts: [Contact; 2],
    hitch: Hitch,
}

impl WheelContacts {
    /// Those that push for `dt` seconds.
    pub fn new(
        unit: Rigid,
        trailer: Option<(Rigid, &TrailerKind)>,
        speeds: WheelSpeeds,
        drive: &DifferentialDrive,
        dt: f32,
    ) -> WheelContacts {
        let left = unit.forward.perp();
        let hub = left * (drive.track / 2.0);
        let push = drive.wheel_force * dt;
        let grip = drive.grip * unit.mass * GRAVITY * dt;
        let contacts = [
            Contact::new(&unit, unit.hitch, left, 0.0, grip),
            Contact::new(&unit, unit.hitch + hub, unit.forward, speeds.left, push),
            Contact::new(&unit, unit.hitch - hub, unit.forward, speeds.right, push),
        ];
        let trailer = trailer.map(|(body, kind)| TrailerContacts::new(body, &unit, kind, dt));
        WheelContacts { unit, contacts, trailer }
    }

    /// The drive unit and its trailer.
    pub fn bodies(&self) -> [Option<&Rigid>; 2] {
        [Some(&self.unit), self.trailer.as_ref().map(|trailer| &trailer.body)]
    }

    fn pass(&mut self) {
        self.contacts.iter_mut().for_each(|contact| contact.solve(&mut self.unit));
        if let Some(TrailerContacts { body, contacts, hitch }) = &mut self.trailer {
            contacts.iter_mut().for_each(|contact| contact.solve(body));
            hitch.solve(&mut self.unit, body);
        }
    }
}

impl TrailerContacts {
    fn new(body: Rigid, unit: &Rigid, kind: &TrailerKind, dt: f32) -> TrailerContacts {
        let axle = body.hitch - body.forward * kind.axle;
        let weight = body.mass * GRAVITY * dt;
        let contacts = [
            Contact::new(&body, axle, body.forward.perp(), 0.0, kind.grip * weight),
            Contact::new(&body, axle, body.forward, 0.0, kind.rolling * weight),
        ];
        TrailerContacts { hitch: Hitch::new(unit, &body), body, contacts }
    }
}

/// Changes the velocities of drive units and trailers by what their wheels do. Robots take turns, pass by pass: a pass of one
/// waits for its last, while the passes of several go on at once in the processor.
pub fn push_wheels(robots: &mut [WheelContacts]) {
    for _ in 0..PASSES {
        robots.iter_mut().for_each(WheelContacts::pass);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DRIVE: DifferentialDrive = DifferentialDrive {
        track: 0.4,
        max_speed: 1.0,
        acceleration: 2.0,
        wheel_force: 20.0,
        grip: 0.8,
        dead_band: 3.0,
        turn_gain: 4.0,
        turn_rate: 150.0,
    };

    fn unit(linear: Vec2) -> Rigid {
        Rigid {
            hitch: Vec2::ZERO,
            forward: Vec2::X,
            centre: Vec2::ZERO,
            linear,
            angular: 0.0,
            mass: 5.0,
            inverse_mass: 0.2,
            inverse_inertia: 10.0,
        }
    }

    fn pushed(unit: Rigid, speeds: WheelSpeeds) -> Rigid {
        let mut wheels = [WheelContacts::new(unit, None, speeds, &DRIVE, 0.01)];
        push_wheels(&mut wheels);
        wheels[0].unit
    }

    #[test]
    fn two_wheels_push_with_no_more_than_their_force() {
        let body = pushed(unit(Vec2::ZERO), WheelSpeeds { left: 1.0, right: 1.0 });
        assert!((body.linear.x - 2.0 * 20.0 * 0.01 / 5.0).abs() < 1e-5, "{}", body.linear.x);
        assert!(body.linear.y.abs() < 1e-6 && body.angular.abs() < 1e-5);
    }

    #[test]
    fn a_shove_from_the_side_beyond_the_grip_makes_it_slide() {
        let gentle = pushed(unit(Vec2::new(0.0, 0.05)), WheelSpeeds::default());
        assert!(gentle.linear.y.abs() < 1e-6);
        let hard = pushed(unit(Vec2::new(0.0, 1.0)), WheelSpeeds::default());
        assert!((hard.linear.y - (1.0 - 0.8 * 9.81 * 0.01)).abs() < 1e-5, "{}", hard.linear.y);
    }

    #[test]
    fn the_hitch_moves_as_one_point_and_keeps_momentum() {
        let mut front = unit(Vec2::new(1.0, 0.0));
        let mut rear = Rigid {
            centre: Vec2::new(-0.2, 0.1),
            mass: 4.0,
            inverse_mass: 0.25,
            ..unit(Vec2::new(0.0, 0.3))
        };
        let before = front.linear * front.mass + rear.linear * rear.mass;
        Hitch::new(&front, &rear).solve(&mut front, &mut rear);
        let velocity = |body: &Rigid| body.velocity_at(body.hitch - body.centre);
        assert!((velocity(&front) - velocity(&rear)).length() < 1e-5);
        assert!((front.linear * front.mass + rear.linear * rear.mass - before).length() < 1e-5);
    }
}
