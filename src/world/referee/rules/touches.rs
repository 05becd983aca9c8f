//! Who touches the ball: what other rules ask about the past of the ball, kept in one place.

use crate::ids::Team;
use crate::world::referee::decision::Decision;
use crate::world::referee::phase::Phase;
use crate::world::referee::rules::observation::{Laws, Observation};
use crate::world::referee::state::{KickOffShot, MatchState};

/// Keeps the last touch, the time since, and whether the shot of the kick-off is over. It is over when a robot of the
/// team that kicked off touches the ball after the whole ball has left the centre circle.
pub(super) fn touches(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    _: &mut Vec<Decision>,
) {
    if state.phase != Phase::Playing {
        return;
    }
    let touches = |team: Team| {
        let touches = observation.nearest(state, observation.ball, |robot| {
            let holds = observation.held_by == Some(robot);
            robot.team == team && (holds || observation.touching.contains(&robot))
        });
        touches.map(|(robot, _)| robot)
    };
    let [home, away] = Team::BOTH.map(touches);
    let by_kick_off_team = [home, away][state.kick_off.index()].is_some();
    state.untouched += state.played;
    if home.is_some() || away.is_some() {
        state.untouched = 0.0;
        state.last_touch = home.xor(away);
    }
    let outside = observation.ball.length() > laws.pitch.centre_circle_radius + laws.ball_radius;
    if state.shot == KickOffShot::InCircle && outside {
        state.shot = KickOffShot::Left;
    }
    if state.shot == KickOffShot::Left && by_kick_off_team {
        state.shot = KickOffShot::Over;
    }
}

#[cfg(test)]
mod tests {
    use bevy::prelude::Vec2;

    use crate::ids::RobotId;
    use crate::world::referee::decision::NoGoalReason;
    use crate::world::referee::rules::table::Table;

    use super::*;

    const HOME_1: RobotId = RobotId::new(Team::Home, 1);
    const AWAY_2: RobotId = RobotId::new(Team::Away, 2);

    const VOID: Decision = Decision::NoGoal { by: Team::Home, reason: NoGoalReason::KickOffShot };

    #[test]
    fn the_last_touch_is_kept_and_nobody_knows_it_where_both_teams_touch() {
        let mut table = Table::four_legged_playing(60);
        assert_eq!(table.state.last_touch, None);
        table.touching = vec![HOME_1];
        table.run(0.1);
        table.touching.clear();
        table.run(0.1);
        assert_eq!(table.state.last_touch, Some(HOME_1));
        table.touching = vec![AWAY_2, HOME_1];
        table.run(0.1);
        assert_eq!(table.state.last_touch, None);
        table.touching = vec![AWAY_2];
        table.run(0.1);
        assert_eq!(table.state.last_touch, Some(AWAY_2));
        table.touching.clear();
        table.held_by = Some(HOME_1);
        table.run(0.1);
        assert_eq!(table.state.last_touch, Some(HOME_1), "whoever holds it touches it");
        table.held_by = None;
        table.restart_in_play();
        assert_eq!(table.state.last_touch, None);
    }

    #[test]
    fn a_shot_from_the_kick_off_does_not_count_and_the_others_kick_off() {
        for hertz in [20, 60, 240] {
            let mut table = Table::four_legged_playing(hertz);
            table.touching = vec![HOME_1];
            table.run(0.5);
            table.touching.clear();
            table.shoot_east();
            assert_eq!((table.state.score, table.state.kick_off), ([0, 0], Team::Away));
            assert_eq!((table.state.phase, table.ball), (Phase::Ready, Vec2::ZERO));
            assert!(table.decisions().contains(&VOID));
        }
    }

    #[test]
    fn a_shot_from_the_kick_off_that_an_opponent_deflects_does_not_count_either() {
        let mut table = Table::four_legged_playing(60);
        table.ball = Vec2::new(1.5, 0.0);
        table.touching = vec![AWAY_2];
        table.run(0.5);
        table.touching.clear();
        table.shoot_east();
        assert!(table.decisions().contains(&VOID));
    }

    #[test]
    fn a_goal_counts_after_the_team_touched_the_ball_outside_the_circle() {
        let mut table = Table::four_legged_playing(60);
        table.ball = Vec2::new(0.23, 0.0);
        table.run(0.1);
        table.touching = vec![HOME_1];
        table.run(0.1);
        table.touching.clear();
        table.shoot_east();
        assert_eq!(table.state.score, [1, 0]);
    }

    #[test]
    fn a_touch_while_the_ball_is_over_the_circle_is_still_the_kick_off() {
        let mut table = Table::four_legged_playing(60);
        table.ball = Vec2::new(0.22, 0.0);
        table.touching = vec![HOME_1];
        table.run(0.1);
        table.touching.clear();
        table.shoot_east();
        assert_eq!(table.state.score, [0, 0]);
    }

    #[test]
    fn the_team_that_did_not_kick_off_may_score_at_once_in_both_halves() {
        let mut table = Table::four_legged_playing(60);
        table.shoot_west();
        assert_eq!(table.state.score, [0, 1]);
        let mut table = Table::four_legged_playing(60);
        table.state.home_attacks = table.state.home_attacks.reversed();
        table.shoot_east();
        assert_eq!(table.state.score, [0, 1]);
    }
}
