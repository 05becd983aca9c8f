//! Crowding the own goal: a second robot may stay in its own penalty area for some seconds only.
//!
//! The robot that has been inside longest is the first defender and never at fault, so a team always keeps a robot.
//! Everyone else has been inside together with it for all of its own stay, and leaves when that is too long. Of two
//! that were first seen inside at the same sample, the one with the higher number is the later.

use std::f32::consts::FRAC_PI_2;

use bevy::prelude::Vec2;

use super::{Laws, Observation, is_over, standing};
use crate::geometry::{Attacking, Pose};
use crate::ids::{RobotId, Team};
use crate::referee::decision::{Decision, RemovalReason};
use crate::referee::state::{Defender, MatchState, Phase};

/// Takes later defenders off the field whose time is over.
pub(super) fn second_defender(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    if state.phase != Phase::Playing {
        return;
    }
    let area = laws.pitch.own_penalty_area();
    let defends = |&&(robot, at): &&(RobotId, Vec2)| {
        !state.is_removed(robot) && area.contains(state.attacking(robot.team).turn(at))
    };
    let stay = |&(robot, _): &(RobotId, Vec2)| {
        let known = state.defenders.iter().find(|defender| defender.robot == robot);
        Defender { robot, inside: known.map_or(0.0, |defender| defender.inside + state.played) }
    };
    let defenders: Vec<Defender> = observation.robots.iter().filter(defends).map(stay).collect();
    let first = Team::BOTH.map(|team| first_defender(team, &defenders));
    let limit = laws.book.second_defender_seconds;
    let (late, stays): (Vec<Defender>, Vec<Defender>) = defenders.into_iter().partition(|defender| {
        first[defender.robot.team.index()] != Some(defender.robot) && is_over(defender.inside, limit)
    });
    state.defenders = stays;
    for Defender { robot, inside } in late {
        let beyond = (inside - f64::from(limit)).max(0.0);
        state.remove(robot, (f64::from(laws.book.removal_seconds) - beyond).max(0.0));
        decisions.push(Decision::RobotRemoved { robot, reason: RemovalReason::SecondDefender });
    }
}

/// The robot of a team that has been in the area longest; of equals the one with the lower number.
fn first_defender(team: Team, defenders: &[Defender]) -> Option<RobotId> {
    let own = defenders.iter().filter(|defender| defender.robot.team == team);
    let first = own.max_by(|a, b| a.inside.total_cmp(&b.inside).then(b.robot.cmp(&a.robot)));
    first.map(|defender| defender.robot)
}

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
    for robot in due {
        let robots: Vec<Vec2> = standing(observation, state, decisions).collect();
        let attacks = state.attacking(robot.team);
        if let Some(at) = place_of_return(laws, observation.ball, attacks, &robots) {
            state.removed.retain(|removal| removal.robot != robot);
            decisions.push(Decision::RobotReturned { robot, at });
        }
    }
}

/// Places along a side line that are tried for a returning robot.
const PLACES: u8 = 12;

