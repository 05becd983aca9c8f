//! What the paper's version guarantees: all goes well while no message is lost, nobody crashes and no timer is early; and
//! its locks are sound even then, if it does not go on for ever.

use touchline::protocol::role_swap::{OnMissingAck, Unlock};

use super::checks::{Check, Fact, somebody_is_busy};
use super::network::Radio;
use super::team::{Afterwards, Crashes, Team};
use crate::support::explorer::Explored;

const GUARANTEED: [Check; 9] = [
    Check::FreeDiffer,
    Check::QuietDiffer,
    Check::OneSwapPhase,
    Check::Never(Fact::LateLockLocks),
    Check::Never(Fact::LateSwapObeyed),
    Check::Never(Fact::LockCountedInVain),
    Check::Never(Fact::WrongAckCounted),
    Check::Never(Fact::RollBackIgnored),
    Check::SometimesSwapped,
];

const ROLL_BACK: OnMissingAck = OnMissingAck::RollBack;
const ROLL_BACK_TWICE: OnMissingAck = OnMissingAck::RollBackUntilAcknowledged { retries: Some(1) };
const ROLL_BACK_FOR_EVER: OnMissingAck = OnMissingAck::RollBackUntilAcknowledged { retries: None };
const RESEND: OnMissingAck = OnMissingAck::Resend { tries: Some(1) };
const RESEND_FOR_EVER: OnMissingAck = OnMissingAck::Resend { tries: None };

const ALL: [OnMissingAck; 5] = [ROLL_BACK, ROLL_BACK_TWICE, ROLL_BACK_FOR_EVER, RESEND, RESEND_FOR_EVER];

/// So many attempts, each by any of the three.
fn attempts(count: usize, team: Team) -> Team {
    Team { attempts: vec![vec![0, 1, 2]; count], ..team }
}

#[test]
fn one_attempt_over_a_reliable_radio_swaps_roles() {
    for rule in ALL {
        attempts(1, Team::paper(rule, Unlock::AtTimeout)).holds(&GUARANTEED, 61);
        attempts(1, Team::paper(rule, Unlock::WhenAcknowledged)).holds(&GUARANTEED, 52);
    }
}

#[test]
fn two_attempts_over_a_reliable_radio_leave_each_role_to_one_robot() {
    for (unlock, unordered, ordered) in [(Unlock::AtTimeout, 745, 745), (Unlock::WhenAcknowledged, 788, 716)]
    {
        let team = || attempts(2, Team::paper(ROLL_BACK, unlock));
        team().holds(&GUARANTEED, unordered);
        Team { radio: Radio::RELIABLE.in_order(), ..team() }.holds(&GUARANTEED, ordered);
    }
}

#[test]
fn four_robots_are_served_as_well_as_three() {
    let team = attempts(2, Team::paper(ROLL_BACK, Unlock::AtTimeout));
    Team { robots: 4, ..team }.holds(&GUARANTEED, 4019);
}

/// Such timers never free a robot that the initiator still works on: they would have to know how long it will go on.
#[test]
fn to_go_on_for_ever_is_safe_only_while_no_timer_is_early_and_nobody_crashes() {
    for (rule, states) in [(ROLL_BACK_FOR_EVER, 257), (RESEND_FOR_EVER, 190)] {
        let team = attempts(1, Team::paper(rule, Unlock::AtTimeout));
        Team { radio: Radio::LOSSY, ..team }.holds(&[Check::FreeDiffer, Check::QuietDiffer], states);
    }
}

#[test]
fn locks_are_released_in_the_end() {
    for (rule, states) in [(ROLL_BACK, 2015), (ROLL_BACK_TWICE, 19203), (RESEND, 2535)] {
        let team = attempts(1, Team::paper(rule, Unlock::AtTimeout)).any_timers();
        let graph = Explored::of(&Team { radio: Radio::LOSSY, ..team });
        assert!(graph.stuck(|state| !somebody_is_busy(state)).is_empty());
        assert_eq!(graph.states.len(), states);
    }
}

#[test]
fn locks_are_released_in_the_end_although_a_robot_crashed() {
    let crashes = Crashes::any(1, Afterwards::StaysDown);
    let graph = Explored::of(&Team { crashes, ..attempts(1, Team::paper(ROLL_BACK, Unlock::AtTimeout)) });
    assert!(graph.stuck(|state| !somebody_is_busy(state)).is_empty());
    assert_eq!(graph.states.len(), 541);
}

#[test]
fn only_one_robot_is_in_the_swap_phase_whatever_the_timers_do() {
    for (unlock, states) in [(Unlock::AtTimeout, 67226), (Unlock::WhenAcknowledged, 29527)] {
        let team = attempts(2, Team::paper(ROLL_BACK, unlock)).any_timers();
        Team { radio: Radio::RELIABLE.in_order(), ..team }.holds(&[Check::OneSwapPhase], states);
    }
}
