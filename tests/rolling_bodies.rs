//! Bodies in motion against closed forms: the trailer behind its drive unit, the ball, and collisions.

use bevy::ecs::system::SystemState;
use bevy::prelude::*;
use bevy_rapier2d::prelude::{RapierRigidBodyHandle, RapierRigidBodySet};
use bevy_rapier2d::rapier::dynamics::RigidBody;
use bevy_rapier2d::rapier::math::rotation_from_angle;
use touchline::game::requests::{Request, Requests};
use touchline::game::{Match, MatchPlan};
use touchline::geometry::{Pose, Twist, wrap_angle};
use touchline::ids::{RobotId, Team};
use touchline::ops;
use touchline::robot::Trailer;
use touchline::robot::pilot::Pilot;
use touchline::world::ball::Ball;
use touchline::world::referee::Phase;

use crate::support::{ball, friendly, robot};

const CYE: RobotId = RobotId::new(Team::Home, 0);
/// Hitch to trailer axle, m.
const AXLE: f32 = 0.33;
/// The Cye's top speed, m/s, and wheel track, m.
const TOP_SPEED: f32 = 0.9144;
const TRACK: f32 = 0.4127;

/// A field without near walls and one piloted robot a side, at play.
fn open_field() -> Match {
    let mut game = Match::new(&lonely_plan());
    while game.state().phase != Phase::Playing {
        game.tick();
    }
    game
}

fn lonely_plan() -> MatchPlan {
    let mut plan = friendly(1, 10.0);
    plan.pitch.length = 60.0;
    plan.pitch.width = 60.0;
    plan.pilot = Some(CYE);
    for (team, x) in plan.teams.iter_mut().zip([-10.0, -20.0]) {
        let mut strategy = (*team.strategy).clone();
        strategy.players.truncate(1);
        strategy.kick_off.ours = vec![Vec2::new(x, 0.0)];
        strategy.kick_off.theirs = vec![Vec2::new(x, 0.0)];
        team.strategy = strategy.into();
    }
    plan
}

/// Drives with these wheel speeds, m/s, for a number of ticks, and looks at robot and trailer after each.
fn drive(game: &mut Match, (left, right): (f32, f32), ticks: u32, mut look: impl FnMut(Pose, Pose)) {
    let turn_rate = (right - left) / TRACK / 150f32.to_radians();
    let pilot = Pilot { throttle: (left + right) / 2.0 / TOP_SPEED, turn: turn_rate, ..Pilot::default() };
    for _ in 0..ticks {
        game.world_mut().resource_mut::<Requests>().ask(Request::Steer { robot: CYE, pilot });
        game.tick();
        let (unit, _) = robot(game, CYE.team, CYE.number);
        look(unit, trailer(game));
    }
}

fn trailer(game: &mut Match) -> Pose {
    let mut trailers = game.world_mut().query::<(&Trailer, &Pose)>();
    let found = trailers.iter(game.world()).find(|(trailer, _)| trailer.of == CYE);
    found.map(|(_, pose)| *pose).expect("a Cye has a trailer")
}

/// Some entities' bodies, and Rapier's set of all of them.
type Bodies<'w, 's, C> = (
    Query<'w, 's, (&'static C, &'static RapierRigidBodyHandle)>,
    Query<'w, 's, &'static mut RapierRigidBodySet>,
);

/// Changes the bodies of some entities behind the simulation's back.
fn with_body<C: Component>(game: &mut Match, change: impl Fn(&C, &mut RigidBody)) {
    let mut state: SystemState<Bodies<C>> = SystemState::new(game.world_mut());
    let (found, mut sets) = state.get_mut(game.world_mut()).expect("the queries are sound");
    let mut set = sets.single_mut().expect("there is one physical world");
    for (component, handle) in &found {
        change(component, &mut set.bodies[handle.0]);
    }
}

#[test]
fn a_trailer_straightens_behind_a_straight_drive_as_the_closed_form_says() {
    let mut game = open_field();
    let start = 60f32.to_radians();
    with_body::<Trailer>(&mut game, |trailer, body| {
        if trailer.of == CYE {
            body.set_rotation(rotation_from_angle(-start), true);
        }
    });
    let from = robot(&mut game, CYE.team, CYE.number).0.position;
    let mut checked = 0;
    drive(&mut game, (0.6, 0.6), 150, |unit, trailer| {
        let distance = unit.position.distance(from);
        let hitch = wrap_angle(unit.heading - trailer.heading);
        let expected = 2.0 * ops::atan(ops::tan(start / 2.0) * ops::exp(-distance / AXLE));
        // Within 1 % of the whole change of angle.
        assert!(
            (hitch - expected).abs() < 0.01 * start,
            "{hitch} rad instead of {expected} after {distance} m"
        );
        checked += usize::from(distance > 0.3);
    });
    assert!(checked > 50);
}

