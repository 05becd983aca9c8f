//! The hardened version, whatever the radio, the timers and the robots do: once attempts and crashes stop and position
//! messages get through, all live robots have one configuration, different roles and no locks.

use super::checks::{Check, Fact, agree};
use super::network::Radio;
use super::story::Story;
use super::team::{Afterwards, Asked, Crashes, FLOATER, HALFBACK, Team, Wanted};
use crate::support::explorer::Explored;

const CONVERGES: [Check; 5] = [
    Check::Permutations,
    Check::SettledAgree,
    Check::Never(Fact::RoleChangedOtherwise),
    Check::Never(Fact::WentBack),
    Check::SometimesSwapped,
];
const ORDERED: [Check; 3] =
    [Check::OneSwapPhase, Check::Never(Fact::CommittedOutOfOrder), Check::Never(Fact::UpdateLost)];

fn with(more: &[Check]) -> Vec<Check> {
    [&CONVERGES, more].concat()
}

fn ordered() -> Vec<Check> {
    with(&ORDERED)
}

fn ordered_and_free_differ() -> Vec<Check> {
    [ordered(), vec![Check::FreeDiffer]].concat()
}

fn crashing(at_most: u8, afterwards: Afterwards) -> Team {
    Team { crashes: Crashes::any(at_most, afterwards), ..Team::hardened(2) }
}

#[test]
fn two_attempts_with_good_timers_never_leave_free_robots_in_one_role() {
    Team::hardened(2).holds(&ordered_and_free_differ(), 3195);
}

#[test]
fn two_attempts_with_any_timers_converge() {
    Team::hardened(2).any_timers().holds(&ordered(), 64073);
}

#[test]
fn until_the_news_of_a_commit_arrives_two_robots_share_a_role() {
    let story = Story::of(Team::hardened(1), Check::AllDiffer, 9);
    assert_eq!(story.roles(), [HALFBACK, FLOATER, HALFBACK]);
}

#[test]
fn a_lease_that_is_early_doubles_a_role_for_a_while() {
    let story = Story::of(Team::hardened(1).any_timers(), Check::FreeDiffer, 10);
    assert_eq!(story.roles(), [HALFBACK, FLOATER, HALFBACK]);
}

#[test]
fn an_agreed_team_can_always_be_reached() {
    let graph = Explored::of(&Team::hardened(1).any_timers());
    assert_eq!(graph.states.len(), 682);
    assert!(graph.stuck(agree).is_empty());
}

#[test]
fn doubled_messages_change_nothing() {
    Team { radio: Radio::LOSSY.doubling(2), ..Team::hardened(2) }.holds(&ordered_and_free_differ(), 166000);
}

#[test]
fn the_living_agree_after_a_crash() {
    crashing(1, Afterwards::StaysDown).holds(&ordered(), 12793);
}

#[test]
fn a_robot_that_restarts_with_its_memory_does_no_harm() {
    crashing(1, Afterwards::Restarts { memory_kept: true }).any_timers().holds(&ordered(), 212084);
}

#[test]
fn a_robot_that_lost_its_memory_learns_the_configuration_again() {
    let team = crashing(1, Afterwards::Restarts { memory_kept: false }).any_timers();
    team.holds(&with(&[Check::OneSwapPhase]), 332552);
}

#[test]
fn wrong_participants_cost_an_update_but_not_the_agreement() {
    let team = || Team { asked: Asked::Anybody, ..Team::hardened(2) };
    team().holds(&CONVERGES, 8901);
    Story::of(team(), Check::Never(Fact::UpdateLost), 2);
}

#[test]
fn four_robots_converge_too() {
    Team { robots: 4, ..Team::hardened(1) }.any_timers().holds(&ordered(), 5410);
    Team { robots: 4, ..Team::hardened(2) }.holds(&ordered_and_free_differ(), 33205);
}

#[test]
fn four_robots_with_wrong_participants_converge_although_two_swap_at_once() {
    let team = || Team { robots: 4, asked: Asked::Anybody, ..Team::hardened(2) };
    team().holds(&CONVERGES, 159349);
    Story::of(team(), Check::OneSwapPhase, 6);
}

#[test]
fn any_roles_may_be_wanted() {
    Team { wanted: Wanted::Any, ..Team::hardened(2) }.holds(&ordered_and_free_differ(), 60540);
}

#[test]
#[ignore = "deep"]
fn any_roles_may_be_wanted_with_any_timers() {
    Team { wanted: Wanted::Any, ..Team::hardened(2) }.any_timers().holds(&ordered(), 1063063);
}

#[test]
#[ignore = "deep"]
fn three_attempts_with_any_timers_converge() {
    Team::hardened(3).any_timers().holds(&ordered(), 4184088);
}

#[test]
#[ignore = "deep"]
fn doubled_messages_change_nothing_with_any_timers() {
    Team { radio: Radio::LOSSY.doubling(2), ..Team::hardened(2) }.any_timers().holds(&ordered(), 2890883);
}

#[test]
#[ignore = "deep"]
fn two_losses_of_memory_are_borne() {
    let team = crashing(2, Afterwards::Restarts { memory_kept: false }).any_timers();
    team.holds(&with(&[Check::OneSwapPhase]), 832052);
}
