//! Pushing, by the rules of the four-legged league: who drives against another robot for too long is taken off.
//!
//! The robot of each team that is nearest to the ball may push within some distance of it, a goalkeeper in its own
//! penalty area may, and a robot that stands still is never at fault. Pauses that are shorter than the push do not end
//! it.

use bevy::prelude::Vec2;

use crate::ids::RobotId;
use crate::world::referee::decision::{Decision, RemovalReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::{Pushing, RuleBook};
use crate::world::referee::rules::observation::{Laws, Observation, is_in_own_area, is_over, send_off};
use crate::world::referee::state::{MatchState, Streak, streaks_after};

/// Takes off a robot that has pushed others for too long.
pub(super) fn pushing(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let Some(rule) = &laws.book.pushing else { return };
    if state.phase != Phase::Playing {
        return;
    }
    let counts = |by: RobotId, whom: RobotId| rule.team_mates || by.team != whom.team;
    let seen = observation.on_field(state).filter(|(robot, at)| {
        let pushes = observation.shoving.iter().any(|(by, whom)| by == robot && counts(*by, *whom));
        pushes && !may_push(rule, laws, observation, state, *robot, *at)
    });
    let pushing: Vec<RobotId> = seen.map(|(robot, _)| robot).collect();
    state.pushes = streaks_after(&state.pushes, state.played, &pushing);
    let too_long = |(robot, streak): &(RobotId, Streak)| {
        pushing.contains(robot) && is_over(streak.seconds, rule.seconds)
    };
    let guilty: Vec<_> = state.pushes.iter().copied().filter(too_long).collect();
    for (robot, streak) in guilty {
        let beyond = (streak.seconds - f64::from(rule.seconds)).clamp(0.0, state.played);
        let away = f64::from(laws.book.removal_seconds) - beyond;
        send_off(state, decisions, robot, away, RemovalReason::Pushing);
    }
}

fn may_push(
    rule: &Pushing,
    laws: &Laws,
    observation: &Observation,
    state: &MatchState,
    robot: RobotId,
    at: Vec2,
) -> bool {
    let ball = observation.ball;
    let nearest = observation.nearest(state, ball, |other| other.team == robot.team);
    let at_the_ball =
        at.distance(ball) <= rule.exempt_radius && nearest.is_some_and(|(other, _)| other == robot);
    let keeps = robot.number == RuleBook::KEEPER && is_in_own_area(laws, state, robot, at);
    at_the_ball || keeps || observation.still.contains(&robot)
}

#[cfg(test)]
mod tests {
    use crate::geometry::Attacking;
    use crate::ids::Team;
    use crate::world::referee::rules::table::Table;

    use super::*;

    const HOME_0: RobotId = RobotId::new(Team::Home, 0);
    const HOME_1: RobotId = RobotId::new(Team::Home, 1);
    const HOME_2: RobotId = RobotId::new(Team::Home, 2);
    const AWAY_1: RobotId = RobotId::new(Team::Away, 1);

    fn removals(table: &Table) -> Vec<RobotId> {
        table.removals(RemovalReason::Pushing)
    }

    /// A match in which home 1 has begun to push away 1 in the last sample, far from the ball.
    fn pushing(hertz: u32) -> Table {
        let mut table = Table::four_legged_playing(hertz);
        table.put(HOME_1, Vec2::new(0.0, -1.0));
        table.put(AWAY_1, Vec2::new(0.3, -1.0));
        table.ball = Vec2::new(0.0, 1.0);
        table.shoving = vec![(HOME_1, AWAY_1)];
        table.run(1.0 / f64::from(hertz));
        table
    }

    #[test]
    fn whoever_pushes_for_three_seconds_leaves_and_whoever_is_pushed_stays() {
        for hertz in [20, 60, 240] {
            let sample = 1.0 / f64::from(hertz);
            let mut table = pushing(hertz);
            table.run(3.0 - sample);
            assert_eq!(removals(&table), []);
            table.run(sample);
            assert_eq!(removals(&table), [HOME_1]);
            assert!((table.state.removed[0].seconds_left - 30.0).abs() < 1e-5);
        }
    }

    #[test]
    fn two_that_charge_into_each_other_both_leave() {
        let mut table = pushing(60);
        table.shoving = vec![(AWAY_1, HOME_1), (HOME_1, AWAY_1)];
        table.run(3.1);
        assert_eq!(removals(&table), [HOME_1, AWAY_1]);
    }

    #[test]
    fn bodies_that_part_for_moments_still_push() {
        let mut table = pushing(60);
        for sample in 0..200_u16 {
            table.shoving = if sample % 3 == 0 { vec![(HOME_1, AWAY_1)] } else { vec![] };
            table.run(1.0 / 60.0);
        }
        assert_eq!(removals(&table), [HOME_1]);
    }

    #[test]
    fn a_pause_as_long_as_the_push_ends_it() {
        let mut table = pushing(60);
        for _ in 0..3 {
            table.shoving = vec![(HOME_1, AWAY_1)];
            table.run(2.0);
            table.shoving.clear();
            table.run(2.1);
        }
        assert_eq!(removals(&table), []);
    }

    #[test]
    fn the_robot_nearest_to_the_ball_may_push_within_half_a_metre() {
        for (ball, removed) in [(-0.55, vec![]), (-0.45, vec![HOME_1])] {
            let mut table = pushing(60);
            table.ball = Vec2::new(0.0, ball);
            table.run(5.0);
            assert_eq!(removals(&table), removed, "ball at {ball}");
        }
    }

    #[test]
    fn the_second_nearest_of_a_team_may_not_push() {
        let mut table = pushing(60);
        table.ball = Vec2::new(0.0, -0.7);
        table.put(HOME_2, Vec2::new(0.0, -0.5));
        table.run(5.0);
        assert_eq!(removals(&table), [HOME_1]);
    }

    #[test]
    fn a_robot_that_stands_still_and_a_keeper_in_its_area_are_not_at_fault() {
        let mut table = pushing(60);
        table.still = vec![HOME_1];
        table.run(5.0);
        assert_eq!(removals(&table), []);
        for (ends, removed) in [(Attacking::East, vec![]), (Attacking::West, vec![HOME_0])] {
            let mut table = pushing(60);
            table.state.home_attacks = ends;
            table.put(HOME_0, Vec2::new(-2.3, 0.0));
            table.shoving = vec![(HOME_0, AWAY_1)];
            table.run(5.0);
            assert_eq!(removals(&table), removed);
        }
    }

    #[test]
    fn pushing_a_team_mate_counts_too_unless_the_book_says_otherwise() {
        for (team_mates, removed) in [(true, vec![HOME_1]), (false, vec![])] {
            let mut table = pushing(60);
            table.book.pushing.as_mut().expect("it has the rule").team_mates = team_mates;
            table.shoving = vec![(HOME_1, HOME_2)];
            table.run(5.0);
            assert_eq!(removals(&table), removed);
        }
    }

    #[test]
    fn a_kick_off_starts_the_time_anew() {
        let mut table = pushing(60);
        table.run(2.5);
        table.restart_in_play();
        table.run(2.9);
        assert_eq!(removals(&table), []);
    }
}
