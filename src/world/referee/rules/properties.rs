//! What holds in every match, however ball, robots and samples behave.

use bevy::prelude::Vec2;
use proptest::prelude::*;

use super::referee;
use super::table::{BALL_RADIUS, pitch};
use super::table::{four_legged_book, four_legged_pitch};
use crate::geometry::Attacking;
use crate::ids::{RobotId, Team};
use crate::world::referee::decision::Decision;
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::RuleBook;
use crate::world::referee::rules::observation::{Laws, Observation};
use crate::world::referee::state::MatchState;

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
    let [home, away] = state.score;
    let mercy = book.mercy.is_some_and(|lead| home.abs_diff(away) >= lead);
    assert_eq!(state.phase == Phase::Finished, state.time_left == 0.0 || mercy);
    assert_eq!(state.home_attacks == Attacking::East, state.half == 1);
    assert!(state.removed.is_sorted_by(|a, b| a.robot < b.robot));
    assert!(state.removed.iter().all(|r| (0.0..=f64::from(book.removal_seconds)).contains(&r.seconds_left)));
    assert!(state.defenders.is_sorted_by(|a, b| a.robot < b.robot));
    assert!(state.defenders.iter().all(|d| !state.is_removed(d.robot)));
    assert!(state.played.is_finite() && state.waited.is_finite() && state.untouched.is_finite());
    for streaks in [&state.pushes, &state.on_keeper, &state.charges] {
        assert!(streaks.iter().all(|(robot, _)| !state.is_removed(*robot)));
        assert!(streaks.is_sorted_by(|(a, _), (b, _)| a < b));
    }
    assert!(state.pushed.iter().all(|(robot, ago)| !state.is_removed(*robot) && ago.is_finite()));
    assert!(state.hold.is_none_or(|hold| !state.is_removed(hold.robot)));
    assert!(state.pushes.is_sorted_by(|(a, _), (b, _)| a < b));
    let streaks =
        state.pushes.iter().map(|(_, streak)| streak).chain(state.hold.iter().map(|hold| &hold.streak));
    assert!(streaks.into_iter().all(|streak| streak.seconds.is_finite() && streak.paused.is_finite()));
}

/// What happens around a ball in a four-legged match, whichever of its rules hold: who touches and who holds it, who
/// pushes whom and who stands still, as places in the list of robots.
type Scene = (Sample, Vec<usize>, Option<usize>, Vec<(usize, usize)>, Vec<usize>);

fn scene() -> impl Strategy<Value = Scene> {
    let some = || prop::collection::vec(0..8_usize, 0..4);
    let pushes = prop::collection::vec((0..8_usize, 0..8_usize), 0..4);
    (sample(), some(), prop::option::of(0..8_usize), pushes, some()).prop_map(
        |((ball, robots, dt), touching, held_by, pushes, still)| {
            // The field is smaller, and now and then something is outside of it.
            let scaled = |at: Vec2| at * Vec2::new(0.65, 0.9);
            let robots = robots.into_iter().map(|(robot, at)| (robot, scaled(at))).collect();
            ((scaled(ball), robots, dt), touching, held_by, pushes, still)
        },
    )
}

