//! Handling the ball, as four-legged robots do: the chin holds it, and kicks send it away. Part of the Drive stage.

use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;
use smallvec::SmallVec;

use crate::clock::Clock;
use crate::geometry::{Pose, unit};
use crate::ids::RobotId;
use crate::pitch::BallKind;
use crate::robot::handling::{Catch, Glance, Grip, Handling, Kicking, NearBall, kicked_together, launch};
use crate::robot::pilot::Pilot;
use crate::robot::{Footing, KickIntent, Orders, Robot, RobotState};
use crate::schedule::{Tick, TickSystems};
use crate::world::ball::{Ball, Rolling};
use crate::world::body_events::{BodyEvent, BodyEvents};
use crate::world::drive::push_bodies;
use crate::world::impulses::ContactImpulses;
use crate::world::physics::Bodies;

pub(super) fn plugin(app: &mut App) {
    let systems = (let_slip, decide_handling, grant_one_catch, strike_ball, hold_ball).chain();
    let systems = systems.run_if(somebody_handles).after(push_bodies);
    app.add_systems(Tick, systems.in_set(TickSystems::Drive));
}

/// Whether the body of any robot can catch or kick.
fn somebody_handles(robots: Query<&Robot>) -> bool {
    robots.iter().any(can_handle)
}

fn can_handle(robot: &Robot) -> bool {
    robot.kind.chin.is_some() || !robot.kind.kicks.is_empty()
}

type Handler<'a> =
    (&'a RobotId, &'a Robot, &'a RapierRigidBodyHandle, &'a Pose, &'a mut Handling, &'a Footing);
type Wanting<'a> = (Handler<'a>, &'a KickIntent, Option<&'a Pilot>, &'a Orders);

/// Farther than this from a ball no robot can handle it, m.
const NEAR: f32 = 0.5;

/// Held balls slip out that others pushed hard in the last step.
fn let_slip(
    clock: Res<Clock>,
    contacts: Res<ContactImpulses>,
    mut robots: Query<(&RobotId, &Robot, &mut Handling)>,
    mut events: ResMut<BodyEvents>,
) {
    for (&id, robot, mut handling) in &mut robots {
        let Some(chin) = robot.kind.chin.filter(|_| handling.holds()) else { continue };
        let force = contacts.on_ball_without(id) / clock.dt;
        let grip = handling.grip.pushed(force, &chin, (clock.tick, clock.ticks(chin.time)));
        if grip != handling.grip {
            handling.grip = grip;
            events.0.push((id, BodyEvent::BallSlipped));
        }
    }
}

/// Begins and ends what robots do to the ball.
fn decide_handling(
    clock: Res<Clock>,
    bodies: Bodies,
    ball: Single<(&RapierRigidBodyHandle, &Pose), With<Ball>>,
    mut robots: Query<Wanting>,
    mut events: ResMut<BodyEvents>,
) {
    let (ball, ball_pose) = *ball;
    for ((&id, robot, body, pose, mut handling, footing), intent, pilot, orders) in &mut robots {
        if !can_handle(robot) {
            continue;
        }
        let handling = &mut *handling;
        if orders.state != RobotState::Playing || !robot.health.drives() || !footing.stands() {
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
            events.0.push((id, BodyEvent::KickTried));
        }
    }
}

