//! A goal: the whole ball has passed the goal line between the posts while it was in play.
//!
//! The ball has to cross the line in play. One that lay in the goal when play began counts nothing.

use bevy::prelude::Vec2;

use crate::geometry::Attacking;
use crate::ids::Team;
use crate::world::referee::decision::{Decision, NoGoalReason, PlacementReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rules::goalie_pushing::is_keeper_pushed_by;
use crate::world::referee::rules::observation::{Laws, Observation, ROUNDING, placed_ball};
use crate::world::referee::state::{KickOffShot, MatchState};

/// Gives the goal to the team that attacks it, and a kick-off to the other one.
///
/// The ball is taken to have rolled straight since the last sample. What is left of the sample after it crossed the line
/// is not played, and a crossing before play began or after time was up is none.
///
/// By the rules of the four-legged league a goal that was shot at the kick-off does not count, and the other team kicks
/// off as after a goal; the kick-off team's opponents may score at any time. Neither counts one while an attacker holds
/// the ball, which is then a ball that is out, or pushes the goalkeeper: then the ball goes back to where it was.
pub(super) fn goal(
    laws: &Laws,
    observation: &Observation,
    dt: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let Some(before) = state.seen_ball else { return };
    let ball = observation.ball;
    if placed_ball(decisions).is_some() {
        return;
    }
    if state.phase != Phase::Playing || !is_in_goal(laws, ball) || is_in_goal(laws, before) {
        return;
    }
    let after = dt * share_beyond(laws.pitch.length / 2.0 + laws.ball_radius, before.x.abs(), ball.x.abs());
    let played = state.played - after;
    if played < 0.0 || played > state.time_left + ROUNDING {
        return;
    }
    let end = if ball.x > 0.0 { Attacking::East } else { Attacking::West };
    let by = if state.attacking(Team::Home) == end { Team::Home } else { Team::Away };
    let at_kick_off = state.shot != KickOffShot::Over && by == state.kick_off;
    let held = laws.book.ball_holding.is_some() && observation.held_by.is_some_and(|robot| robot.team == by);
    if held && !at_kick_off {
        decisions.push(Decision::NoGoal { by, reason: NoGoalReason::Held });
        return;
    }
    if !at_kick_off && is_keeper_pushed_by(by, laws, observation, state) {
        let half = laws.pitch.half_size();
        decisions.push(Decision::NoGoal { by, reason: NoGoalReason::GoaliePushed });
        let at = if before.is_finite() { before } else { ball }.clamp(-half, half);
        decisions.push(Decision::BallPlaced { at, reason: PlacementReason::Foul });
        return;
    }
    state.kick_off = by.opponent();
    state.played = played;
    state.waited = after;
    state.phase = Phase::Initial;
    if at_kick_off {
        decisions.push(Decision::NoGoal { by, reason: NoGoalReason::KickOffShot });
        return;
    }
    state.score[by.index()] += 1;
    decisions.push(Decision::Goal { by, score: state.score });
}

/// Whether the whole ball is inside one of the goals.
fn is_in_goal(laws: &Laws, ball: Vec2) -> bool {
    ball.x.abs() > laws.pitch.length / 2.0 + laws.ball_radius && laws.pitch.holds(ball, 0.0)
}

/// The share of the way from one distance to another, 0 to 1, that lies beyond a line.
fn share_beyond(line: f32, from: f32, to: f32) -> f64 {
    if from >= line {
        return 1.0;
    }
    f64::from((to - line) / (to - from)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use crate::world::referee::rules::table::{KICK_OFF_SECONDS, Table};

    use super::*;

    #[test]
    fn a_ball_in_the_eastern_goal_is_a_goal_for_home_in_the_first_half() {
        let mut table = Table::playing(60);
        table.shoot_east();
        assert_eq!(table.state.score, [1, 0]);
        assert_eq!((table.state.phase, table.state.kick_off), (Phase::Ready, Team::Away));
        assert_eq!(table.ball, Vec2::ZERO);
        assert!(table.decisions().contains(&Decision::Goal { by: Team::Home, score: [1, 0] }));
    }

    #[test]
    fn a_ball_in_the_western_goal_is_a_goal_for_away_in_the_first_half() {
        let mut table = Table::playing(60);
        table.shoot_west();
        assert_eq!((table.state.score, table.state.kick_off), ([0, 1], Team::Home));
    }

    #[test]
    fn a_ball_on_the_line_is_no_goal() {
        let mut table = Table::playing(60);
        for x in [4.5, 4.59] {
            table.ball = Vec2::new(x, 0.3);
            table.run(0.1);
        }
        assert_eq!(table.state.score, [0, 0]);
        table.ball.x = 4.62;
        table.run(0.1);
        assert_eq!(table.state.score, [1, 0]);
    }

    #[test]
    fn a_ball_beside_or_behind_the_goal_is_no_goal() {
        let mut table = Table::playing(60);
        for at in [Vec2::new(4.7, 1.2), Vec2::new(6.0, 0.0), Vec2::new(f32::NAN, 0.0)] {
            table.ball = at;
            table.run(0.1);
            assert_eq!(table.state.score, [0, 0], "{at}");
        }
    }

    #[test]
    fn a_ball_that_lay_in_the_goal_when_play_began_counts_nothing() {
        let mut table = Table::new(60);
        table.run(3.5);
        table.ball = Vec2::new(4.7, 0.0);
        table.run(KICK_OFF_SECONDS);
        assert_eq!((table.state.phase, table.state.score), (Phase::Playing, [0, 0]));
    }

    #[test]
    fn one_ball_in_the_goal_is_one_goal_however_long_it_lies_there() {
        let mut table = Table::playing(60);
        table.obeys = false;
        table.ball = Vec2::new(-4.7, 0.0);
        table.run(KICK_OFF_SECONDS + 9.0);
        assert_eq!(table.state.phase, Phase::Playing);
        assert_eq!(table.state.score, [0, 1]);
    }

    #[test]
    fn a_goal_stops_the_clock_when_the_ball_crosses_the_line() {
        let mut table = Table::playing(10);
        let left = table.state.time_left;
        table.ball = Vec2::new(4.51, 0.0);
        table.run(0.1);
        table.ball = Vec2::new(4.71, 0.0);
        table.run(0.1);
        assert!((left - table.state.time_left - 0.15).abs() < 1e-4, "{}", left - table.state.time_left);
        table.run(KICK_OFF_SECONDS);
        assert!((left - table.state.time_left - 0.20).abs() < 1e-4, "and the next kick-off begins then");
    }

    #[test]
    fn a_ball_that_crosses_the_line_just_before_time_is_up_counts_and_just_after_does_not() {
        for (time_left, goals) in [(0.06, 1), (0.04, 0)] {
            let mut table = Table::playing(10);
            table.ball = Vec2::new(4.51, 0.0);
            table.run(0.1);
            table.state.time_left = time_left;
            table.ball = Vec2::new(4.71, 0.0);
            table.run(0.1);
            assert_eq!(table.state.score, [goals, 0], "{time_left} s left");
            assert_eq!(table.state.half, if goals == 0 { 2 } else { 1 });
        }
    }

    #[test]
    fn a_goal_with_the_last_breath_of_the_half_leads_to_one_kick_off_only() {
        let mut table = Table::playing(10);
        table.ball = Vec2::new(4.56, 0.0);
        table.run(0.1);
        table.log.clear();
        table.state.time_left = 0.05;
        table.ball = Vec2::new(4.66, 0.0);
        table.run(0.1);
        let decisions = table.decisions();
        assert!(
            matches!(decisions[..2], [Decision::Goal { .. }, Decision::HalfEnded { half: 1 }]),
            "{decisions:?}"
        );
        assert_eq!(table.times(|d| matches!(d, Decision::RobotsPlaced { .. })).len(), 1);
        assert_eq!(table.state.kick_off, Team::Away);
    }
}
