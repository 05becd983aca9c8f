//! Whole matches from the first whistle to the last, and the same match watched at different rates.

use bevy::prelude::Vec2;

use super::RULES;
use super::table::four_legged_line_up;
use super::table::{KICK_OFF_SECONDS, Table};
use crate::geometry::Attacking;
use crate::ids::{RobotId, Team};
use crate::world::referee::decision::{Decision, NoGoalReason, PlacementReason, RemovalReason};
use crate::world::referee::phase::Phase;

#[test]
fn a_match_with_goals_in_both_halves_is_scored_for_the_right_teams() {
    let mut table = Table::new(60);
    table.book.half_minutes = 0.5;
    table.restart(Team::Away);
    table.run(KICK_OFF_SECONDS + 2.0);

    table.shoot_east();
    assert_eq!((table.state.score_of(Team::Home), table.state.kick_off), (1, Team::Away));
    table.run(KICK_OFF_SECONDS + 2.0);
    table.shoot_west();
    assert_eq!((table.state.score, table.state.kick_off), ([1, 1], Team::Home));

    while table.state.half == 1 {
        table.run(0.1);
    }
    assert_eq!((table.state.phase, table.state.kick_off), (Phase::Ready, Team::Home));
    assert_eq!(table.state.attacking(Team::Home), Attacking::West);
    table.run(KICK_OFF_SECONDS + 2.0);

    table.shoot_east();
    assert_eq!((table.state.score, table.state.kick_off), ([1, 2], Team::Home), "away attacks east now");
    table.run(KICK_OFF_SECONDS + 2.0);
    table.shoot_west();
    assert_eq!((table.state.score, table.state.kick_off), ([2, 2], Team::Away));

    table.run(120.0);
    assert_eq!((table.state.phase, table.state.half, table.state.score), (Phase::Finished, 2, [2, 2]));
    assert!(table.decisions().ends_with(&[Decision::MatchFinished { score: [2, 2] }]));
    let halves = table.times(|d| matches!(d, Decision::HalfEnded { .. }));
    let kick_offs = table.times(|d| matches!(d, Decision::RobotsPlaced { .. }));
    assert_eq!((halves.len(), kick_offs.len()), (2, 6));
}

#[test]
fn a_match_lasts_its_playing_time_and_its_kick_offs() {
    let mut table = Table::new(60);
    table.book.half_minutes = 0.25;
    table.restart(Team::Home);
    table.run(KICK_OFF_SECONDS + 5.0);
    table.shoot_east();
    table.run(60.0);
    let end = table.times(|d| matches!(d, Decision::MatchFinished { .. }))[0];
    let expected = 2.0 * 15.0 + 3.0 * KICK_OFF_SECONDS;
    assert!((end - expected).abs() < 1.0 / 60.0 + 1e-6, "{end} instead of {expected} s");
}

#[test]
fn a_removal_outlasts_half_time() {
    let mut table = Table::new(60);
    table.book.half_minutes = 0.25;
    table.restart(Team::Home);
    table.run(KICK_OFF_SECONDS);
    table.put(RobotId::new(Team::Home, 0), Vec2::new(-4.0, 0.5));
    table.put(RobotId::new(Team::Home, 1), Vec2::new(-4.0, -0.5));
    table.run(15.1);
    assert_eq!((table.state.half, table.state.removed.len()), (2, 1));
    assert!(
        (table.state.removed[0].seconds_left - 25.0).abs() < 0.05,
        "{}",
        table.state.removed[0].seconds_left
    );
    table.run(60.0);
    assert_eq!((table.state.phase, table.state.removed.len()), (Phase::Finished, 1));
}

#[test]
fn every_rule_has_a_name_of_its_own() {
    let mut names: Vec<_> = RULES.iter().map(|rule| rule.name).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), RULES.len());
}

/// How the ball rolls in the match that is watched at several rates: from, to (seconds), velocity (m/s).
const ROLLS: &[(f64, f64, Vec2)] = &[
    (5.0, 9.7, Vec2::new(1.0, 0.05)),     // into the eastern goal at 9.61 s
    (14.0, 16.0, Vec2::new(0.37, -0.41)), // stops 0.05 m beyond an anchor's reach: stuck
    (30.0, 34.0, Vec2::new(-0.8, 0.9)),
    (58.0, 62.5, Vec2::new(-0.9, -0.1)),
];

/// A match over 100 s in which everything happens once or more, and its log.
fn watched(hertz: u32) -> Vec<(f64, Decision)> {
    let mut table = Table::new(hertz);
    table.book.half_minutes = 1.0;
    table.restart(Team::Home);
    let dt = 1.0 / f64::from(hertz);
    for sample in 1..=100 * hertz {
        let time = f64::from(sample) * dt;
        let middle = time - dt / 2.0;
        if let Some((_, _, velocity)) = ROLLS.iter().find(|(from, to, _)| (*from..*to).contains(&middle)) {
            table.ball += *velocity * dt as f32;
        }
        // Home 2 guards the goal from 16.0 s on, and home 3 drives into its area at 17.23 s.
        if (16.0..30.0).contains(&middle) {
            table.put(RobotId::new(Team::Home, 2), Vec2::new(-4.2, 0.4));
            let third = RobotId::new(Team::Home, 3);
            if !table.state.is_removed(third) {
                table.put(third, Vec2::new((-2.27 - (time - 16.0) as f32).max(-4.2), -0.4));
            }
        }
        table.look(dt);
    }
    table.log
}

