//! The way back onto the field, for robots that have been taken off.

use std::f32::consts::FRAC_PI_2;

use bevy::prelude::Vec2;

use crate::geometry::{Attacking, Pose};
use crate::ids::RobotId;
use crate::world::referee::decision::Decision;
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::ReturnPlace;
use crate::world::referee::rules::observation::{Laws, Observation, is_over, placed_ball, standing};
use crate::world::referee::state::MatchState;

/// Counts the time of removed robots down, and lets them return while the ball is in play.
pub(super) fn returns(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    for removal in &mut state.removed {
        removal.seconds_left = (removal.seconds_left - state.played).max(0.0);
    }
    if state.phase != Phase::Playing {
        return;
    }
    let due = state.removed.iter().filter(|removal| is_over(-removal.seconds_left, 0.0));
    let due: Vec<RobotId> = due.map(|removal| removal.robot).collect();
    bring_back(&due, laws, observation, state, decisions);
}

/// Lets all removed robots return for a kick-off, but those that are off for good.
pub(super) fn all(
    laws: &Laws,
    observation: &Observation,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let due = state.removed.iter().filter(|removal| removal.seconds_left.is_finite());
    let due: Vec<RobotId> = due.map(|removal| removal.robot).collect();
    bring_back(&due, laws, observation, state, decisions);
}

/// Lets these robots return, as far as there is room.
pub(super) fn bring_back(
    due: &[RobotId],
    laws: &Laws,
    observation: &Observation,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    for &robot in due {
        let robots: Vec<Vec2> = standing(observation, state, decisions).collect();
        let attacks = state.attacking(robot.team);
        let ball = placed_ball(decisions).unwrap_or(observation.ball);
        if let Some(at) = place_at_side_line(laws, laws.book.returns, ball, attacks, &robots) {
            state.removed.retain(|removal| removal.robot != robot);
            decisions.push(Decision::RobotReturned { robot, at });
        }
    }
}

/// Places along a side line that are tried for a returning robot.
const PLACES: u8 = 12;

