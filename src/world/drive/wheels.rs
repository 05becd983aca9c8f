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
    /// 1/(kg·m²).
    pub inverse_inertia: f32,
}

impl Rigid {
    fn velocity_at(&self, point: Vec2) -> Vec2 {
        self.linear + self.angular * (point - self.centre).perp()
    }

    fn push(&mut self, impulse: Vec2, point: Vec2) {
        self.linear += impulse / self.mass;
        self.angular += self.inverse_inertia * (point - self.centre).perp_dot(impulse);
    }

    /// The mass that an impulse along `direction` at `point` has to move, kg.
    fn mass_felt(&self, point: Vec2, direction: Vec2) -> f32 {
        let lever = (point - self.centre).perp_dot(direction);
        1.0 / (1.0 / self.mass + self.inverse_inertia * lever * lever)
    }
}

/// An impulse along one direction that drives the velocity there to a target, within a limit over all passes.
struct Contact {
    point: Vec2,
    direction: Vec2,
    target: f32,
    limit: f32,
    mass: f32,
    applied: f32,
}

impl Contact {
    fn new(body: &Rigid, point: Vec2, direction: Vec2, target: f32, limit: f32) -> Contact {
        let mass = body.mass_felt(point, direction);
        Contact { point, direction, target, limit, mass, applied: 0.0 }
    }

    fn solve(&mut self, body: &mut Rigid) {
        let missing = self.target - body.velocity_at(self.point).dot(self.direction);
        let wanted = (self.applied + missing * self.mass).clamp(-self.limit, self.limit);
        body.push((wanted - self.applied) * self.direction, self.point);
        self.applied = wanted;
    }
}

/// Changes the velocities of a drive unit and its trailer by what their wheels do in `dt` seconds.
pub fn push_wheels(
    unit: &mut Rigid,
    trailer: Option<(&mut Rigid, &TrailerKind)>,
    wheels: WheelSpeeds,
    drive: &DifferentialDrive,
    dt: f32,
) {
    let left = unit.forward.perp();
    let hub = left * (drive.track / 2.0);
    let push = drive.wheel_force * dt;
    let grip = drive.grip * unit.mass * GRAVITY * dt;
    let mut contacts = [
        Contact::new(unit, unit.hitch, left, 0.0, grip),
        Contact::new(unit, unit.hitch + hub, unit.forward, wheels.left, push),
        Contact::new(unit, unit.hitch - hub, unit.forward, wheels.right, push),
    ];
    let Some((trailer, kind)) = trailer else {
        for _ in 0..PASSES {
            contacts.iter_mut().for_each(|contact| contact.solve(unit));
        }
        return;
    };
    let axle = trailer.hitch - trailer.forward * kind.axle;
    let weight = trailer.mass * GRAVITY * dt;
    let mut trailer_contacts = [
        Contact::new(trailer, axle, trailer.forward.perp(), 0.0, kind.grip * weight),
        Contact::new(trailer, axle, trailer.forward, 0.0, kind.rolling * weight),
    ];
    for _ in 0..PASSES {
        contacts.iter_mut().for_each(|contact| contact.solve(unit));
        trailer_contacts.iter_mut().for_each(|contact| contact.solve(trailer));
        couple(unit, trailer);
    }
}

/// The impulse at the hitch that takes away the difference of the two bodies' velocities there.
fn couple(unit: &mut Rigid, trailer: &mut Rigid) {
    let gap = trailer.velocity_at(trailer.hitch) - unit.velocity_at(unit.hitch);
    let arms = [(unit.hitch - unit.centre, &*unit), (trailer.hitch - trailer.centre, &*trailer)];
    let (mut a, mut b, mut c) = (0.0, 0.0, 0.0);
    for (arm, body) in arms {
        a += 1.0 / body.mass + body.inverse_inertia * arm.y * arm.y;
        b -= body.inverse_inertia * arm.x * arm.y;
        c += 1.0 / body.mass + body.inverse_inertia * arm.x * arm.x;
    }
    let impulse = Vec2::new(c * gap.x - b * gap.y, a * gap.y - b * gap.x) / (a * c - b * b);
    unit.push(impulse, unit.hitch);
    trailer.push(-impulse, trailer.hitch);
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
            inverse_inertia: 10.0,
        }
    }

    #[test]
    fn two_wheels_push_with_no_more_than_their_force() {
        let mut body = unit(Vec2::ZERO);
        push_wheels(&mut body, None, WheelSpeeds { left: 1.0, right: 1.0 }, &DRIVE, 0.01);
        assert!((body.linear.x - 2.0 * 20.0 * 0.01 / 5.0).abs() < 1e-5, "{}", body.linear.x);
        assert!(body.linear.y.abs() < 1e-6 && body.angular.abs() < 1e-5);
    }

    #[test]
    fn a_shove_from_the_side_beyond_the_grip_makes_it_slide() {
        let mut gentle = unit(Vec2::new(0.0, 0.05));
        push_wheels(&mut gentle, None, WheelSpeeds::default(), &DRIVE, 0.01);
        assert!(gentle.linear.y.abs() < 1e-6);
        let mut hard = unit(Vec2::new(0.0, 1.0));
        push_wheels(&mut hard, None, WheelSpeeds::default(), &DRIVE, 0.01);
        assert!((hard.linear.y - (1.0 - 0.8 * 9.81 * 0.01)).abs() < 1e-5, "{}", hard.linear.y);
    }

    #[test]
    fn the_hitch_moves_as_one_point_and_keeps_momentum() {
        let mut front = unit(Vec2::new(1.0, 0.0));
        let mut rear = Rigid { centre: Vec2::new(-0.2, 0.1), mass: 4.0, ..unit(Vec2::new(0.0, 0.3)) };
        let before = front.linear * front.mass + rear.linear * rear.mass;
        couple(&mut front, &mut rear);
        assert!((front.velocity_at(Vec2::ZERO) - rear.velocity_at(Vec2::ZERO)).length() < 1e-5);
        assert!((front.linear * front.mass + rear.linear * rear.mass - before).length() < 1e-5);
    }
}
