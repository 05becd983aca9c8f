//! Charging, in the middle-size league: who drives against an opponent that does not drive against it is warned, and the next
//! time taken off.
//!
//! Two robots that drive against each other, as around a ball, are both in the right.

use crate::ids::RobotId;
use crate::world::referee::decision::{Decision, RemovalReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rules::observation::{Laws, Observation, is_over, send_off};
use crate::world::referee::state::{MatchState, Streak, streaks_after};

/// Warns robots that charge an opponent, and takes them off the next time.
pub(super) fn charging(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let Some(rule) = &laws.book.charging else { return };
    if state.phase != Phase::Playing {
        return;
    }
    let shoves = |by: RobotId, whom: RobotId| observation.shoving.contains(&(by, whom));
    let charges = |robot: RobotId| {
        let opponents =
            observation.shoving.iter().filter(|(by, whom)| *by == robot && whom.team != robot.team);
        opponents.into_iter().any(|(_, whom)| !shoves(*whom, robot))
    };
    let charging: Vec<RobotId> =
        observation.on_field(state).map(|(robot, _)| robot).filter(|robot| charges(*robot)).collect();
    state.charges = streaks_after(&state.charges, state.played, &charging);
    let too_long = |(robot, streak): &(RobotId, Streak)| {
        charging.contains(robot) && is_over(streak.seconds, rule.seconds)
    };
    let guilty: Vec<RobotId> =
        state.charges.iter().filter(|it| too_long(it)).map(|(robot, _)| *robot).collect();
    for robot in guilty {
        if state.warned.contains(&robot) {
            let away = f64::from(laws.book.removal_seconds);
            send_off(state, decisions, robot, away, RemovalReason::Charging);
        } else {
            state.warned.push(robot);
            state.charges.retain(|(other, _)| *other != robot);
            decisions.push(Decision::RobotWarned { robot });
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::ids::Team;
    use crate::world::referee::rulebook::Charging;
    use crate::world::referee::rules::table::Table;

    use super::*;

    const HOME_1: RobotId = RobotId::new(Team::Home, 1);
    const HOME_2: RobotId = RobotId::new(Team::Home, 2);
    const AWAY_1: RobotId = RobotId::new(Team::Away, 1);

    /// A middle-size match with the rule, whose ball keeps rolling about in the north.
    fn playing(hertz: u32, shoving: &[(RobotId, RobotId)]) -> Table {
        let mut table = Table::playing(hertz);
        table.book.charging = Some(Charging::default());
        table.shoving = shoving.to_vec();
        table
    }

    fn warnings(table: &Table) -> usize {
        table.times(|decision| *decision == Decision::RobotWarned { robot: HOME_1 }).len()
    }

    fn removals(table: &Table) -> Vec<RobotId> {
        table.removals(RemovalReason::Charging)
    }

    #[test]
    fn a_charge_of_two_seconds_brings_a_warning_and_the_next_one_a_removal() {
        for hertz in [20, 60, 240] {
            let mut table = playing(hertz, &[(HOME_1, AWAY_1)]);
            table.roll_about_in_the_north(2.0);
            assert_eq!((warnings(&table), removals(&table)), (0, vec![]));
            table.roll_about_in_the_north(0.5);
            assert_eq!((warnings(&table), removals(&table)), (1, vec![]));
            table.roll_about_in_the_north(2.0);
            assert_eq!((warnings(&table), removals(&table)), (1, vec![HOME_1]));
            assert_eq!(table.state.removed[0].reason, RemovalReason::Charging);
        }
    }

    #[test]
    fn two_that_drive_against_each_other_are_both_in_the_right() {
        let mut table = playing(60, &[(HOME_1, AWAY_1), (AWAY_1, HOME_1)]);
        table.roll_about_in_the_north(10.0);
        assert_eq!((warnings(&table), removals(&table)), (0, vec![]));
    }

    #[test]
    fn short_shoves_and_shoves_among_team_mates_are_no_charges() {
        let mut table = playing(60, &[(HOME_1, HOME_2)]);
        table.roll_about_in_the_north(5.0);
        for _ in 0..5 {
            table.shoving = vec![(HOME_1, AWAY_1)];
            table.roll_about_in_the_north(1.5);
            table.shoving.clear();
            table.roll_about_in_the_north(2.0);
        }
        assert_eq!((warnings(&table), removals(&table)), (0, vec![]));
    }

    #[test]
    fn without_the_rule_nobody_is_warned() {
        let mut table = playing(60, &[(HOME_1, AWAY_1)]);
        table.book.charging = None;
        table.roll_about_in_the_north(10.0);
        assert_eq!((warnings(&table), removals(&table)), (0, vec![]));
    }
}