/// A pose at the side line, as near to the half-way line as there is room, facing the field: on the side farther from the
/// ball if there is a place, else on the other. `None` if other robots take all places.
pub(super) fn place_at_side_line(
    laws: &Laws,
    place: ReturnPlace,
    ball: Vec2,
    attacks: Attacking,
    robots: &[Vec2],
) -> Option<Pose> {
    let room = laws.book.spot_clearance;
    let half = laws.pitch.half_size();
    let far = if ball.y > 0.0 { -1.0 } else { 1.0 };
    for side in [far, -far] {
        for number in 0..PLACES {
            let x = match place {
                ReturnPlace::OwnHalf => attacks.turn(Vec2::new(-room * f32::from(2 * number + 1), 0.0)).x,
                // To and fro about the half-way line, first away from the ball.
                ReturnPlace::HalfWayLine => {
                    let away = if (ball.x > 0.0) == (number % 2 == 1) { -1.0 } else { 1.0 };
                    away * 2.0 * room * f32::from(number.div_ceil(2))
                }
            };
            if x.abs() > half.x - room {
                break;
            }
            let at = Vec2::new(x, side * (half.y - room).max(0.0));
            if robots.iter().all(|robot| robot.distance(at) >= 2.0 * room) {
                return Some(Pose { position: at, heading: -side * FRAC_PI_2 });
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use crate::ids::Team;
    use crate::world::referee::decision::RemovalReason;
    use crate::world::referee::rules::table::{KICK_OFF_SECONDS, Table};

    use super::*;
    use crate::world::referee::rules::observation::send_off;

    const IN_WEST: Vec2 = Vec2::new(-4.0, 0.5);
    const IN_WEST_TOO: Vec2 = Vec2::new(-4.0, -0.5);
    const HOME_0: RobotId = RobotId::new(Team::Home, 0);
    const HOME_1: RobotId = RobotId::new(Team::Home, 1);
    const HOME_2: RobotId = RobotId::new(Team::Home, 2);

    #[test]
    fn a_removed_robot_returns_after_thirty_seconds_of_play_far_from_the_ball_in_its_own_half() {
        let mut table = Table::playing(60);
        table.put(HOME_0, IN_WEST);
        table.put(HOME_1, IN_WEST_TOO);
        table.run(10.1);
        table.put(HOME_0, Vec2::new(-4.0, 2.0));
        table.roll_about_in_the_north(29.0);
        assert!(table.state.is_removed(HOME_1));
        table.roll_about_in_the_north(1.0);
        assert!(!table.state.is_removed(HOME_1));
        let Some((_, Decision::RobotReturned { robot, at })) = table.log.last() else {
            panic!("{:?}", table.log.last());
        };
        assert_eq!((*robot, at.position), (HOME_1, Vec2::new(-0.35, -2.15)));
        assert!(at.forward().y > 0.99, "it faces the field");
    }

    #[test]
    fn the_time_of_a_removed_robot_stops_with_the_clock() {
        let mut table = Table::playing(60);
        table.put(HOME_0, IN_WEST);
        table.put(HOME_1, IN_WEST_TOO);
        table.run(10.1);
        table.put(HOME_0, Vec2::new(-4.0, 2.0));
        table.shoot_east();
        let left = table.state.removed[0].seconds_left;
        table.run(KICK_OFF_SECONDS - 0.1);
        assert_eq!(table.state.removed[0].seconds_left, left);
        table.run(1.1);
        assert!((left - table.state.removed[0].seconds_left - 1.0).abs() < 0.05);
    }

    #[test]
    fn two_that_return_at_the_same_time_stand_apart_and_not_on_a_third() {
        let mut table = Table::playing(60);
        table.put(HOME_0, Vec2::new(-0.4, 2.1));
        for robot in [HOME_1, HOME_2] {
            table.take_off(robot);
            table.state.remove(robot, 0.0, RemovalReason::Ordered);
        }
        table.run(0.1);
        let places = [HOME_0, HOME_1, HOME_2].map(|robot| table.place(robot));
        for (a, b) in [(0, 1), (0, 2), (1, 2)] {
            assert!(places[a].distance(places[b]) >= 0.7, "{places:?}");
        }
        assert!(places.iter().all(|at| at.x < 0.0 && at.y > 2.0), "{places:?}");
    }

    #[test]
    fn a_robot_returns_on_the_other_side_when_the_far_one_is_full() {
        let mut table = Table::playing(60);
        table.take_off(HOME_1);
        table.state.remove(HOME_1, 0.0, RemovalReason::Ordered);
        for number in 10..20_u8 {
            table.put(RobotId::new(Team::Away, number), Vec2::new(-0.5 * f32::from(number - 10), -2.15));
        }
        table.ball = Vec2::new(2.0, 1.0);
        table.run(0.1);
        assert_eq!(table.place(HOME_1), Vec2::new(-0.35, 2.15));
    }

    #[test]
    fn a_four_legged_robot_returns_on_the_half_way_line_far_from_the_ball_facing_the_other_side() {
        for (ball, side) in [(Vec2::new(0.5, 1.0), -1.0), (Vec2::new(-0.5, -1.0), 1.0)] {
            let mut table = Table::four_legged_playing(60);
            table.ball = ball;
            for robot in [HOME_1, HOME_2] {
                table.take_off(robot);
                table.state.remove(robot, 1.0, RemovalReason::Ordered);
            }
            table.run(0.9);
            assert!(table.state.is_removed(HOME_1));
            table.run(0.2);
            assert_eq!(table.place(HOME_1), Vec2::new(0.0, side * 1.8));
            let beside = if ball.x > 0.0 { -0.4 } else { 0.4 };
            assert_eq!(table.place(HOME_2), Vec2::new(beside, side * 1.8), "away from the ball");
            let headings = table.log.iter().filter_map(|(_, decision)| match decision {
                Decision::RobotReturned { at, .. } => Some(at.forward().y * side),
                _ => None,
            });
            assert!(headings.into_iter().all(|towards_the_side| towards_the_side < -0.99));
        }
    }

    #[test]
    fn a_kick_off_ends_a_removal_by_the_rules_of_2008_but_not_one_for_good() {
        let mut table = Table::four_legged_playing(60);
        table.book.goal_from_kick_off = true;
        table.restart_in_play();
        for (robot, seconds) in [(HOME_1, 20.0), (HOME_2, f64::INFINITY)] {
            table.take_off(robot);
            table.state.remove(robot, seconds, RemovalReason::Ordered);
        }
        table.run(5.0);
        table.shoot_east();
        assert_eq!(table.state.score, [1, 0]);
        assert!(!table.state.is_removed(HOME_1) && table.state.is_removed(HOME_2));
        let returned = |d: &Decision| matches!(d, Decision::RobotReturned { robot: HOME_1, .. });
        assert_eq!(table.times(returned).len(), 1);
    }

    #[test]
    fn a_removal_of_no_seconds_lasts_until_the_next_sample() {
        for hertz in [20, 60, 240] {
            let mut table = Table::four_legged_playing(hertz);
            let mut made = Vec::new();
            send_off(&mut table.state, &mut made, HOME_1, 0.0, RemovalReason::LocalStuck);
            assert_eq!(made.len(), 1);
            table.take_off(HOME_1);
            table.run(1.0 / f64::from(hertz));
            assert_eq!(table.place(HOME_1), Vec2::new(0.0, 1.8));
        }
    }
}
