//! What holds in every match, however ball, robots and samples behave.

use bevy::prelude::Vec2;
use proptest::prelude::*;

use super::table::{BALL_RADIUS, pitch};
use super::{Laws, Observation, referee};
use crate::geometry::Attacking;
use crate::ids::{RobotId, Team};
use crate::referee::decision::Decision;
use crate::referee::rulebook::RuleBook;
use crate::referee::state::{MatchState, Phase};

/// One sample: the ball, the robots and the seconds since the last one.
type Sample = (Vec2, Vec<(RobotId, Vec2)>, f64);

fn point() -> impl Strategy<Value = Vec2> {
    prop_oneof![
        4 => (-4.5_f32..4.5, -2.5_f32..2.5).prop_map(|(x, y)| Vec2::new(x, y)),
        2 => (4.4_f32..4.9, -1.2_f32..1.2, any::<bool>()).prop_map(|(x, y, west)| {
            Vec2::new(if west { -x } else { x }, y)
        }),
        2 => (3.4_f32..4.5, -1.6_f32..1.6, any::<bool>()).prop_map(|(x, y, west)| {
            Vec2::new(if west { -x } else { x }, y)
        }),
        1 => (any::<f32>(), any::<f32>()).prop_map(|(x, y)| Vec2::new(x, y)),
    ]
}

fn sample() -> impl Strategy<Value = Sample> {
    let robots = prop::collection::btree_map((any::<bool>(), 0..4_u8), point(), 0..8);
    let dt = prop_oneof![8 => 0.0..0.5_f64, 4 => 0.5..12.0_f64, 1 => any::<f64>()];
    (point(), robots, dt).prop_map(|(ball, robots, dt)| {
        let id = |(away, number)| RobotId::new(if away { Team::Away } else { Team::Home }, number);
        (ball, robots.into_iter().map(|(key, at)| (id(key), at)).collect(), dt)
    })
}

fn is_consistent(state: &MatchState, book: &RuleBook) {
    assert!((0.0..=book.half_seconds()).contains(&state.time_left), "{} s left", state.time_left);
    assert!((1..=RuleBook::HALVES).contains(&state.half));
    assert_ne!(state.phase, Phase::Initial, "a kick-off is taken at once");
    assert_eq!(state.phase == Phase::Finished, state.time_left == 0.0);
    assert_eq!(state.home_attacks == Attacking::East, state.half == 1);
    assert!(state.removed.is_sorted_by(|a, b| a.robot < b.robot));
    assert!(state.removed.iter().all(|r| (0.0..=f64::from(book.removal_seconds)).contains(&r.seconds_left)));
    assert!(state.defenders.is_sorted_by(|a, b| a.robot < b.robot));
    assert!(state.defenders.iter().all(|d| !state.is_removed(d.robot)));
    assert!(state.played.is_finite() && state.waited.is_finite());
}

proptest! {
    #[test]
    fn no_history_breaks_a_match(samples in prop::collection::vec(sample(), 1..120), stays in 1..8_usize) {
        let pitch = pitch();
        let book = RuleBook { half_minutes: 2.0, second_defender_seconds: 3.0, removal_seconds: 5.0, ..RuleBook::default() };
        let laws = Laws { pitch: &pitch, book: &book, ball_radius: BALL_RADIUS };
        let mut state = MatchState::new(Team::Home, &book);
        let (mut goals, mut may_score) = ([0, 0], false);
        // Every scene is seen some times over, so that clocks have a chance to run out.
        for (ball, robots, dt) in samples.iter().flat_map(|sample| std::iter::repeat_n(sample, stays)) {
            let mut seen = robots.clone();
            seen.retain(|(robot, _)| !state.is_removed(*robot));
            let before = state.clone();
            let mut decisions = Vec::new();
            let observation = Observation { ball: *ball, robots: &seen };
            referee(&laws, &observation, *dt, &mut state, &mut decisions);
            is_consistent(&state, &book);
            for decision in &decisions {
                match decision {
                    Decision::PhaseChanged(phase) => may_score = *phase == Phase::Playing,
                    Decision::Goal { by, score } => {
                        prop_assert!(std::mem::take(&mut may_score), "two goals in one phase of play");
                        goals[by.index()] += 1;
                        prop_assert_eq!(*score, goals);
                    }
                    Decision::BallPlaced { at, .. } => prop_assert!(pitch.penalty_spots.contains(at)),
                    Decision::RobotReturned { robot, at } => {
                        prop_assert!(before.is_removed(*robot) && pitch.holds(at.position, 0.0));
                        prop_assert!(state.attacking(robot.team).turn(at.position).x < 0.0, "in its own half");
                    }
                    Decision::RobotRemoved { robot, .. } => {
                        let left = |(other, _): &(RobotId, Vec2)| other.team == robot.team && !state.is_removed(*other);
                        prop_assert!(seen.iter().any(left), "{robot} was the last of its team");
                    }
                    _ => {}
                }
            }
            prop_assert_eq!(state.score, goals);
            if before.phase == Phase::Finished {
                prop_assert!(decisions.is_empty() && state.phase == Phase::Finished);
            }
        }
    }
}
