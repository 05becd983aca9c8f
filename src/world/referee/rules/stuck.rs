//! A ball that is stuck, by the rules of the four-legged league: among robots the nearest of them goes to the half-way
//! line, and where nobody touches it there is a kick-off.

use bevy::prelude::Vec2;

use super::progress::place_at_spot;
use crate::geometry::Attacking;
use crate::ids::Team;
use crate::world::referee::decision::{Decision, PlacementReason, RemovalReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::{LocalGlobal, RuleBook, Stuck};
use crate::world::referee::rules::observation::{
    Laws, Observation, is_over, placed_ball, send_off, standing,
};
use crate::world::referee::state::{Anchor, MatchState};

/// Seconds since the last touch during which robots still count as being at the ball. ASSUMPTION: the rules speak of a
/// situation that does not change, and leave it to the referee to see one.
const LULL: f64 = 1.0;

/// Asks first whether anybody touches the ball at all, then whether it gets anywhere.
pub(super) fn stuck(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let Stuck::LocalGlobal(limits) = &laws.book.stuck else { return };
    if state.phase != Phase::Playing {
        return;
    }
    if let Some(at) = placed_ball(decisions) {
        state.anchor = Some(Anchor { at, seconds: 0.0 });
    }
    if is_over(state.untouched, limits.global_seconds) {
        kick_off_instead(limits, observation.ball, state, decisions);
    } else if placed_ball(decisions).is_none() && observation.ball.is_finite() {
        clear_the_ball(limits, laws, observation, state, decisions);
    }
}

/// Gives a kick-off to the team in whose half the ball is.
fn kick_off_instead(limits: &LocalGlobal, ball: Vec2, state: &mut MatchState, decisions: &mut Vec<Decision>) {
    let end = if ball.x < 0.0 { Attacking::West } else { Attacking::East };
    let kick_off = if state.attacking(Team::Home) == end { Team::Away } else { Team::Home };
    let beyond = (state.untouched - f64::from(limits.global_seconds)).clamp(0.0, state.played);
    state.time_left += beyond;
    state.waited = beyond;
    state.kick_off = kick_off;
    state.phase = Phase::Initial;
    decisions.push(Decision::Untouched { kick_off });
}

/// Takes the nearest robot away from a ball that has been stuck among robots. A goalkeeper in its own half stays, and the
/// ball goes to the centre as soon as nobody stands there.
fn clear_the_ball(
    limits: &LocalGlobal,
    laws: &Laws,
    observation: &Observation,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let ball = observation.ball;
    let from = state.seen_ball.filter(|seen| seen.is_finite()).unwrap_or(ball);
    let anchor = state.anchor.unwrap_or(Anchor { at: from, seconds: 0.0 });
    let counted = if state.untouched <= LULL { state.played } else { 0.0 };
    let mut anchor = anchor.moved(from, ball, counted, laws.book.no_progress_distance);
    let nearest = observation.nearest(state, ball, |_| true);
    if let (true, Some((robot, at))) = (is_over(anchor.seconds, limits.local_seconds), nearest) {
        let beyond = (anchor.seconds - f64::from(limits.local_seconds)).clamp(0.0, state.played);
        let keeps = robot.number == RuleBook::KEEPER && state.attacking(robot.team).turn(at).x <= 0.0;
        if !keeps {
            send_off(state, decisions, robot, 0.0, RemovalReason::LocalStuck);
            anchor = Anchor { at: ball, seconds: beyond };
        } else {
            let robots: Vec<Vec2> = standing(observation, state, decisions).collect();
            if let Some(at) = place_at_spot(&[Vec2::ZERO], ball, &robots, laws) {
                decisions.push(Decision::BallPlaced { at, reason: PlacementReason::NoProgress });
                anchor = Anchor { at, seconds: beyond };
            }
        }
    }
    state.anchor = Some(anchor);
}

#[cfg(test)]
mod tests {
    use crate::ids::RobotId;
    use crate::world::referee::rules::table::Table;

    use super::*;

    const HOME_0: RobotId = RobotId::new(Team::Home, 0);
    const HOME_1: RobotId = RobotId::new(Team::Home, 1);
    const AWAY_1: RobotId = RobotId::new(Team::Away, 1);

    fn removals(table: &Table) -> Vec<RobotId> {
        table.removals(RemovalReason::LocalStuck)
    }

    fn kick_offs(table: &Table) -> Vec<Team> {
        let kick_off = |decision| match decision {
            Decision::Untouched { kick_off } => Some(kick_off),
            _ => None,
        };
        table.decisions().into_iter().filter_map(kick_off).collect()
    }

    /// A match in which the ball is where no robot waits and has been touched in the last sample.
    fn scrum(hertz: u32) -> Table {
        let mut table = Table::four_legged_playing(hertz);
        table.restart_in_play();
        table.ball = Vec2::new(0.8, -0.5);
        table.put(HOME_1, Vec2::new(0.6, -0.5));
        table.put(AWAY_1, Vec2::new(1.1, -0.5));
        table.touching = vec![HOME_1, AWAY_1];
        table.run(1.0 / f64::from(hertz));
        table
    }

    #[test]
    fn after_thirty_seconds_in_a_scrum_the_nearest_robot_goes_to_the_half_way_line() {
        for hertz in [20, 60, 240] {
            let sample = 1.0 / f64::from(hertz);
            let mut table = scrum(hertz);
            table.run(30.0 - sample);
            assert_eq!(removals(&table), []);
            table.run(sample);
            assert_eq!(removals(&table), [HOME_1], "{hertz} Hz");
            table.run(sample);
            assert_eq!((table.place(HOME_1), table.ball), (Vec2::new(0.0, 1.8), Vec2::new(0.8, -0.5)));
            table.run(29.9);
            assert_eq!(removals(&table), [HOME_1]);
            table.run(0.2);
            assert_eq!(removals(&table), [HOME_1, AWAY_1]);
        }
    }

    #[test]
    fn a_ball_that_gets_on_is_not_stuck() {
        let mut table = scrum(60);
        for step in 0..70_u8 {
            table.ball.x = if step % 2 == 0 { 0.2 } else { 1.1 };
            table.run(1.0);
        }
        assert_eq!(removals(&table), []);
    }

    #[test]
    fn the_time_that_a_ball_lay_untouched_is_no_scrum() {
        let mut table = scrum(60);
        table.touching.clear();
        table.run(25.0);
        table.touching = vec![HOME_1];
        table.run(28.5);
        assert_eq!((removals(&table), kick_offs(&table)), (vec![], vec![]));
        table.run(1.0);
        assert_eq!(removals(&table), [HOME_1]);
    }

    #[test]
    fn a_keeper_in_its_own_half_stays_and_the_ball_goes_to_the_centre() {
        for (ends, at) in [(Attacking::East, -1.0), (Attacking::West, 1.0)] {
            let mut table = scrum(60);
            table.state.home_attacks = ends;
            table.ball = Vec2::new(at, -0.5);
            table.put(HOME_0, table.ball + Vec2::X * 0.05);
            table.run(30.1);
            assert_eq!((removals(&table), table.ball), (vec![], Vec2::ZERO));
        }
        let mut table = scrum(60);
        table.ball = Vec2::new(1.0, -0.5);
        table.put(HOME_0, table.ball + Vec2::X * 0.05);
        table.run(30.1);
        assert_eq!(removals(&table), [HOME_0], "in the opponents' half it is like the others");
    }

    #[test]
    fn where_a_robot_stands_on_the_centre_the_keepers_ball_comes_down_beside_it() {
        let mut table = scrum(60);
        table.ball = Vec2::new(-1.0, -0.5);
        table.put(HOME_0, table.ball);
        table.put(HOME_1, Vec2::ZERO);
        table.run(29.9);
        assert_eq!(table.ball, Vec2::new(-1.0, -0.5));
        table.run(0.2);
        assert_eq!(table.ball.length(), table.book.spot_clearance);
    }

    #[test]
    fn a_ball_that_nobody_touches_for_thirty_seconds_leads_to_a_kick_off_by_those_who_defend_there() {
        for hertz in [20, 60, 240] {
            let sample = 1.0 / f64::from(hertz);
            for (x, home_attacks, team) in [
                (1.0, Attacking::East, Team::Away),
                (-1.0, Attacking::East, Team::Home),
                (1.0, Attacking::West, Team::Home),
            ] {
                let mut table = scrum(hertz);
                table.state.home_attacks = home_attacks;
                table.ball = Vec2::new(x, 1.0);
                let left = table.state.time_left;
                table.touching.clear();
                table.run(30.0 - sample);
                assert_eq!(kick_offs(&table), []);
                table.run(sample);
                assert_eq!((kick_offs(&table), removals(&table)), (vec![team], vec![]));
                assert_eq!((table.state.phase, table.state.kick_off), (Phase::Ready, team));
                assert!((left - table.state.time_left - 30.0).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn what_a_long_sample_goes_beyond_the_time_is_not_played() {
        let mut table = scrum(60);
        let left = table.state.time_left;
        table.touching.clear();
        table.look(29.0);
        table.look(1.75);
        assert_eq!((kick_offs(&table).len(), left - table.state.time_left), (1, 30.0));
        table.look(table.kick_off_seconds() - 0.5);
        assert_eq!(left - table.state.time_left, 30.25);
    }

    #[test]
    fn a_touch_starts_the_time_anew_and_so_does_a_kick_off() {
        let mut table = scrum(60);
        for step in 0..5_u8 {
            table.ball.x = f32::from(step) * 0.4 - 1.0;
            table.touching = vec![HOME_1];
            table.run(0.1);
            table.touching.clear();
            table.run(29.0);
        }
        table.restart_in_play();
        table.run(29.0);
        assert_eq!(kick_offs(&table), []);
    }
}
