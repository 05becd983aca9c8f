//! Pushing a goalkeeper that is in its own penalty area, as the four-legged league had it.
//!
//! An attacker may be in contact with it for a second, or through a ball that both touch. A second attacker in contact at the
//! same time leaves at once. Contacts with pauses shorter than themselves are one contact. A goal that the attackers score
//! in the moment of such a foul does not count; one that is scored before the second is over does.

use bevy::prelude::Vec2;

use crate::ids::{RobotId, Team};
use crate::world::referee::decision::{Decision, RemovalReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::RuleBook;
use crate::world::referee::rules::observation::{Laws, Observation, is_in_own_area, is_over, send_off};
use crate::world::referee::state::{MatchState, Streak, streaks_after};

/// Takes off attackers that are in contact with a goalkeeper for too long, and the second one of two.
pub(super) fn goalie_pushing(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    if state.phase != Phase::Playing {
        return;
    }
    let contacts = contacts(laws, observation, state);
    let guilty = fouls(laws, &contacts, state);
    state.on_keeper = streaks(&contacts, state);
    for robot in guilty {
        let away = f64::from(laws.book.removal_seconds);
        send_off(state, decisions, robot, away, RemovalReason::GoaliePushing);
    }
}

/// Whether the rule will take a robot of this team off in this sample.
pub(super) fn is_keeper_pushed_by(
    team: Team,
    laws: &Laws,
    observation: &Observation,
    state: &MatchState,
) -> bool {
    fouls(laws, &contacts(laws, observation, state), state).iter().any(|robot| robot.team == team)
}

/// An attacker in contact with a goalkeeper.
struct KeeperContact {
    attacker: RobotId,
    /// Bodies touch, and not only through the ball.
    direct: bool,
}

/// All such contacts, by attacker.
fn contacts(laws: &Laws, observation: &Observation, state: &MatchState) -> Vec<KeeperContact> {
    let mut contacts = Vec::new();
    let nobody_touches = observation.contacts.is_empty() && observation.touching.is_empty();
    if nobody_touches || laws.book.pushing.and_then(|rule| rule.goalie).is_none() {
        return contacts;
    }
    for (attacker, _) in observation.on_field(state) {
        let keeper = RobotId::new(attacker.team.opponent(), RuleBook::KEEPER);
        let is_home = |at: Vec2| is_in_own_area(laws, state, keeper, at);
        if !observation.place(keeper, state).is_some_and(is_home) {
            continue;
        }
        let direct = observation.touch(attacker, keeper);
        let at_ball = |robot: RobotId| observation.touching.contains(&robot);
        let through_ball = at_ball(attacker) && at_ball(keeper) && !observation.still.contains(&attacker);
        if direct || through_ball {
            contacts.push(KeeperContact { attacker, direct });
        }
    }
    contacts
}

fn streaks(contacts: &[KeeperContact], state: &MatchState) -> Vec<(RobotId, Streak)> {
    let attackers: Vec<RobotId> = contacts.iter().map(|contact| contact.attacker).collect();
    streaks_after(&state.on_keeper, state.played, &attackers)
}

/// The attackers at fault in this sample.
fn fouls(laws: &Laws, contacts: &[KeeperContact], state: &MatchState) -> Vec<RobotId> {
    let Some(rule) = laws.book.pushing.and_then(|rule| rule.goalie) else { return Vec::new() };
    let streaks = streaks(contacts, state);
    let seconds = |robot: RobotId| {
        streaks.iter().find(|(other, _)| *other == robot).map_or(0.0, |(_, streak)| streak.seconds)
    };
    let is_second = |contact: &KeeperContact| {
        contact.direct
            && contacts.iter().any(|other| {
                let earlier = seconds(other.attacker).total_cmp(&seconds(contact.attacker)).reverse();
                other.direct
                    && other.attacker.team == contact.attacker.team
                    && earlier.then(other.attacker.cmp(&contact.attacker)).is_lt()
            })
    };
    let guilty = contacts.iter().filter(|c| is_over(seconds(c.attacker), rule.seconds) || is_second(c));
    guilty.map(|contact| contact.attacker).collect()
}

#[cfg(test)]
mod tests {
    use crate::world::referee::decision::{NoGoalReason, PlacementReason};
    use crate::world::referee::rules::table::Table;

    use super::*;

    const AWAY_0: RobotId = RobotId::new(Team::Away, 0);
    const HOME_1: RobotId = RobotId::new(Team::Home, 1);
    const HOME_2: RobotId = RobotId::new(Team::Home, 2);
    const AT_HOME: Vec2 = Vec2::new(2.4, 0.0);
    const VOID: Decision = Decision::NoGoal { by: Team::Home, reason: NoGoalReason::GoaliePushed };

    fn removals(table: &Table) -> Vec<RobotId> {
        table.removals(RemovalReason::GoaliePushing)
    }

    /// Away's goalkeeper in its area, with home 1 before it and home 2 beside it. No kick-off shot is at stake.
    fn before_goal(hertz: u32) -> Table {
        let mut table = Table::four_legged_playing(hertz);
        table.put(AWAY_0, AT_HOME);
        table.put(HOME_1, AT_HOME - Vec2::X * 0.3);
        table.put(HOME_2, AT_HOME + Vec2::Y * 0.2);
        table.ball = AT_HOME - Vec2::X * 0.5;
        table.restart_in_play();
        table.log.clear();
        table
    }

    #[test]
    fn a_second_of_contact_with_the_goalkeeper_is_too_long_at_every_step_size() {
        for hertz in [20, 60, 240] {
            let sample = 1.0 / f64::from(hertz);
            let mut table = before_goal(hertz);
            table.contacts = vec![(AWAY_0, HOME_1)];
            table.run(1.0);
            assert_eq!(removals(&table), []);
            table.run(sample);
            assert_eq!(removals(&table), [HOME_1]);
            assert_eq!(table.state.removed[0].seconds_left, 30.0);
        }
    }

    #[test]
    fn pushing_through_the_ball_counts_and_standing_before_it_does_not() {
        for (still, removed) in [(vec![], vec![HOME_1]), (vec![HOME_1], vec![])] {
            let mut table = before_goal(60);
            table.touching = vec![HOME_1, AWAY_0];
            table.still = still;
            table.run(1.2);
            assert_eq!(removals(&table), removed);
        }
    }

    #[test]
    fn the_second_attacker_leaves_at_once_and_the_first_has_its_second() {
        let mut table = before_goal(60);
        table.contacts = vec![(AWAY_0, HOME_2)];
        table.run(0.5);
        table.contacts.push((AWAY_0, HOME_1));
        table.run(1.0 / 60.0);
        assert_eq!(removals(&table), [HOME_1]);
        table.contacts.pop();
        table.run(0.4);
        assert_eq!(removals(&table), [HOME_1]);
        table.run(0.2);
        assert_eq!(removals(&table), [HOME_1, HOME_2]);
    }

    #[test]
    fn of_two_attackers_that_come_together_the_higher_number_leaves() {
        let mut table = before_goal(60);
        table.contacts = vec![(HOME_2, AWAY_0), (HOME_1, AWAY_0)];
        table.run(1.0 / 60.0);
        assert_eq!(removals(&table), [HOME_2]);
    }

    #[test]
    fn short_contacts_add_up_unless_the_attacker_backs_off_as_long() {
        for (pause, removed) in [(0.3, vec![HOME_1]), (0.8, vec![])] {
            let mut table = before_goal(60);
            for _ in 0..4 {
                table.contacts = vec![(AWAY_0, HOME_1)];
                table.run(0.4);
                table.contacts.clear();
                table.run(pause);
            }
            assert_eq!(removals(&table), removed, "pauses of {pause} s");
        }
    }

    #[test]
    fn a_goalkeeper_outside_of_its_area_team_mates_and_field_players_are_not_protected() {
        let mut table = before_goal(60);
        table.put(AWAY_0, Vec2::new(1.5, 0.0));
        table.contacts = vec![(AWAY_0, HOME_1), (AWAY_0, HOME_2)];
        table.run(3.0);
        let mut other = before_goal(60);
        other.contacts = vec![(AWAY_0, RobotId::new(Team::Away, 2)), (RobotId::new(Team::Away, 1), HOME_1)];
        other.run(3.0);
        assert_eq!((removals(&table), removals(&other)), (vec![], vec![]));
    }

    #[test]
    fn the_rule_is_off_where_the_book_says_so() {
        let mut table = before_goal(60);
        table.book.pushing.as_mut().expect("it has the rule").goalie = None;
        table.contacts = vec![(AWAY_0, HOME_1), (AWAY_0, HOME_2)];
        table.run(5.0);
        assert_eq!(removals(&table), []);
    }

    /// The league's first two examples: the pusher itself, or another robot, shoots after the second is over.
    #[test]
    fn a_goal_in_the_moment_of_the_foul_does_not_count_and_the_ball_goes_back() {
        for shooter in [HOME_1, HOME_2] {
            let mut table = before_goal(60);
            table.contacts = vec![(AWAY_0, HOME_1)];
            table.run(0.99);
            table.touching = vec![shooter];
            table.shoot_east();
            assert!(table.decisions().contains(&VOID), "{shooter}: {:?}", table.decisions());
            assert_eq!((table.state.score, table.state.phase), ([0, 0], Phase::Playing));
            assert_eq!(removals(&table), [HOME_1]);
            let goes_back = table.decisions().into_iter().any(|decision| match decision {
                Decision::BallPlaced { at, reason: PlacementReason::Foul } => {
                    at.distance(Vec2::new(2.6, 0.2)) < 1e-4
                }
                _ => false,
            });
            assert!(goes_back, "{:?}", table.decisions());
        }
    }

    #[test]
    fn a_goal_while_a_second_attacker_touches_the_goalkeeper_does_not_count() {
        let mut table = before_goal(60);
        table.contacts = vec![(AWAY_0, HOME_1)];
        table.ball = Vec2::new(2.6, 0.2);
        table.run(0.1);
        table.contacts.push((AWAY_0, HOME_2));
        table.ball.x = 2.9;
        table.run(1.0 / 60.0);
        assert!(table.decisions().contains(&VOID));
        assert_eq!((removals(&table), table.state.score), (vec![HOME_2], [0, 0]));
    }

    /// The league's third example.
    #[test]
    fn a_goal_before_the_second_is_over_counts() {
        let mut table = before_goal(60);
        table.contacts = vec![(AWAY_0, HOME_1)];
        table.run(0.8);
        table.shoot_east();
        assert_eq!((table.state.score, removals(&table)), ([1, 0], vec![]));
    }

    #[test]
    fn an_own_goal_counts_whoever_pushes_whom() {
        let mut table = before_goal(60);
        table.contacts = vec![(AWAY_0, HOME_1)];
        table.run(1.0);
        table.shoot_west();
        assert_eq!(table.state.score, [0, 1]);
    }
}
