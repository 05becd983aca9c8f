//! Crowding the own goal: a second robot may stay in its own penalty area for some seconds only.
//!
//! The robot that has been inside longest is the first defender and never at fault, so a team always keeps a robot.
//! Everyone else has been inside together with it for all of its own stay, and leaves when that is too long. Of two
//! that were first seen inside at the same sample, the one with the higher number is the later.

use bevy::prelude::Vec2;

use crate::ids::{RobotId, Team};
use crate::world::referee::decision::{Decision, RemovalReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::DefenderRule;
use crate::world::referee::rules::observation::{Laws, Observation, is_in_own_area, is_over, send_off};
use crate::world::referee::state::{Defender, MatchState};

/// Takes later defenders off the field whose time is over.
pub(super) fn second_defender(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    if laws.book.defenders != DefenderRule::Second || state.phase != Phase::Playing {
        return;
    }
    let defends = |&(robot, at): &(RobotId, Vec2)| is_in_own_area(laws, state, robot, at);
    let stay = |(robot, _): (RobotId, Vec2)| {
        let known = state.defenders.iter().find(|defender| defender.robot == robot);
        Defender { robot, inside: known.map_or(0.0, |defender| defender.inside + state.played) }
    };
    let defenders: Vec<Defender> = observation.on_field(state).filter(defends).map(stay).collect();
    let first = Team::BOTH.map(|team| first_defender(team, &defenders));
    let limit = laws.book.second_defender_seconds;
    let (late, stays): (Vec<Defender>, Vec<Defender>) = defenders.into_iter().partition(|defender| {
        first[defender.robot.team.index()] != Some(defender.robot) && is_over(defender.inside, limit)
    });
    state.defenders = stays;
    for Defender { robot, inside } in late {
        let beyond = (inside - f64::from(limit)).max(0.0);
        let away = f64::from(laws.book.removal_seconds) - beyond;
        send_off(state, decisions, robot, away, RemovalReason::SecondDefender);
    }
}

/// The robot of a team that has been in the area longest; of equals the one with the lower number.
fn first_defender(team: Team, defenders: &[Defender]) -> Option<RobotId> {
    let own = defenders.iter().filter(|defender| defender.robot.team == team);
    let first = own.max_by(|a, b| a.inside.total_cmp(&b.inside).then(b.robot.cmp(&a.robot)));
    first.map(|defender| defender.robot)
}

#[cfg(test)]
mod tests {
    use crate::geometry::Attacking;
    use crate::world::referee::rules::table::{KICK_OFF_SECONDS, Table};

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