#[test]
fn a_match_goes_the_same_way_at_every_step_size() {
    let fine = watched(240);
    let kinds = [
        fine.iter().any(|(_, d)| matches!(d, Decision::Goal { .. })),
        fine.iter()
            .any(|(_, d)| matches!(d, Decision::BallPlaced { reason: PlacementReason::NoProgress, .. })),
        fine.iter().any(|(_, d)| matches!(d, Decision::RobotRemoved { .. })),
        fine.iter().any(|(_, d)| matches!(d, Decision::RobotReturned { .. })),
        fine.iter().any(|(_, d)| matches!(d, Decision::HalfEnded { .. })),
    ];
    assert_eq!(kinds, [true; 5], "the match shows all decisions: {fine:#?}");
    for hertz in [20, 60] {
        let coarse = watched(hertz);
        let names = |log: &[(f64, Decision)]| log.iter().map(|(_, d)| d.to_string()).collect::<Vec<_>>();
        assert_eq!(names(&coarse), names(&fine), "at {hertz} Hz");
        for ((late, decision), (time, _)) in coarse.iter().zip(&fine) {
            let sample = 1.0 / f64::from(hertz);
            assert!((late - time).abs() < sample + 1e-6, "{decision} at {late} s for {time} s, {hertz} Hz");
        }
    }
}

/// A four-legged match in which everything happens once or more, and its log. What happens is timed by the clock on the
/// wall.
fn four_legged_watched(hertz: u32) -> Vec<(f64, Decision)> {
    let [keeper, pusher, holder, stray] = [0, 1, 2, 3].map(|number| RobotId::new(Team::Home, number));
    let [other_keeper, pushed, guest, _] = [0, 1, 2, 3].map(|number| RobotId::new(Team::Away, number));
    let mut table = Table::four_legged(hertz);
    table.book.half_minutes = 3.0;
    table.restart(Team::Home);
    let dt = 1.0 / f64::from(hertz);
    for sample in 1..=420 * hertz {
        let time = f64::from(sample) * dt;
        let middle = time - dt / 2.0;
        let between = |from: f64, to: f64| (from..to).contains(&middle);
        let begins = |at: f64| (at..at + dt).contains(&time);
        if begins(10.0) {
            let all = four_legged_line_up();
            all.into_iter().for_each(|(robot, at)| table.put(robot, at));
        }
        table.still =
            if between(0.0, 12.0) { table.robots.iter().map(|(robot, _)| *robot).collect() } else { vec![] };
        // 10 s: all have walked to their places, so that play begins at about 12 s. Home shoots from the circle into the
        // goal.
        if between(14.0, 15.5) {
            table.ball.x += 2.0 * dt as f32;
        }
        // About 46.4 s: away's kick-off after the walking time. Away plays the ball out over the side line.
        table.touching = match middle {
            t if (13.9..14.0).contains(&t) => vec![pusher],
            t if (50.0..50.5).contains(&t) => vec![guest],
            t if (60.0..125.0).contains(&t) => vec![stray],
            _ => vec![],
        };
        if between(50.0, 51.3) {
            table.ball.y += 1.7 * dt as f32;
        }
        // 60 s: a scrum, and what else is forbidden meanwhile.
        table.shoving = if between(60.0, 64.0) && !table.state.is_removed(pusher) {
            vec![(pusher, pushed)]
        } else {
            vec![]
        };
        table.held_by = (between(66.0, 70.0) && !table.state.is_removed(holder)).then_some(holder);
        if begins(72.0) {
            table.put(other_keeper, Vec2::new(1.0, 0.0));
            table.put(guest, Vec2::new(2.3, 0.3));
            table.put(keeper, Vec2::new(-2.3, 2.4));
        }
        // The keeper, nearest to the ball so far, goes home: at the centre the ball is stuck again, and now a robot leaves.
        if begins(95.0) {
            table.put(other_keeper, Vec2::new(2.4, 0.0));
        }
        table.look(dt);
    }
    table.log
}

#[test]
fn a_four_legged_match_goes_the_same_way_at_every_step_size() {
    let fine = four_legged_watched(240);
    let shown = |asked: &dyn Fn(&Decision) -> bool| fine.iter().any(|(_, decision)| asked(decision));
    for reason in [
        RemovalReason::IllegalDefender,
        RemovalReason::BallHolding,
        RemovalReason::Pushing,
        RemovalReason::LeftTheField,
        RemovalReason::LocalStuck,
    ] {
        assert!(
            shown(&|d| matches!(d, Decision::RobotRemoved { reason: r, .. } if *r == reason)),
            "{reason:?}"
        );
    }
    assert!(shown(&|d| matches!(d, Decision::NoGoal { reason: NoGoalReason::KickOffShot, .. })));
    assert!(shown(&|d| matches!(d, Decision::BallPlaced { reason: PlacementReason::ThrowIn { .. }, .. })));
    assert!(shown(&|d| matches!(d, Decision::Untouched { .. })));
    assert!(shown(&|d| matches!(d, Decision::RobotReturned { .. })));
    assert!(shown(&|d| matches!(d, Decision::RobotPlaced { .. })));
    assert!(shown(&|d| matches!(d, Decision::HalfEnded { .. })));
    for hertz in [20, 60] {
        let coarse = four_legged_watched(hertz);
        let names = |log: &[(f64, Decision)]| log.iter().map(|(_, d)| d.to_string()).collect::<Vec<_>>();
        assert_eq!(names(&coarse), names(&fine), "at {hertz} Hz");
        for ((late, decision), (time, _)) in coarse.iter().zip(&fine) {
            let samples = 4.0 / f64::from(hertz);
            assert!((late - time).abs() < samples, "{decision} at {late} s for {time} s, {hertz} Hz");
        }
    }
}
