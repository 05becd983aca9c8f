//! A ball that bodies press from both sides: it neither sinks into them nor gets through.

use std::collections::BTreeMap;

use bevy::prelude::*;
use touchline::game::record::TOLERANCE;
use touchline::game::requests::{Request, Requests};
use touchline::game::{Choice, Match, MatchPlan, Placed, Situation};
use touchline::geometry::Pose;
use touchline::ids::{RobotId, Team};
use touchline::robot::pilot::Pilot;

use crate::support::{assets, ball, robot};

fn four_legged(seed: u64, half_minutes: f32) -> MatchPlan {
    let file = Some("four_legged_2005".into());
    let choice = Choice { file, seed, half_minutes: Some(half_minutes), ..Choice::default() };
    MatchPlan::read(&assets(), &choice).expect("the shipped match is sound")
}

/// Two robots that look at each other along the x axis, with the ball between them and this far to the left of the axis.
fn face_to_face(match_file: &str, apart: f32, aside: f32) -> Match {
    shot_between(match_file, apart, aside, Vec2::ZERO)
}

/// The same with a ball that moves.
fn shot_between(match_file: &str, apart: f32, aside: f32, velocity: Vec2) -> Match {
    let choice = Choice { file: Some(match_file.into()), seed: 1, ..Choice::default() };
    let mut plan = MatchPlan::read(&assets(), &choice).expect("the shipped match is sound");
    let start = |x: f32, heading| Placed { pose: Pose::new(x, 0.0, heading), on: true };
    let robots = BTreeMap::from([
        (RobotId::new(Team::Home, 1), start(-apart / 2.0, 0.0)),
        (RobotId::new(Team::Away, 1), start(apart / 2.0, std::f32::consts::PI)),
    ]);
    plan.situation = Some(Situation { refereed: false, robots, ball: Vec2::new(0.0, aside), velocity });
    let mut game = Match::new(&plan);
    for team in Team::BOTH {
        game.world_mut().resource_mut::<Requests>().ask(Request::TakeOver(RobotId::new(team, 1)));
    }
    game
}

/// Both drive ahead with all that they have.
fn push(game: &mut Match) {
    for team in Team::BOTH {
        let pilot = Pilot { throttle: 1.0, ..Pilot::default() };
        let robot = RobotId::new(team, 1);
        game.world_mut().resource_mut::<Requests>().ask(Request::Steer { robot, pilot });
    }
    game.tick();
}

#[test]
fn a_ball_that_two_robots_press_between_them_does_not_sink_into_either() {
    // The blow with which two robots meet the ball may press it in for a few ticks, that of two Cyes with 40 N each for more.
    for (match_file, apart, blow) in [("four_legged_2005", 0.5, 2), ("friendly", 0.7, 12)] {
        for aside in [0.0, 0.01, 0.04, 0.08] {
            let mut game = face_to_face(match_file, apart, aside);
            (0..600).for_each(|_| push(&mut game));
            let overlap = game.record().overlap;
            let sound = overlap.body_ticks <= blow && overlap.deepest < 2.5 * TOLERANCE;
            assert!(overlap.deepest > 0.0, "{match_file}, {aside} m aside: nothing touches the ball");
            assert!(sound, "{match_file}, {aside} m aside: {overlap:?}");
            let (pose, twist) = ball(&mut game);
            assert!(pose.is_finite() && twist.linear.length() < 3.0, "{match_file}: {pose:?}, {twist:?}");
        }
    }
}

#[test]
fn a_ball_that_is_shot_at_a_robot_does_not_come_out_behind_it() {
    for match_file in ["four_legged_2005", "friendly"] {
        for (speed, aside) in [(3.0, 0.0), (10.0, 0.02), (25.0, 0.0), (50.0, 0.0), (50.0, 0.02)] {
            let mut game = shot_between(match_file, 2.0, aside, Vec2::new(-speed, 0.0));
            let case = format!("{match_file}, {speed} m/s, {aside} m aside");
            let mut ticks_after = 0;
            // Later it may come behind the robot by way of a wall.
            for _ in 0..60 {
                game.tick();
                let ((robot, _), (ball, twist)) = (robot(&mut game, Team::Home, 1), ball(&mut game));
                assert!(ball.position.x > robot.position.x, "{case}: {ball:?} is behind {robot:?}");
                ticks_after += u32::from(twist.linear.x > -0.5 * speed);
                if ticks_after == 4 {
                    break;
                }
            }
            assert_eq!(ticks_after, 4, "{case}: it does not meet the robot");
        }
    }
}

#[test]
fn the_ball_is_deeper_than_the_tolerance_for_few_ticks_of_a_match_only() {
    for seed in 1..=4 {
        let plan = four_legged(seed, 5.0);
        let mut game = Match::new(&plan);
        while !game.is_over() {
            game.tick();
        }
        let overlap = game.record().overlap;
        assert!(overlap.body_ticks <= 10 && overlap.deepest > 0.0, "seed {seed}: {overlap:?}");
    }
}
