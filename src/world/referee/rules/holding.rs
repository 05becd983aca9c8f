//! Holding the ball, by the rules of the four-legged league.
//!
//! A field player may hold it for some seconds and carry it some way; so may a goalkeeper outside of its own penalty
//! area, while inside only a longer time counts. A robot that lets the ball go for a shorter time than it has held it goes on
//! holding it.

use crate::ids::RobotId;
use crate::world::referee::decision::{Decision, RemovalReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::RuleBook;
use crate::world::referee::rules::observation::{Laws, Observation, is_in_own_area, is_over, send_off};
use crate::world::referee::state::{BallHold, MatchState, Streak};

/// Takes off a robot that holds the ball too long or carries it too far: a field player for the time of a removal, a
/// goalkeeper for none. The ball stays where it is.
pub(super) fn ball_holding(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let Some(limits) = &laws.book.ball_holding else { return };
    if state.phase != Phase::Playing {
        return;
    }
    let holder = observation.held_by.and_then(|robot| Some((robot, observation.place(robot, state)?)));
    state.hold = hold(observation, state, holder.map(|(robot, _)| robot));
    let (Some(hold), Some((robot, at))) = (state.hold, holder) else { return };
    let is_keeper = robot.number == RuleBook::KEEPER;
    let at_home = is_keeper && is_in_own_area(laws, state, robot, at);
    let seconds = if at_home { limits.keeper_seconds } else { limits.field_seconds };
    let too_long = is_over(hold.streak.seconds, seconds);
    let too_far = !at_home && hold.carried + hold.from.distance(observation.ball) > limits.field_distance;
    if !(too_long || too_far) {
        return;
    }
    let beyond = (hold.streak.seconds - f64::from(seconds)).clamp(0.0, state.played);
    let away = if is_keeper { 0.0 } else { f64::from(laws.book.removal_seconds) - beyond };
    send_off(state, decisions, robot, away, RemovalReason::BallHolding);
}

/// What is known of holding after this sample.
fn hold(observation: &Observation, state: &MatchState, holder: Option<RobotId>) -> Option<BallHold> {
    let ball = observation.ball;
    let known = state.hold.filter(|hold| holder.is_none_or(|robot| robot == hold.robot));
    match (known, holder) {
        (None, None) => None,
        (None, Some(robot)) => Some(BallHold { robot, streak: Streak::default(), from: ball, carried: 0.0 }),
        (Some(hold), Some(_)) => {
            let from = if hold.streak.paused > 0.0 { ball } else { hold.from };
            Some(BallHold { streak: hold.streak.after(state.played, true)?, from, ..hold })
        }
        (Some(hold), None) => {
            let seen = state.seen_ball.filter(|_| hold.streak.paused == 0.0);
            let carried = hold.carried + seen.map_or(0.0, |seen| seen.distance(hold.from));
            Some(BallHold { streak: hold.streak.after(state.played, false)?, carried, ..hold })
        }
    }
}

#[cfg(test)]
mod tests {
    use bevy::prelude::Vec2;

    use crate::geometry::Attacking;
    use crate::ids::Team;
    use crate::world::referee::decision::NoGoalReason;
    use crate::world::referee::rules::table::Table;
    use crate::world::referee::state::KickOffShot;

    use super::*;

    const HOME_0: RobotId = RobotId::new(Team::Home, 0);
    const HOME_1: RobotId = RobotId::new(Team::Home, 1);
    const AT_HOME: Vec2 = Vec2::new(-2.4, 0.0);

    fn removals(table: &Table) -> Vec<RobotId> {
        table.removals(RemovalReason::BallHolding)
    }

    /// A match in which a robot got hold of the ball in the last sample.
    fn holding(hertz: u32, robot: RobotId, at: Vec2) -> Table {
        let mut table = Table::four_legged_playing(hertz);
        table.put(robot, at);
        table.ball = at + Vec2::X * 0.18;
        table.run(1.0 / f64::from(hertz));
        table.held_by = Some(robot);
        table.run(1.0 / f64::from(hertz));
        table
    }

    #[test]
    fn a_field_player_may_hold_the_ball_for_three_seconds() {
        for hertz in [20, 60, 240] {
            let sample = 1.0 / f64::from(hertz);
            let mut table = holding(hertz, HOME_1, Vec2::ZERO);
            table.run(3.0 - sample);
            assert_eq!(removals(&table), []);
            table.run(sample);
            assert_eq!(removals(&table), [HOME_1]);
            assert!((table.state.removed[0].seconds_left - 30.0).abs() < 1e-5);
        }
    }

    #[test]
    fn it_may_carry_the_ball_half_a_metre() {
        for hertz in [20, 60, 240] {
            let mut table = holding(hertz, HOME_1, Vec2::ZERO);
            let from = table.ball;
            for carried in [0.25, 0.49] {
                table.ball = from + Vec2::Y * carried;
                table.run(0.5);
                assert_eq!(removals(&table), []);
            }
            table.ball = from + Vec2::Y * 0.51;
            table.run(1.0 / f64::from(hertz));
            assert_eq!(removals(&table), [HOME_1]);
        }
    }

    #[test]
    fn a_short_release_does_not_help_and_a_long_one_does() {
        for (release, removed) in [(1.5, vec![HOME_1]), (2.1, vec![])] {
            let mut table = holding(60, HOME_1, Vec2::ZERO);
            table.run(2.0);
            table.held_by = None;
            table.run(release);
            table.held_by = Some(HOME_1);
            table.run(1.0);
            assert_eq!(removals(&table), removed, "after {release} s");
        }
    }

    #[test]
    fn a_ball_that_rolled_ahead_between_two_holds_was_not_carried_there() {
        let mut table = holding(60, HOME_1, Vec2::ZERO);
        table.run(1.0);
        table.held_by = None;
        table.ball += Vec2::X * 0.7;
        table.run(0.5);
        table.held_by = Some(HOME_1);
        for _ in 0..2 {
            table.run(0.1);
            table.ball += Vec2::X * 0.3;
            assert_eq!(removals(&table), []);
        }
        table.run(0.1);
        assert_eq!(removals(&table), [HOME_1]);
    }

    #[test]
    fn another_robot_begins_anew() {
        let mut table = holding(60, HOME_1, Vec2::ZERO);
        table.run(2.5);
        table.held_by = Some(RobotId::new(Team::Away, 1));
        table.run(2.5);
        table.held_by = Some(HOME_1);
        table.run(2.5);
        assert_eq!(removals(&table), []);
    }

    #[test]
    fn a_keeper_in_its_area_has_five_seconds_and_goes_to_the_half_way_line() {
        for (hertz, ends) in [(20, Attacking::East), (60, Attacking::West), (240, Attacking::East)] {
            let sample = 1.0 / f64::from(hertz);
            let mut table = Table::four_legged_playing(hertz);
            table.state.home_attacks = ends;
            table.put(HOME_0, ends.turn(AT_HOME));
            table.ball = ends.turn(AT_HOME + Vec2::X * 0.18);
            table.held_by = Some(HOME_0);
            table.run(5.0);
            assert_eq!(removals(&table), []);
            table.run(sample);
            assert_eq!(removals(&table), [HOME_0]);
            table.run(sample);
            assert_eq!(table.place(HOME_0).x, 0.0);
        }
    }

    #[test]
    fn a_keeper_outside_of_its_area_has_three_seconds_also_in_the_other_one() {
        for at in [Vec2::new(-1.5, 0.0), -AT_HOME - Vec2::X * 0.4] {
            let mut table = holding(60, HOME_0, at);
            table.run(2.9);
            assert_eq!(removals(&table), []);
            table.run(0.2);
            assert_eq!(removals(&table), [HOME_0]);
            assert!(table.state.removed.is_empty(), "it is back at once");
        }
    }

    #[test]
    fn a_kick_off_starts_the_time_anew() {
        let mut table = holding(60, HOME_1, Vec2::ZERO);
        table.run(2.5);
        table.restart_in_play();
        table.run(2.9);
        assert_eq!(removals(&table), []);
    }

    #[test]
    fn a_ball_that_is_carried_in_from_the_kick_off_is_a_kick_off_shot() {
        let mut table = holding(60, HOME_1, Vec2::ZERO);
        table.held_by = None;
        table.ball = Vec2::new(2.6, 0.0);
        table.look(0.1);
        // Nobody of the team is on the field to touch it.
        table.robots.retain(|(robot, _)| robot.team == Team::Away);
        table.state.shot = KickOffShot::Left;
        table.held_by = Some(HOME_1);
        table.ball = Vec2::new(2.9, 0.0);
        table.look(0.1);
        let void = Decision::NoGoal { by: Team::Home, reason: NoGoalReason::KickOffShot };
        assert!(table.decisions().contains(&void) && table.state.phase == Phase::Ready);
    }

    #[test]
    fn nobody_carries_the_ball_into_the_opponents_goal_but_into_the_own_one() {
        let mut table = holding(60, HOME_1, Vec2::new(2.4, 0.0));
        table.restart_in_play();
        table.run(0.1);
        table.shoot_east();
        let void = Decision::NoGoal { by: Team::Home, reason: NoGoalReason::Held };
        assert!(table.decisions().contains(&void));
        assert_eq!((table.state.phase, table.ball), (Phase::Playing, Vec2::new(0.0, 1.6)));
        table.shoot_west();
        assert_eq!(table.state.score, [0, 1]);
    }
}
