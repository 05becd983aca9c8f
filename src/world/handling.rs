//! Handling the ball, as four-legged robots do: the chin holds it, and kicks send it away. Part of the Drive stage.

use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;
use smallvec::SmallVec;

use crate::clock::Clock;
use crate::geometry::{Pose, unit};
use crate::ids::RobotId;
use crate::pitch::BallKind;
use crate::robot::handling::{Grip, Handling, Kicking, NearBall, launch};
use crate::robot::pilot::Pilot;
use crate::robot::{KickIntent, Orders, Robot, RobotState};
use crate::schedule::{Tick, TickSystems};
use crate::world::ball::{Ball, Rolling};
use crate::world::drive::push_bodies;
use crate::world::physics::Bodies;

pub(super) fn plugin(app: &mut App) {
    let systems = (decide_handling, strike_ball, hold_ball).chain().after(push_bodies);
    app.add_systems(Tick, systems.in_set(TickSystems::Drive));
}

type Handler<'a> = (&'a RobotId, &'a Robot, &'a RapierRigidBodyHandle, &'a Pose, &'a mut Handling);
type Wanting<'a> = (Handler<'a>, &'a KickIntent, Option<&'a Pilot>, &'a Orders);

/// Farther than this from a ball no robot can handle it, m.
const NEAR: f32 = 0.5;

/// Begins and ends what robots do to the ball.
fn decide_handling(
    clock: Res<Clock>,
    bodies: Bodies,
    ball: Single<(&RapierRigidBodyHandle, &Pose), With<Ball>>,
    mut robots: Query<Wanting>,
) {
    let (ball, ball_pose) = *ball;
    for ((_, robot, body, pose, mut handling), intent, pilot, orders) in &mut robots {
        if robot.kind.chin.is_none() && robot.kind.kicks.is_empty() {
            continue;
        }
        let handling = &mut *handling;
        if orders.state != RobotState::Playing || !robot.health.drives() {
            handling.let_go();
            continue;
        }
        if handling.kicking.is_some_and(|kicking| clock.tick >= kicking.until) {
            handling.kicking = None;
        }
        let intent = pilot.map_or(*intent, |pilot| pilot.kick);
        let near = near_ball((body, pose), (ball, ball_pose), &bodies);
        if let Some(chin) = &robot.kind.chin {
            // A kick from the hold keeps the ball until it strikes.
            let wanted = match (handling.kicking, intent) {
                (Some(kicking), _) => clock.tick <= kicking.strikes,
                (None, KickIntent::Hold) => true,
                (None, KickIntent::Kick(_)) => handling.holds(),
                (None, KickIntent::Nothing) => false,
            };
            let dice = &mut handling.dice;
            let ticks = clock.ticks(chin.time);
            handling.grip =
                handling.grip.next(wanted, near.as_ref(), chin, (clock.tick, ticks), || dice.uniform());
        }
        if let KickIntent::Kick(index) = intent
            && handling.kicking.is_none()
            && let Some(kick) = robot.kind.kicks.values().nth(index)
            && if kick.from_hold { handling.holds() } else { near.is_some_and(|ball| in_reach(&ball, robot)) }
        {
            handling.kicking = Some(Kicking::begun(*kick, clock.tick, clock.ticks(kick.time)));
        }
    }
}

/// A ball is in reach of a paw up to this gap before the body, and so far beyond its sides, m.
const PAW: (f32, f32) = (0.06, 0.02);

fn in_reach(ball: &NearBall, robot: &Robot) -> bool {
    let body = &robot.kind.body;
    let gap = ball.at.x - body.length / 2.0;
    (0.0..=PAW.0 + BALL).contains(&gap) && ball.at.y.abs() <= body.width / 2.0 + PAW.1
}

/// Robots take the ball's radius to be this, m.
const BALL: f32 = 0.05;

fn near_ball(
    (body, pose): (&RapierRigidBodyHandle, &Pose),
    (ball, ball_pose): (&RapierRigidBodyHandle, &Pose),
    bodies: &Bodies,
) -> Option<NearBall> {
    if pose.position.distance(ball_pose.position) > NEAR {
        return None;
    }
    let drift = bodies.get(ball)?.linvel() - bodies.get(body)?.velocity_at_point(ball_pose.position);
    let drift = Vec2::new(drift.dot(pose.forward()), drift.dot(pose.forward().perp()));
    Some(NearBall { at: pose.to_local(ball_pose.position), drift })
}

/// Sends the ball off where a kick meets it.
fn strike_ball(
    clock: Res<Clock>,
    mut bodies: Bodies,
    kind: Res<BallKind>,
    ball: Single<(&RapierRigidBodyHandle, &Pose, &mut Rolling), With<Ball>>,
    mut robots: Query<Handler>,
) {
    let (ball_handle, ball_pose, mut rolling) = ball.into_inner();
    for (_, robot, body, pose, mut handling) in robots.iter_mut().sort::<&RobotId>() {
        let Some(kicking) = handling.kicking.filter(|kicking| kicking.strikes == clock.tick) else {
            continue;
        };
        let near = near_ball((body, pose), (ball_handle, ball_pose), &bodies);
        let held = handling.holds();
        handling.grip = Grip::Open;
        if !(held || near.is_some_and(|ball| in_reach(&ball, robot))) {
            continue;
        }
        let kicked = launch(&kicking.kick, kind.rolling, &mut handling.dice);
        let velocity = unit(pose.heading).rotate(kicked);
        if let Some(body) = bodies.get_mut(ball_handle) {
            body.set_linvel(velocity, true);
            *rolling = Rolling(velocity);
        }
    }
}

/// Pulls held balls into their pockets.
fn hold_ball(
    clock: Res<Clock>,
    mut bodies: Bodies,
    kind: Res<BallKind>,
    ball: Single<(&RapierRigidBodyHandle, &Pose), With<Ball>>,
    robots: Query<(&RobotId, &Robot, &RapierRigidBodyHandle, &Pose, &Handling)>,
) {
    let (ball_handle, ball_pose) = *ball;
    let mut holding: SmallVec<[_; 8]> = robots.iter().filter(|(.., handling)| handling.holds()).collect();
    holding.sort_unstable_by_key(|(id, ..)| **id);
    for (_, robot, body, pose, _) in holding {
        let Some(chin) = &robot.kind.chin else { continue };
        let Some(near) = near_ball((body, pose), (ball_handle, ball_pose), &bodies) else { continue };
        let impulse = unit(pose.heading).rotate(chin.pull(&near, kind.mass, clock.dt)) * clock.dt;
        if let Some(ball) = bodies.get_mut(ball_handle) {
            ball.apply_impulse(impulse, false);
        }
        if let Some(body) = bodies.get_mut(body) {
            body.apply_impulse_at_point(-impulse, ball_pose.position, false);
        }
    }
}