/// A pose at the side line, as near to the half-way line as the own half has room, facing the field: on the side farther
/// from the ball if there is a place, else on the other. `None` if other robots take all places.
fn place_of_return(laws: &Laws, ball: Vec2, attacks: Attacking, robots: &[Vec2]) -> Option<Pose> {
    let room = laws.book.spot_clearance;
    let half = laws.pitch.half_size();
    let far = if ball.y > 0.0 { -1.0 } else { 1.0 };
    for side in [far, -far] {
        for place in 0..PLACES {
            let back = room * f32::from(2 * place + 1);
            if back > half.x - room {
                break;
            }
            let x = attacks.turn(Vec2::new(-back, 0.0)).x;
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
    use crate::referee::rules::table::{KICK_OFF_SECONDS, Table};

    use super::*;

    const IN_WEST: Vec2 = Vec2::new(-4.0, 0.5);
    const IN_WEST_TOO: Vec2 = Vec2::new(-4.0, -0.5);
    const HOME_0: RobotId = RobotId::new(Team::Home, 0);
    const HOME_1: RobotId = RobotId::new(Team::Home, 1);
    const HOME_2: RobotId = RobotId::new(Team::Home, 2);

    fn removals(table: &Table) -> Vec<RobotId> {
        let removed = |decision| match decision {
            Decision::RobotRemoved { robot, .. } => Some(robot),
            _ => None,
        };
        table.decisions().into_iter().filter_map(removed).collect()
    }

    #[test]
    fn one_defender_may_stay_as_long_as_it_likes() {
        let mut table = Table::playing(60);
        table.put(HOME_2, IN_WEST);
        table.run(60.0);
        assert_eq!(removals(&table), []);
    }

    #[test]
    fn the_robot_that_entered_later_leaves_after_ten_seconds_together() {
        let mut table = Table::playing(60);
        table.put(HOME_2, IN_WEST);
        table.run(5.0);
        table.put(HOME_1, IN_WEST_TOO);
        table.run(9.9);
        assert_eq!(removals(&table), []);
        table.run(0.2);
        assert_eq!(removals(&table), [HOME_1]);
        assert!(table.state.is_removed(HOME_1));
    }

    #[test]
    fn of_two_that_entered_together_the_higher_number_leaves() {
        let mut table = Table::playing(60);
        table.put(HOME_0, IN_WEST);
        table.put(HOME_1, IN_WEST_TOO);
        table.run(10.1);
        assert_eq!(removals(&table), [HOME_1]);
    }

    #[test]
    fn a_whole_team_in_its_area_is_reduced_to_one_robot() {
        let mut table = Table::playing(60);
        for number in 0..4 {
            table.put(RobotId::new(Team::Home, number), IN_WEST - Vec2::Y * 0.3 * f32::from(number));
        }
        table.run(25.0);
        assert_eq!(removals(&table).len(), 3);
        assert!(!table.state.is_removed(HOME_0));
    }

    #[test]
    fn leaving_the_area_starts_the_time_anew() {
        let mut table = Table::playing(60);
        table.put(HOME_0, IN_WEST);
        for _ in 0..5 {
            table.put(HOME_1, IN_WEST_TOO);
            table.run(9.0);
            table.put(HOME_1, Vec2::new(-3.0, -0.5));
            table.run(0.1);
        }
        assert_eq!(removals(&table), []);
    }

    #[test]
    fn a_kick_off_starts_the_time_anew() {
        let mut table = Table::playing(60);
        for _ in 0..3 {
            table.put(HOME_0, IN_WEST);
            table.put(HOME_1, IN_WEST_TOO);
            table.run(9.0);
            table.shoot_east();
            table.put(HOME_0, IN_WEST);
            table.put(HOME_1, IN_WEST_TOO);
            table.run(KICK_OFF_SECONDS);
        }
        assert_eq!(removals(&table), []);
    }

    #[test]
    fn opponents_in_the_area_are_no_defenders() {
        let mut table = Table::playing(60);
        table.put(HOME_0, IN_WEST);
        for number in 0..3 {
            table.put(RobotId::new(Team::Away, number), IN_WEST_TOO + Vec2::Y * 0.3 * f32::from(number));
        }
        table.run(20.0);
        assert_eq!(removals(&table), []);
    }

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
            table.state.remove(robot, 0.0);
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
        table.state.remove(HOME_1, 0.0);
        for number in 10..20_u8 {
            table.put(RobotId::new(Team::Away, number), Vec2::new(-0.5 * f32::from(number - 10), -2.15));
        }
        table.ball = Vec2::new(2.0, 1.0);
        table.run(0.1);
        assert_eq!(table.place(HOME_1), Vec2::new(-0.35, 2.15));
    }

    #[test]
    fn in_the_second_half_the_other_area_is_the_own_one() {
        let mut table = Table::playing(60);
        table.state.home_attacks = Attacking::West;
        table.put(HOME_0, IN_WEST);
        table.put(HOME_1, IN_WEST_TOO);
        table.run(12.0);
        assert_eq!(removals(&table), []);
        table.put(HOME_0, -IN_WEST);
        table.put(HOME_1, -IN_WEST_TOO);
        table.run(12.0);
        assert_eq!(removals(&table), [HOME_1]);
    }
}
