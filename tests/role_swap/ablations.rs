//! What each ingredient of the hardened version is for: without it the checker finds what goes wrong.

use touchline::protocol::role_swap::Ingredient;

use super::checks::{Check, Fact};
use super::story::Story;
use super::team::{Afterwards, Asked, Crashes, FLOATER, FORWARD, HALFBACK, Team, Version, Wanted};

fn without(ingredient: Option<Ingredient>, attempts: usize) -> Team {
    Team { version: Version::Hardened(ingredient), ..Team::hardened(attempts) }
}

#[test]
fn without_configurations_in_position_messages_roles_stay_doubled() {
    let team = Team { news: false, ..Team::hardened(1) };
    let story = Story::of(team, Check::SettledAgree, 11);
    assert_eq!(story.roles(), [HALFBACK, FLOATER, HALFBACK]);
}

/// Robot 0 may commit alone, lose its memory and commit again.
fn forgetful(ingredient: Option<Ingredient>) -> Team {
    let afterwards = Afterwards::Restarts { memory_kept: false };
    Team {
        attempts: vec![vec![0]; 2],
        asked: Asked::Anybody,
        wanted: Wanted::Any,
        crashes: Crashes { at_most: 1, of: vec![0], afterwards },
        ..without(ingredient, 2)
    }
}

#[test]
fn without_the_assignment_in_the_order_a_robot_that_forgot_its_epoch_splits_the_team() {
    let team = forgetful(Some(Ingredient::AssignmentAsLastKey));
    let story = Story::of(team, Check::SettledAgree, 6);
    assert_eq!(story.roles(), [FORWARD, HALFBACK, HALFBACK]);
    forgetful(None).holds(&[Check::SettledAgree, Check::SometimesSwapped], 130303);
}

#[test]
fn without_staging_the_team_agrees_in_the_end_but_roles_flap_and_commits_lose_their_order() {
    let team = || without(Some(Ingredient::Staging), 2);
    team().any_timers().holds(&[Check::Permutations, Check::SettledAgree, Check::SometimesSwapped], 200936);
    Story::of(team(), Check::FreeDiffer, 9);
    let story = Story::of(team().any_timers(), Check::Never(Fact::CommittedOutOfOrder), 7);
    assert!(story.tells("R2's timer for the acknowledgements runs out"));
}
