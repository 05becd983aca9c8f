//! The ball: a sphere on carpet that first slides, then rolls, and is held a little by a robot's scoop.
//!
//! The rigid body moves freely in the plane; the carpet's friction and the ball's spin are ours, applied before each step.

use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;
use smallvec::SmallVec;

use crate::clock::Clock;
use crate::geometry::{Pose, unit};
use crate::ids::RobotId;
use crate::pitch::BallKind;
use crate::rng::{Dice, DiceStirred, Seed};
use crate::robot::{Robot, Scoop};
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use crate::world::physics::{Bodies, step};

pub(super) fn plugin(app: &mut App) {
    app.match_component::<BallDice>().on(|dice, stirred: &DiceStirred, _| dice.0.stir(*stirred));
    app.match_component::<Rolling>().on(|rolling, put: &BallPut, _| rolling.0 = put.velocity);
    app.add_systems(Tick, (hold_ball_in_scoops, roll_ball).chain().before(step).in_set(TickSystems::Physics));
}

/// The ball, with the part of its spin that rolling needs.
#[derive(Component, Clone, Copy, Debug)]
pub struct Ball;

/// The velocity in m/s at which the ball's surface rolls: equal to its velocity once it no longer slides.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct Rolling(pub Vec2);

/// Somebody has put the ball somewhere, rolling at this velocity, m/s.
#[derive(Clone, Copy, Debug)]
pub struct BallPut {
    /// m/s
    pub velocity: Vec2,
}

/// The carpet's seams: small turns of a rolling ball.
#[derive(Component, Clone, Debug)]
pub struct BallDice(Dice);

impl BallDice {
    /// The dice of a match with this seed.
    pub fn new(seed: Seed) -> BallDice {
        BallDice(Dice::new(seed, "ball", None))
    }
}

/// Speeds below this count as standing still, m/s.
const STANDSTILL: f32 = 0.005;

/// What the carpet does to a ball in `dt` seconds: velocity and rolling velocity afterwards, m/s.
///
/// A sliding ball loses speed and gains spin until both agree, at 1/(1 + inertia) of the speed it started with without spin;
/// a rolling one loses speed at a constant rate.
pub fn carpet(velocity: Vec2, rolling: Vec2, kind: &BallKind, dt: f32) -> (Vec2, Vec2) {
    let slip = velocity - rolling;
    let gain = kind.sliding * dt;
    let slip_lost = gain * (1.0 + 1.0 / kind.inertia);
    if slip.length() > slip_lost {
        let against = -slip.normalize();
        return (velocity + against * gain, rolling - against * (gain / kind.inertia));
    }
    let common = velocity - slip / (1.0 + 1.0 / kind.inertia);
    let speed = common.length() - kind.rolling * dt;
    if speed < STANDSTILL {
        return (Vec2::ZERO, Vec2::ZERO);
    }
    let slowed = common.normalize() * speed;
    (slowed, slowed)
}

fn roll_ball(
    clock: Res<Clock>,
    mut bodies: Bodies,
    kind: Res<BallKind>,
    ball: Single<(&RapierRigidBodyHandle, &mut Rolling, &mut BallDice), With<Ball>>,
) {
    let (handle, mut rolling, mut dice) = ball.into_inner();
    let Some(body) = bodies.get_mut(handle) else { return };
    if body.linvel() == Vec2::ZERO && rolling.0 == Vec2::ZERO {
        return;
    }
    let (mut velocity, roll) = carpet(body.linvel(), rolling.0, &kind, clock.dt);
    let turn = kind.wander.to_radians() * (velocity.length() * clock.dt).sqrt();
    let seam = unit(dice.0.normal(turn));
    velocity = seam.rotate(velocity);
    rolling.0 = seam.rotate(roll);
    body.set_linvel(velocity, false);
    body.set_angvel(0.0, false);
}

/// The force in newtons with which a scoop pulls the ball towards its pocket, in the robot's frame.
///
/// `gap` is the free space between body and ball, `aside` the ball's offset to the left, `drift` the ball's velocity
/// relative to the pocket. Zero beyond the scoop's reach; never more than its hold.
pub fn scoop_hold(scoop: &Scoop, gap: f32, aside: f32, drift: Vec2) -> Vec2 {
    if gap > scoop.hold_reach || aside.abs() > scoop.hold_half_width {
        return Vec2::ZERO;
    }
    let pull = -scoop.hold_stiffness * Vec2::new(gap.max(0.0), aside) - scoop.hold_damping * drift;
    pull.clamp_length_max(scoop.hold_force)
}

