//! What breaks the paper's version: for each misfortune the shortest way to it. Every test prints its story.

use touchline::protocol::role_swap::{OnMissingAck, PaperRules, Unlock, WhileInitiating};

use super::checks::{Check, Fact, somebody_is_busy};
use super::network::{Loss, Radio};
use super::story::Story;
use super::team::{Afterwards, Crashes, FLOATER, FORWARD, HALFBACK, Team, Timing, Version};
use crate::support::explorer::Explored;

const ROLL_BACK: OnMissingAck = OnMissingAck::RollBack;

fn resend(tries: u8) -> OnMissingAck {
    OnMissingAck::Resend { tries: Some(tries) }
}

fn losing(losses: u8, team: Team) -> Team {
    Team { radio: Radio::losing(losses), ..team }
}

fn initiator_crashing(afterwards: Afterwards, unlock: Unlock) -> Team {
    let crashes = Crashes { at_most: 1, of: vec![0], afterwards };
    Team { crashes, ..Team::paper(ROLL_BACK, unlock) }
}

#[test]
fn during_every_swap_two_robots_share_a_role() {
    let story = Story::of(Team::paper(ROLL_BACK, Unlock::AtTimeout), Check::AllDiffer, 6);
    assert_eq!(story.roles(), [HALFBACK, FLOATER, FLOATER]);
}

#[test]
fn one_lost_acknowledgement_doubles_a_role_if_robots_unlock_at_once() {
    let radio = Radio { loss: Loss::AcknowledgementsAtMost(1), ..Radio::RELIABLE };
    let team = Team { radio, ..Team::paper(ROLL_BACK, Unlock::WhenAcknowledged) };
    let story = Story::of(team, Check::QuietDiffer, 12);
    assert_eq!(story.roles(), [HALFBACK, HALFBACK, FLOATER]);
    assert!(story.tells("the radio loses ACKSWAP #1 from R2 to R0"));
    assert!(story.tells("the roll-back SWAP #1 (floater) from R0 reaches R1, which ignores it"));
    assert!(story.tells("the roll-back SWAP #1 (forward) from R0 reaches R2, which ignores it"));
}

#[test]
fn two_losses_double_a_role_although_robots_stay_locked() {
    let team = |losses| losing(losses, Team::paper(ROLL_BACK, Unlock::AtTimeout));
    team(1).holds(&[Check::FreeDiffer, Check::QuietDiffer], 80);
    let story = Story::of(team(2), Check::QuietDiffer, 14);
    assert_eq!(story.roles(), [HALFBACK, FLOATER, FLOATER]);
    assert!(story.tells("the radio loses SWAP #1 (halfback) from R0 to R1"));
    assert!(story.tells("the radio loses the roll-back SWAP #1 (forward) from R0 to R2"));
}

#[test]
fn each_repetition_bears_one_loss_more_and_never_all() {
    for (tries, states, steps) in [(1, 59, 13), (2, 100, 15)] {
        let team = |losses| losing(losses, Team::paper(resend(tries), Unlock::AtTimeout));
        team(tries).holds(&[Check::QuietDiffer], states);
        let story = Story::of(team(tries + 1), Check::QuietDiffer, steps);
        assert_eq!(story.roles(), [HALFBACK, FLOATER, FLOATER]);
        assert_eq!(story.end.losses, tries + 1);
    }
}

#[test]
fn sending_again_for_ever_keeps_the_initiator_busy_for_ever() {
    let team = Team::paper(OnMissingAck::Resend { tries: None }, Unlock::AtTimeout).any_timers();
    let graph = Explored::of(&team);
    let stuck = graph.stuck(|state| !somebody_is_busy(state));
    let story = Story::told(&graph.path_to(stuck[0]));
    assert_eq!(story.len(), 6);
    assert!(story.tells("R1's lock timer runs out: R1 is unlocked"));
}

#[test]
fn a_lock_timer_that_is_early_doubles_a_role() {
    let team = Team { radio: Radio::RELIABLE.in_order(), ..Team::paper(ROLL_BACK, Unlock::AtTimeout) };
    let story = Story::of(team.any_timers(), Check::QuietDiffer, 13);
    assert_eq!(story.roles(), [HALFBACK, FLOATER, FLOATER]);
    assert!(story.tells("the roll-back SWAP #1 (forward) from R0 reaches R2, which ignores it"));
}