#[test]
fn a_steady_circle_has_the_radius_and_the_hitch_angle_of_the_closed_form() {
    let mut game = open_field();
    drive(&mut game, (0.4, 0.6), 60 * 20, |_, _| {});
    let (mut poses, mut hitch) = (Vec::new(), 0.0);
    drive(&mut game, (0.4, 0.6), 60 * 13, |unit, trailer| {
        hitch += wrap_angle(unit.heading - trailer.heading);
        poses.push(unit);
    });
    let turned: f32 = poses.windows(2).map(|pair| wrap_angle(pair[1].heading - pair[0].heading)).sum();
    let turn_rate = turned / ((poses.len() - 1) as f32 / 60.0);
    let expected_rate = 0.2 / TRACK;
    assert!((turn_rate / expected_rate - 1.0).abs() < 0.01, "{turn_rate} rad/s instead of {expected_rate}");

    let radius = 0.5 / expected_rate;
    let round = (std::f32::consts::TAU / turn_rate * 60.0) as usize;
    let centre = poses[..round].iter().map(|pose| pose.position).sum::<Vec2>() / round as f32;
    let mean = poses[..round].iter().map(|pose| pose.position.distance(centre)).sum::<f32>() / round as f32;
    assert!((mean / radius - 1.0).abs() < 0.01, "radius {mean} m instead of {radius}");

    let (hitch, expected) = (hitch / poses.len() as f32, ops::asin(AXLE / radius));
    assert!((hitch / expected - 1.0).abs() < 0.01, "{hitch} rad instead of {expected}");
}

#[test]
fn the_drive_unit_turns_freely_under_its_trailer() {
    let mut game = open_field();
    let mut widest = 0.0f32;
    drive(&mut game, (-0.3, 0.3), 60 * 6, |unit, trailer| {
        widest = widest.max(wrap_angle(unit.heading - trailer.heading).abs());
    });
    assert!(widest > 3.0, "{widest} rad is no full turn");
}

#[test]
fn the_hitch_holds_while_the_robot_swerves() {
    let mut game = open_field();
    let mut gap = 0.0f32;
    for wheels in [(0.9, 0.2), (0.1, 0.9), (-0.5, 0.5), (-0.6, -0.6), (0.9, 0.9)] {
        drive(&mut game, wheels, 60, |unit, trailer| {
            gap = gap.max(unit.position.distance(trailer.position));
        });
    }
    assert!(gap < 0.005, "the hitch opened by {gap} m");
}

#[test]
fn a_ball_loses_its_speed_to_the_carpet_and_some_to_a_wall() {
    let mut plan = lonely_plan();
    plan.pitch = friendly(1, 1.0).pitch;
    plan.teams.iter_mut().for_each(|team| {
        let mut strategy = (*team.strategy).clone();
        strategy.kick_off.ours = vec![Vec2::new(-3.0, -2.0)];
        strategy.kick_off.theirs = vec![Vec2::new(-3.0, -2.0)];
        team.strategy = strategy.into();
    });
    let mut game = Match::new(&plan);
    while game.state().phase != Phase::Playing {
        game.tick();
    }
    with_body::<Ball>(&mut game, |_, body| body.set_linvel(Vec2::new(0.0, 3.0), true));
    let (mut before, mut bounce) = (3.0, None);
    for _ in 0..240 {
        game.tick();
        let (pose, twist) = ball(&mut game);
        assert!(plan.pitch.holds(pose.position, 0.0), "the ball left the pitch at {}", pose.position);
        if bounce.is_none() && twist.linear.y < 0.0 {
            bounce = Some(-twist.linear.y / before);
        }
        before = twist.linear.y;
    }
    let bounce = bounce.expect("the ball reaches the wall");
    assert!((bounce - plan.pitch.walls.restitution).abs() < 0.08, "{bounce}");
    let Twist { linear, .. } = ball(&mut game).1;
    assert!(linear.length() < 1.0);
}

#[test]
fn a_very_fast_ball_does_not_tunnel_through_a_wall() {
    let mut game = Match::new(&friendly(1, 1.0));
    while game.state().phase != Phase::Playing {
        game.tick();
    }
    for direction in [Vec2::X, Vec2::Y, Vec2::new(-3.0, 2.0).normalize(), Vec2::new(1.0, -1.0).normalize()] {
        with_body::<Ball>(&mut game, |_, body| body.set_linvel(direction * 40.0, true));
        for _ in 0..60 {
            game.tick();
            let (pose, _) = ball(&mut game);
            assert!(game.world().resource::<touchline::pitch::Pitch>().holds(pose.position, 0.0), "{pose:?}");
        }
    }
}

#[test]
fn a_robot_that_is_rammed_takes_over_momentum() {
    let mut plan = lonely_plan();
    let mut strategy = (*plan.teams[1].strategy).clone();
    // In the away team's own frame: right in front of the home robot.
    strategy.kick_off.ours = vec![Vec2::new(-10.0, 0.0)];
    strategy.kick_off.theirs = vec![Vec2::new(-10.0, 0.0)];
    plan.teams[1].strategy = strategy.into();
    let mut home = (*plan.teams[0].strategy).clone();
    home.kick_off.ours = vec![Vec2::new(-1.0, 0.0)];
    plan.teams[0].strategy = home.into();
    let mut game = Match::new(&plan);
    while game.state().phase != Phase::Playing {
        game.tick();
    }
    let rammed = RobotId::new(Team::Away, 0);
    with_body::<RobotId>(&mut game, |id, body| {
        if *id == rammed {
            body.set_translation(Vec2::new(1.0, 0.0), true);
        }
    });
    with_body::<Trailer>(&mut game, |trailer, body| {
        if trailer.of == rammed {
            body.set_translation(Vec2::new(1.0, 0.0), true);
        }
    });
    let mut pushed = 0.0f32;
    drive(&mut game, (TOP_SPEED, TOP_SPEED), 180, |_, _| {});
    pushed = pushed.max(robot(&mut game, Team::Away, 0).0.position.distance(Vec2::new(1.0, 0.0)));
    assert!(pushed > 0.05, "pushed by {pushed} m only");
}