fn hold_ball_in_scoops(
    clock: Res<Clock>,
    mut bodies: Bodies,
    kind: Res<BallKind>,
    ball: Single<(&RapierRigidBodyHandle, &Pose), With<Ball>>,
    robots: Query<(&RobotId, &Robot, &RapierRigidBodyHandle, &Pose)>,
) {
    let (ball_handle, ball_pose) = *ball;
    let mut pulls: SmallVec<[_; 4]> = SmallVec::new();
    for (id, robot, handle, pose) in &robots {
        let Some(scoop) = &robot.kind.scoop else { continue };
        if pose.position.distance(ball_pose.position) >= NEAR {
            continue;
        }
        let offset = pose.to_local(ball_pose.position);
        let gap = offset.x - robot.kind.body.length / 2.0 - kind.radius;
        if offset.x < 0.0 || gap > scoop.hold_reach {
            continue;
        }
        let (Some(ball), Some(unit)) = (bodies.get(ball_handle), bodies.get(handle)) else { continue };
        let drift = ball.linvel() - unit.velocity_at_point(ball_pose.position);
        let forward = pose.forward();
        let local_drift = Vec2::new(drift.dot(forward), drift.dot(forward.perp()));
        let force = scoop_hold(scoop, gap, offset.y, local_drift);
        pulls.push((*id, *handle, forward.rotate(force) * clock.dt));
    }
    // All pulls are known before the first one acts, and they act in an order that does not depend on the query's.
    pulls.sort_unstable_by_key(|(id, ..)| *id);
    for (_, handle, impulse) in pulls {
        if let Some(body) = bodies.get_mut(ball_handle) {
            body.apply_impulse(impulse, false);
        }
        if let Some(unit_body) = bodies.get_mut(&handle) {
            unit_body.apply_impulse_at_point(-impulse, ball_pose.position, false);
        }
    }
}

/// Farther from the ball than this no robot can hold it, m.
const NEAR: f32 = 0.5;

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE_5: BallKind = BallKind {
        radius: 0.11,
        mass: 0.43,
        rolling: 0.3,
        sliding: 3.4,
        inertia: 2.0 / 3.0,
        friction: 0.3,
        restitution: 0.2,
        wander: 0.0,
    };

    fn run(mut velocity: Vec2, mut rolling: Vec2, dt: f32) -> (f32, f32) {
        let (mut travelled, mut time) = (0.0, 0.0);
        while velocity != Vec2::ZERO {
            (velocity, rolling) = carpet(velocity, rolling, &SIZE_5, dt);
            travelled += velocity.length() * dt;
            time += dt;
        }
        (travelled, time)
    }

    #[test]
    fn a_kicked_hollow_ball_starts_to_roll_at_three_fifths_of_its_speed() {
        let (mut velocity, mut rolling) = (Vec2::new(2.0, 0.0), Vec2::ZERO);
        while (velocity - rolling).length() > 1e-4 {
            (velocity, rolling) = carpet(velocity, rolling, &SIZE_5, 0.0005);
        }
        assert!((velocity.x - 1.2).abs() < 0.002, "{velocity}");
    }

    #[test]
    fn a_rolling_ball_runs_as_far_as_its_constant_deceleration_says() {
        let start = Vec2::new(0.0, 1.2);
        let (distance, time) = run(start, start, 1.0 / 240.0);
        assert!((distance - 1.2 * 1.2 / (2.0 * 0.3)).abs() < 0.01, "{distance}");
        assert!((time - 4.0).abs() < 0.03, "{time}");
    }

    #[test]
    fn backspin_slows_a_ball_more_than_no_spin() {
        let (plain, _) = run(Vec2::X, Vec2::ZERO, 1.0 / 60.0);
        let (backspin, _) = run(Vec2::X, -Vec2::X, 1.0 / 60.0);
        assert!(backspin < 0.5 * plain, "{backspin} {plain}");
    }

    #[test]
    fn the_hold_is_bounded_and_ends_at_its_reach() {
        let scoop = Scoop {
            depth: 0.05,
            half_gap: 0.08,
            jaw: 0.04,
            hold_force: 0.2,
            hold_stiffness: 40.0,
            hold_damping: 4.0,
            hold_reach: 0.05,
            hold_half_width: 0.12,
        };
        assert_eq!(scoop_hold(&scoop, 0.051, 0.0, Vec2::ZERO), Vec2::ZERO);
        assert_eq!(scoop_hold(&scoop, 0.0, 0.13, Vec2::ZERO), Vec2::ZERO);
        let weak = scoop_hold(&scoop, 0.002, 0.0, Vec2::ZERO);
        assert!((weak - Vec2::new(-0.08, 0.0)).length() < 1e-6, "{weak}");
        assert!(scoop_hold(&scoop, 0.04, 0.1, Vec2::ONE).length() <= 0.2 + 1e-6);
    }
}