#[test]
fn a_roll_back_that_overtakes_its_swap_doubles_a_role() {
    let team = Team::paper(ROLL_BACK, Unlock::AtTimeout);
    let story = Story::of(Team { initiators_timers: Timing::Any, ..team }, Check::QuietDiffer, 16);
    assert_eq!(story.roles(), [HALFBACK, HALFBACK, FLOATER]);
    let told = |words: &str| story.sentences.iter().position(|sentence| sentence.starts_with(words));
    let swap = told("SWAP #1 (floater) from R0 reaches R2");
    assert!(swap.is_some() && told("the roll-back SWAP #1 (forward) from R0 reaches R2") < swap);
}

#[test]
fn late_copies_of_an_attempt_that_went_well_undo_the_next() {
    let team =
        Team { radio: Radio::RELIABLE.doubling(2), ..Team::paper(ROLL_BACK, Unlock::WhenAcknowledged) };
    let team = Team { attempts: vec![vec![0]; 2], ..team };
    let story = Story::of(team, Check::QuietDiffer, 22);
    assert_eq!(story.roles(), [FLOATER, HALFBACK, HALFBACK]);
    assert!(story.tells("LOCK #1 from R0 reaches R1 (and will come again)"));
    assert!(story.tells("SWAP #1 (halfback) from R0 reaches R1 (and will come again)"));
}

#[test]
fn an_initiator_that_crashes_between_its_swaps_leaves_a_role_doubled() {
    let team = initiator_crashing(Afterwards::StaysDown, Unlock::AtTimeout);
    let story = Story::of(team, Check::QuietDiffer, 10);
    assert_eq!(story.roles()[1..], [FLOATER, FLOATER]);
    assert!(story.tells("R0 crashes, SWAP #1 (halfback) to R1 unsent"));
}

#[test]
fn an_initiator_that_restarts_knows_nothing_of_its_attempt() {
    let team = initiator_crashing(Afterwards::Restarts { memory_kept: true }, Unlock::AtTimeout);
    let story = Story::of(team, Check::QuietDiffer, 11);
    assert_eq!(story.roles(), [HALFBACK, FLOATER, FLOATER]);
    assert!(story.tells("R0 is back as halfback"));
}

/// Directed: the full state space has millions of states.
#[test]
fn an_initiator_that_lost_its_memory_counts_locks_of_its_former_life() {
    let team = initiator_crashing(Afterwards::Restarts { memory_kept: false }, Unlock::WhenAcknowledged);
    let team = Team { attempts: vec![vec![0], vec![1], vec![0]], ..team }.any_timers();
    let story = Story::of(team, Check::OneSwapPhase, 16);
    assert!(story.tells("ACKLOCK #1 from R1 reaches R0: R0 counts it"));
}

#[test]
fn acknowledgements_of_the_swap_pass_for_those_of_the_roll_back() {
    let rule = OnMissingAck::RollBackUntilAcknowledged { retries: None };
    let radio = Radio { ordered: true, ..Radio::losing(1) };
    let team = Team { radio, initiators_timers: Timing::Any, ..Team::paper(rule, Unlock::AtTimeout) };
    let story = Story::of(team, Check::QuietDiffer, 15);
    assert_eq!(story.roles(), [HALFBACK, HALFBACK, FORWARD]);
    assert!(story.tells("the radio loses the roll-back SWAP #1 (floater) from R0 to R1"));
    assert!(story.tells("ACKSWAP #1 from R1 reaches R0: R0 counts it"));
}

#[test]
fn an_initiator_that_grants_locks_doubles_a_role_over_a_perfect_radio() {
    let rules = PaperRules { while_initiating: WhileInitiating::Grant, ..PaperRules::default() };
    let team = Team { attempts: vec![vec![0, 1, 2]; 2], ..Team::new(Version::Paper(rules)) };
    let story = Story::of(team, Check::QuietDiffer, 22);
    assert_eq!(story.roles(), [HALFBACK, FORWARD, HALFBACK]);
}

#[test]
fn late_messages_do_their_harm_without_any_loss() {
    let once_more = OnMissingAck::RollBackUntilAcknowledged { retries: Some(1) };
    for (fact, rule, steps) in [
        (Fact::LateLockLocks, ROLL_BACK, 3),
        (Fact::LockCountedInVain, ROLL_BACK, 4),
        (Fact::LateSwapObeyed, ROLL_BACK, 7),
        (Fact::WrongAckCounted, once_more, 8),
        (Fact::RollBackIgnored, ROLL_BACK, 9),
    ] {
        Story::of(Team::paper(rule, Unlock::AtTimeout).any_timers(), Check::Never(fact), steps);
    }
}