proptest! {
    #[test]
    fn no_history_breaks_a_four_legged_match(
        scenes in prop::collection::vec(scene(), 1..120),
        stays in 1..8_usize,
        [outlasts, carried, walls, spots, second, half_way] in any::<[bool; 6]>(),
    ) {
        let pitch = four_legged_pitch();
        let book = RuleBook {
            half_minutes: 2.0,
            ready_seconds: 4.0,
            removal_seconds: 5.0,
            mercy: Some(2),
            removal_outlasts_play: outlasts,
            ..four_legged_book()
        };
        let middle_size = RuleBook::default();
        let book = RuleBook {
            kick_off: if carried { middle_size.kick_off } else { book.kick_off },
            out: if walls { middle_size.out } else { book.out },
            stuck: if spots { middle_size.stuck } else { book.stuck },
            defenders: if second { middle_size.defenders } else { book.defenders },
            returns: if half_way { book.returns } else { middle_size.returns },
            ..book
        };
        let laws = Laws { pitch: &pitch, book: &book, ball_radius: 0.045 };
        let is_out = |ball: Vec2| !walls && ball.is_finite() && !ball.abs().cmple(pitch.half_size() + 0.045).all();
        let mut state = MatchState::new(Team::Home, &book);
        let mut score = [0, 0];
        for ((ball, robots, dt), touching, held_by, pushes, still) in
            scenes.iter().flat_map(|scene| std::iter::repeat_n(scene, stays))
        {
            let mut seen = robots.clone();
            seen.retain(|(robot, _)| !state.is_removed(*robot));
            let id = |place: &usize| seen.get(*place).map(|(robot, _)| *robot);
            let touching: Vec<RobotId> = touching.iter().filter_map(id).collect();
            let still: Vec<RobotId> = still.iter().filter_map(id).collect();
            let shoving: Vec<_> = pushes.iter().filter_map(|(a, b)| Some((id(a)?, id(b)?))).collect();
            let held_by = held_by.as_ref().and_then(id);
            let observation =
                Observation {
                    ball: *ball,
                    robots: &seen,
                    touching: &touching,
                    held_by,
                    contacts: &shoving,
                    shoving: &shoving,
                    still: &still,
                };
            let before = state.clone();
            let mut decisions = Vec::new();
            referee(&laws, &observation, *dt, &mut state, &mut decisions);
            is_consistent(&state, &book);

            let count = |asked: &dyn Fn(&Decision) -> bool| decisions.iter().filter(|d| asked(d)).count();
            let (mut removed, mut returned) = (Vec::new(), Vec::new());
            for decision in &decisions {
                match decision {
                    Decision::Goal { by, score: now } => {
                        score[by.index()] += 1;
                        prop_assert_eq!(*now, score, "a score only grows, by one");
                    }
                    Decision::BallPlaced { at, .. } => {
                        prop_assert!(at.abs().cmple(pitch.half_size()).all(), "to {at}");
                    }
                    Decision::RobotRemoved { robot, .. } => {
                        prop_assert!(seen.iter().any(|(other, _)| other == robot));
                        removed.push(*robot);
                    }
                    Decision::RobotReturned { robot, at } => {
                        prop_assert!(before.is_removed(*robot) || removed.contains(robot));
                        prop_assert!(at.is_finite() && pitch.holds(at.position, 0.0));
                        returned.push(*robot);
                    }
                    Decision::RobotPlaced { robot, at } => {
                        prop_assert!(at.is_finite() && pitch.holds(at.position, 0.0));
                        prop_assert!(!state.is_removed(*robot) && !returned.contains(robot), "{robot} is there");
                    }
                    _ => {}
                }
            }
            for list in [&removed, &returned] {
                prop_assert!(list.iter().all(|robot| list.iter().filter(|other| *other == robot).count() == 1));
            }
            let was_off = before.removed.iter().map(|removal| removal.robot).chain(removed.iter().copied());
            let is_off: Vec<RobotId> = state.removed.iter().map(|removal| removal.robot).collect();
            let mut still_off: Vec<RobotId> = was_off.filter(|robot| !returned.contains(robot)).collect();
            still_off.sort_unstable();
            prop_assert_eq!(is_off, still_off, "off are those that were removed and have not returned");
            let ends = count(&|decision| matches!(decision, Decision::MatchFinished { .. }));
            prop_assert!(ends <= 1);
            if before.phase == Phase::Playing && state.phase == Phase::Playing && is_out(*ball) {
                let seen_ball = state.seen_ball.unwrap_or(*ball);
                prop_assert!(!is_out(seen_ball), "a ball that is out comes back in the same sample");
            }
            prop_assert_eq!(state.score, score);
            if before.phase == Phase::Finished {
                prop_assert!(decisions.is_empty() && state.phase == Phase::Finished);
            }
        }
    }
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
            let observation = Observation::of(*ball, &seen);
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
                    Decision::BallPlaced { at, .. } => {
                        let near = |spot: &Vec2| spot.distance(*at) <= 2.0 * book.spot_clearance + 1e-3;
                        prop_assert!(pitch.penalty_spots.iter().any(near), "at {at}");
                    }
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
