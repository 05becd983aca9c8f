//! Nobody but the goalkeeper in the own penalty area, by the rules of the four-legged league.

use crate::ids::RobotId;
use crate::world::referee::decision::{Decision, RemovalReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::{DefenderRule, RuleBook};
use crate::world::referee::rules::observation::{Laws, Observation, is_in_own_area, is_over, send_off};
use crate::world::referee::state::{Defender, MatchState};

/// Seconds within which a robot that opponents pushed in has to be out again. ASSUMPTION: the rules give none.
const WAY_OUT: f32 = 5.0;
/// Seconds after a push within which a robot that comes in was pushed in: bodies that press on each other part for moments.
/// ASSUMPTION.
const JUST_NOW: f64 = 0.5;

/// Takes field players off that are in their own penalty area, at once. One that came in while an opponent pushed it has
/// some time to leave, and is not at fault while it is still being pushed.
pub(super) fn illegal_defender(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    if laws.book.defenders != DefenderRule::KeeperOnly || state.phase != Phase::Playing {
        return;
    }
    note_pushed(observation, state);
    let field_players = observation.on_field(state).filter(|(robot, _)| robot.number != RuleBook::KEEPER);
    let inside = field_players.filter(|(robot, at)| is_in_own_area(laws, state, *robot, *at));
    let inside: Vec<RobotId> = inside.map(|(robot, _)| robot).collect();
    let excused = std::mem::take(&mut state.defenders);
    for robot in inside {
        let pushed = state.pushed.iter().any(|(pushed, _)| *pushed == robot);
        let known = excused.iter().find(|defender| defender.robot == robot);
        let inside = match known {
            _ if pushed => 0.0,
            Some(defender) => defender.inside + state.played,
            None => f64::INFINITY,
        };
        if is_over(inside, WAY_OUT) {
            let away = f64::from(laws.book.removal_seconds);
            send_off(state, decisions, robot, away, RemovalReason::IllegalDefender);
        } else {
            state.defenders.push(Defender { robot, inside });
        }
    }
}

/// Keeps who was pushed by an opponent a moment ago.
fn note_pushed(observation: &Observation, state: &mut MatchState) {
    let mut pushed: Vec<(RobotId, f64)> = (observation.shoving.iter())
        .filter(|(by, whom)| by.team != whom.team)
        .map(|(_, whom)| (*whom, 0.0))
        .collect();
    let before = std::mem::take(&mut state.pushed);
    let ago = before.into_iter().map(|(robot, ago)| (robot, ago + state.played));
    pushed.extend(ago.filter(|(_, ago)| *ago <= JUST_NOW));
    pushed.sort_by(|(a, now), (b, then)| a.cmp(b).then(now.total_cmp(then)));
    pushed.dedup_by_key(|(robot, _)| *robot);
    pushed.retain(|(robot, _)| !state.is_removed(*robot));
    state.pushed = pushed;
}

#[cfg(test)]
mod tests {
    use bevy::prelude::Vec2;

    use crate::geometry::Attacking;
    use crate::ids::Team;
    use crate::world::referee::rules::table::Table;

    use super::*;

    const HOME_0: RobotId = RobotId::new(Team::Home, 0);
    const HOME_1: RobotId = RobotId::new(Team::Home, 1);
    const AWAY_1: RobotId = RobotId::new(Team::Away, 1);
    const INSIDE: Vec2 = Vec2::new(-2.1, 0.3);

    fn removals(table: &Table) -> Vec<RobotId> {
        table.removals(RemovalReason::IllegalDefender)
    }

    #[test]
    fn a_field_player_leaves_in_the_sample_in_which_its_centre_is_inside() {
        for hertz in [20, 60, 240] {
            let mut table = Table::four_legged_playing(hertz);
            table.put(HOME_1, Vec2::new(-2.04, 0.3));
            table.run(3.0);
            assert_eq!(removals(&table), []);
            table.put(HOME_1, Vec2::new(-2.06, 0.3));
            table.run(1.0 / f64::from(hertz));
            assert_eq!(removals(&table), [HOME_1]);
            assert_eq!(table.state.removed[0].seconds_left, 30.0);
        }
    }

    #[test]
    fn it_leaves_also_while_the_keeper_is_away() {
        let mut table = Table::four_legged_playing(60);
        table.put(HOME_0, Vec2::new(-1.0, 0.0));
        table.put(HOME_1, INSIDE);
        table.run(0.1);
        assert_eq!(removals(&table), [HOME_1]);
    }

    #[test]
    fn keeper_and_opponents_may_stay() {
        let mut table = Table::four_legged_playing(60);
        table.put(HOME_0, INSIDE);
        table.put(AWAY_1, INSIDE - Vec2::Y * 0.5);
        table.run(20.0);
        assert_eq!(removals(&table), []);
    }

    #[test]
    fn whoever_is_pushed_in_has_some_seconds_to_leave_after_the_push() {
        for hertz in [20, 60, 240] {
            let mut table = Table::four_legged_playing(hertz);
            table.book.pushing = None;
            table.put(HOME_1, INSIDE);
            table.shoving = vec![(AWAY_1, HOME_1)];
            table.run(8.0);
            table.shoving.clear();
            table.run(5.3);
            assert_eq!(removals(&table), []);
            table.run(0.3);
            assert_eq!(removals(&table), [HOME_1]);
        }
    }

    #[test]
    fn a_push_by_a_teammate_is_no_excuse() {
        let mut table = Table::four_legged_playing(60);
        table.put(HOME_1, INSIDE);
        table.shoving = vec![(HOME_0, HOME_1)];
        table.run(0.1);
        assert_eq!(removals(&table), [HOME_1]);
    }

    #[test]
    fn whoever_was_pushed_in_and_left_may_not_come_back() {
        let mut table = Table::four_legged_playing(60);
        table.put(HOME_1, INSIDE);
        table.shoving = vec![(AWAY_1, HOME_1)];
        table.run(1.0);
        table.shoving.clear();
        table.put(HOME_1, Vec2::new(-1.5, 0.3));
        table.run(0.6);
        table.put(HOME_1, INSIDE);
        table.run(0.1);
        assert_eq!(removals(&table), [HOME_1]);
    }

    #[test]
    fn whoever_comes_in_in_a_moment_without_contact_was_pushed_in_all_the_same() {
        for (pause, removed) in [(0.3, vec![]), (0.7, vec![HOME_1])] {
            let mut table = Table::four_legged_playing(60);
            table.put(HOME_1, INSIDE + Vec2::X * 0.3);
            table.shoving = vec![(AWAY_1, HOME_1)];
            table.run(0.5);
            table.shoving.clear();
            table.run(pause);
            table.put(HOME_1, INSIDE);
            table.run(0.5);
            assert_eq!(removals(&table), removed, "after {pause} s");
        }
    }

    #[test]
    fn in_the_second_half_the_other_area_is_the_own_one() {
        let mut table = Table::four_legged_playing(60);
        table.state.home_attacks = Attacking::West;
        table.put(HOME_1, INSIDE);
        table.run(1.0);
        assert_eq!(removals(&table), []);
        table.put(HOME_1, -INSIDE);
        table.run(0.1);
        assert_eq!(removals(&table), [HOME_1]);
    }

    #[test]
    fn before_the_ball_is_in_play_nobody_leaves() {
        let mut table = Table::four_legged(60);
        table.run(1.0);
        table.put(HOME_1, INSIDE);
        table.run(5.0);
        assert_eq!(removals(&table), []);
    }
}