/// Only one chin is on the ball: the best [`Catch`] keeps it, and the other heads go up again.
fn grant_one_catch(
    clock: Res<Clock>,
    ball: Single<&Pose, With<Ball>>,
    mut robots: Query<(&RobotId, &Robot, &Pose, &mut Handling)>,
    mut events: ResMut<BodyEvents>,
) {
    let mut claims: SmallVec<[_; 4]> = SmallVec::new();
    for (&id, robot, pose, handling) in &mut robots {
        let (Grip::Holding { since }, Some(chin)) = (handling.grip, robot.kind.chin) else { continue };
        let claim = Catch { since, off: pose.to_local(ball.position).distance(chin.pocket()), lot: 0.0 };
        if since == clock.tick {
            events.0.push((id, BodyEvent::BallCaught));
        }
        claims.push((claim, chin.time, handling));
    }
    if claims.len() < 2 {
        return;
    }
    for (claim, _, handling) in &mut claims {
        claim.lot = handling.dice.uniform();
    }
    claims.sort_by(|(one, ..), (other, ..)| one.order(other));
    for (_, time, handling) in &mut claims[1..] {
        handling.grip = Grip::Raising { until: clock.tick + clock.ticks(*time) };
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

/// How a kick meets the ball, if it does: a held one squarely, another one where it lies, and none with bad luck in a scrum.
fn met(robot: &Robot, ball: Option<&NearBall>, handling: &mut Handling, footing: &Footing) -> Option<Glance> {
    let Some(strike) = &robot.kind.strike else {
        return (handling.holds() || ball.is_some_and(|ball| in_reach(ball, robot))).then(Glance::default);
    };
    if footing.strain > 0.0 && handling.dice.chance(strike.bumped * footing.strain) {
        return None;
    }
    if handling.holds() {
        return Some(Glance::default());
    }
    ball.filter(|ball| in_reach(ball, robot)).and_then(|ball| strike.met(ball.at.y))
}

/// Sends the ball off where a kick meets it. Kicks that meet it in one tick have their mean: a ball between two equal ones
/// stays, whoever kicks first in the books.
fn strike_ball(
    clock: Res<Clock>,
    mut bodies: Bodies,
    kind: Res<BallKind>,
    ball: Single<(&RapierRigidBodyHandle, &Pose, &mut Rolling), With<Ball>>,
    mut robots: Query<Handler>,
    mut events: ResMut<BodyEvents>,
) {
    let (ball_handle, ball_pose, mut rolling) = ball.into_inner();
    let mut kicks: SmallVec<[(RobotId, Vec2); 4]> = SmallVec::new();
    for (&id, robot, body, pose, mut handling, footing) in &mut robots {
        let Some(kicking) = handling.kicking.filter(|kicking| kicking.strikes == clock.tick) else {
            continue;
        };
        let near = near_ball((body, pose), (ball_handle, ball_pose), &bodies);
        let glance = met(robot, near.as_ref(), &mut handling, footing);
        handling.grip = Grip::Open;
        if let Some(glance) = glance {
            let kicked = launch(&kicking.kick, glance, kind.rolling, &mut handling.dice);
            kicks.push((id, unit(pose.heading).rotate(kicked)));
            events.0.push((id, BodyEvent::KickStruck));
        } else {
            events.0.push((id, BodyEvent::KickMissed));
        }
    }
    if kicks.is_empty() {
        return;
    }
    for (&id, robot, .., mut handling, _) in &mut robots {
        let Some(chin) = robot.kind.chin.filter(|chin| handling.holds() && chin.slips_at.is_some()) else {
            continue;
        };
        handling.grip = Grip::Raising { until: clock.tick + clock.ticks(chin.time) };
        events.0.push((id, BodyEvent::BallSlipped));
    }
    // A sum of three or more depends on its order in the last bits.
    kicks.sort_unstable_by_key(|(id, _)| *id);
    let velocities: SmallVec<[Vec2; 4]> = kicks.iter().map(|(_, velocity)| *velocity).collect();
    if let (Some(velocity), Some(body)) = (kicked_together(&velocities), bodies.get_mut(ball_handle)) {
        body.set_linvel(velocity, true);
        *rolling = Rolling(velocity);
    }
}

/// Pulls the held ball into its pocket.
fn hold_ball(
    clock: Res<Clock>,
    mut bodies: Bodies,
    kind: Res<BallKind>,
    ball: Single<(&RapierRigidBodyHandle, &Pose), With<Ball>>,
    robots: Query<(&Robot, &RapierRigidBodyHandle, &Pose, &Handling)>,
) {
    let (ball_handle, ball_pose) = *ball;
    let Some((robot, body, pose, _)) = robots.iter().find(|(.., handling)| handling.holds()) else { return };
    let Some(chin) = &robot.kind.chin else { return };
    let Some(near) = near_ball((body, pose), (ball_handle, ball_pose), &bodies) else { return };
    let impulse = unit(pose.heading).rotate(chin.pull(&near, kind.mass, clock.dt)) * clock.dt;
    if let Some(ball) = bodies.get_mut(ball_handle) {
        ball.apply_impulse(impulse, false);
    }
    if let Some(body) = bodies.get_mut(body) {
        body.apply_impulse_at_point(-impulse, ball_pose.position, false);
    }
}
