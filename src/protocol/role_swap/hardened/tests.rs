//! The state table of the hardened version, a row or a group of rows each.

use smallvec::smallvec;

use super::*;

fn team() -> Assignment {
    Assignment::new(0..3)
}

fn robot(me: PlayerNumber) -> Hardened {
    Hardened::new(me, team())
}

fn assignment(roles: [RoleIndex; 3]) -> Assignment {
    Assignment::new(roles)
}

fn configuration(epoch: Sequence, initiator: PlayerNumber, roles: [RoleIndex; 3]) -> Configuration {
    Configuration { epoch, initiator, assignment: assignment(roles) }
}

fn receive(from: PlayerNumber, message: Message) -> Input {
    Input::Receive { from, message }
}

fn lock(sequence: Sequence) -> Message {
    Message::Lock { sequence }
}

fn ack_lock(sequence: Sequence, held: Configuration) -> Message {
    Message::AckLock { sequence, holds: Holding::Configuration(held) }
}

fn swap(sequence: Sequence, roles: [RoleIndex; 3]) -> Message {
    Message::Swap { sequence, order: Order::Assignment(assignment(roles)) }
}

fn ack_swap(sequence: Sequence) -> Message {
    Message::AckSwap { sequence }
}

fn send(to: PlayerNumber, message: Message) -> Effect {
    Effect::Send { to, message }
}

fn effects(effects: impl IntoIterator<Item = Effect>) -> Effects {
    effects.into_iter().collect()
}

const START: [RoleIndex; 3] = [0, 1, 2];
const ROTATED: [RoleIndex; 3] = [2, 0, 1];

fn rotation(participants: &[PlayerNumber]) -> Input {
    let pairs = smallvec![(0, 2), (2, 1), (1, 0)];
    Input::Initiate { reassignment: Reassignment::Roles(pairs), participants: participants.into() }
}

/// Robot 1, locked for attempt 1 of robot 0.
fn locked() -> Hardened {
    let mut receiver = robot(1);
    receiver.step(receive(0, lock(1)));
    receiver
}

/// Robot 0, waiting for the acknowledgements of its attempt 1.
fn waiting_for_acks() -> Hardened {
    let mut initiator = robot(0);
    initiator.step(rotation(&[1, 2]));
    for other in [1, 2] {
        initiator.step(receive(other, ack_lock(1, configuration(0, 0, START))));
    }
    initiator
}

#[test]
fn an_attempt_takes_the_epoch_after_the_newest_seen() {
    let mut initiator = robot(0);
    initiator.step(receive(1, lock(4)));
    initiator.step(Input::TimeOut(Timer::Lock));
    let asks = initiator.step(rotation(&[1, 2]));
    assert_eq!(asks, effects([send(1, lock(5)), send(2, lock(5)), Effect::Start(Timer::Locks)]));
    assert_eq!(initiator.phase(), AttemptPhase::WaitingForLocks { sequence: 5 });
}

#[test]
fn a_busy_robot_begins_no_attempt() {
    for busy in [locked(), waiting_for_acks()] {
        let mut robot = busy.clone();
        assert!(robot.step(rotation(&[0, 1, 2])).is_empty());
        assert_eq!(robot, busy);
    }
}

#[test]
fn a_free_robot_grants_its_lock_and_tells_its_configuration() {
    let mut receiver = robot(1);
    let grants = receiver.step(receive(0, lock(1)));
    let held = configuration(0, 0, START);
    assert_eq!(grants, effects([send(0, ack_lock(1, held)), Effect::Start(Timer::Lock)]));
    assert_eq!(receiver.lock(), Some(Lock { by: 0, sequence: 1 }));
}

#[test]
fn an_attempt_older_than_the_newest_seen_is_refused() {
    let mut receiver = locked();
    receiver.step(Input::TimeOut(Timer::Lock));
    assert!(receiver.step(receive(0, lock(1))).is_empty());
    assert!(!receiver.step(receive(2, lock(1))).is_empty());
}

#[test]
fn a_refused_attempt_still_counts_as_seen() {
    let mut receiver = locked();
    assert!(receiver.step(receive(2, lock(7))).is_empty());
    assert_eq!(receiver.lock(), Some(Lock { by: 0, sequence: 1 }));
    receiver.step(Input::TimeOut(Timer::Lock));
    receiver.step(rotation(&[0, 2]));
    assert_eq!(receiver.phase(), AttemptPhase::WaitingForLocks { sequence: 8 });
}

#[test]
fn an_initiator_refuses_its_lock_but_remembers_the_attempt() {
    let mut initiator = waiting_for_acks();
    assert!(initiator.step(receive(1, lock(5))).is_empty());
    assert_eq!((initiator.lock(), initiator.phase()), (None, AttemptPhase::WaitingForAcks { sequence: 1 }));
    initiator.step(Input::TimeOut(Timer::Acks));
    initiator.step(rotation(&[1, 2]));
    assert_eq!(initiator.phase(), AttemptPhase::WaitingForLocks { sequence: 6 });
}

#[test]
fn a_swap_is_staged_and_changes_no_role() {
    let mut receiver = locked();
    let stages = receiver.step(receive(0, swap(1, ROTATED)));
    assert_eq!(stages, effects([send(0, ack_swap(1)), Effect::Start(Timer::Lock)]));
    assert_eq!((receiver.role(), receiver.staged()), (1, Some(&assignment(ROTATED))));
}

#[test]
fn a_lease_that_runs_out_forgets_what_was_staged() {
    let mut receiver = locked();
    receiver.step(receive(0, swap(1, ROTATED)));
    assert!(receiver.step(Input::TimeOut(Timer::Lock)).is_empty());
    assert_eq!((receiver.lock(), receiver.staged(), receiver.role()), (None, None, 1));
}

#[test]
fn swaps_that_do_not_match_the_lock_are_ignored() {
    for (from, message) in [(2, swap(1, ROTATED)), (0, swap(2, ROTATED)), (0, ack_swap(1))] {
        let mut receiver = locked();
        assert!(receiver.step(receive(from, message)).is_empty());
        assert_eq!(receiver, locked());
    }
}

#[test]
fn a_greater_configuration_is_adopted_and_drops_an_older_lock() {
    let mut receiver = locked();
    receiver.step(receive(0, swap(1, ROTATED)));
    let adopts = receiver.step(Input::Heard(configuration(1, 0, ROTATED)));
    assert_eq!(adopts, effects([Effect::Stop(Timer::Lock)]));
    assert_eq!((receiver.role(), receiver.lock()), (0, None));
    assert!(receiver.step(receive(0, lock(1))).is_empty());
}

#[test]
fn a_configuration_older_than_the_lock_is_adopted_and_the_lock_stays() {
    let mut receiver = robot(1);
    receiver.step(receive(0, lock(5)));
    assert!(receiver.step(Input::Heard(configuration(3, 2, ROTATED))).is_empty());
    assert_eq!(receiver.role(), 0);
    assert!(receiver.lock().is_some());
}

#[test]
fn a_smaller_configuration_is_ignored() {
    let mut receiver = robot(1);
    receiver.step(Input::Heard(configuration(2, 1, ROTATED)));
    let before = receiver.clone();
    for older in [configuration(1, 2, START), configuration(2, 0, START), configuration(2, 1, START)] {
        assert!(receiver.step(Input::Heard(older)).is_empty());
    }
    assert_eq!(receiver, before);
}

#[test]
fn a_newer_configuration_ends_an_attempt() {
    let mut initiator = waiting_for_acks();
    let ends = initiator.step(Input::Heard(configuration(1, 2, ROTATED)));
    assert_eq!(ends, effects([Effect::Stop(Timer::Acks), Effect::Finished(Outcome::Overtaken)]));
    assert_eq!(initiator.phase(), AttemptPhase::Idle);
}

#[test]
fn with_all_locks_the_new_roles_follow_from_the_newest_configuration() {
    let mut initiator = robot(0);
    initiator.step(receive(2, lock(3)));
    initiator.step(Input::TimeOut(Timer::Lock));
    initiator.step(rotation(&[1, 2]));
    assert!(initiator.step(receive(1, ack_lock(4, configuration(3, 2, ROTATED)))).is_empty());
    let tells = initiator.step(receive(2, ack_lock(4, configuration(0, 0, START))));
    let orders = [send(1, swap(4, [1, 2, 0])), send(2, swap(4, [1, 2, 0]))];
    assert_eq!(tells[0], Effect::Stop(Timer::Locks));
    assert_eq!(tells[1..3], orders);
    assert_eq!(tells[3..], [Effect::Start(Timer::Acks)]);
}

#[test]
fn a_late_grant_is_not_counted_but_its_configuration_is() {
    let mut initiator = robot(0);
    initiator.step(receive(1, ack_lock(9, configuration(2, 1, ROTATED))));
    assert_eq!((initiator.role(), initiator.phase()), (2, AttemptPhase::Idle));
}

#[test]
fn with_all_acknowledgements_the_initiator_commits_and_announces() {
    let mut initiator = waiting_for_acks();
    assert!(initiator.step(receive(1, ack_swap(1))).is_empty());
    assert!(initiator.step(receive(1, ack_swap(1))).is_empty());
    let commits = initiator.step(receive(2, ack_swap(1)));
    let over = Effect::Finished(Outcome::Completed);
    assert_eq!(commits, effects([Effect::Stop(Timer::Acks), Effect::Announce, over]));
    assert_eq!(*initiator.configuration(), configuration(1, 0, ROTATED));
}

#[test]
fn an_attempt_that_fails_leaves_nothing_to_undo() {
    let mut initiator = waiting_for_acks();
    let fails = initiator.step(Input::TimeOut(Timer::Acks));
    assert_eq!(fails, effects([Effect::Finished(Outcome::AcksMissing)]));
    initiator.step(rotation(&[1]));
    let fails = initiator.step(Input::TimeOut(Timer::Locks));
    assert_eq!(fails, effects([Effect::Finished(Outcome::LocksMissing)]));
    assert_eq!(*initiator.configuration(), configuration(0, 0, START));
}

#[test]
fn an_initiator_alone_commits_at_once() {
    let mut initiator = robot(0);
    let commits = initiator.step(rotation(&[]));
    assert_eq!(commits, effects([Effect::Announce, Effect::Finished(Outcome::Completed)]));
    assert_eq!(*initiator.configuration(), configuration(1, 0, ROTATED));
}

#[test]
fn strangers_and_assignments_that_are_no_permutation_are_ignored() {
    let short = Assignment::new([0, 1]);
    let nonsense = [
        receive(3, lock(9)),
        receive(1, lock(9)),
        receive(0, swap(1, [0, 0, 2])),
        receive(0, Message::Swap { sequence: 1, order: Order::Assignment(short.clone()) }),
        receive(0, Message::Swap { sequence: 1, order: Order::Role(2) }),
        receive(0, ack_lock(1, configuration(9, 0, [1, 1, 2]))),
        Input::Heard(configuration(9, 7, ROTATED)),
        Input::Heard(Configuration { epoch: 9, initiator: 0, assignment: short }),
    ];
    for input in nonsense {
        let mut receiver = locked();
        assert!(receiver.step(input).is_empty());
        assert_eq!(receiver, locked());
    }
}

#[test]
fn after_the_last_epoch_there_are_no_attempts() {
    let mut initiator = robot(0);
    initiator.step(Input::Heard(configuration(Sequence::MAX, 1, ROTATED)));
    assert!(initiator.step(rotation(&[1, 2])).is_empty());
}

#[test]
fn a_restart_keeps_the_configuration_and_what_was_seen_or_loses_both() {
    let mut receiver = locked();
    receiver.step(Input::Heard(configuration(3, 2, ROTATED)));
    receiver.step(receive(0, lock(4)));
    receiver.restart(true);
    assert_eq!((receiver.role(), receiver.lock()), (0, None));
    assert!(receiver.step(receive(0, lock(4))).is_empty());
    receiver.restart(false);
    assert_eq!(receiver, robot(1));
}

#[test]
fn without_staging_a_swap_takes_effect_and_a_failure_commits_the_previous_roles() {
    let mut receiver = Hardened::without(1, team(), Ingredient::Staging);
    receiver.step(receive(0, lock(1)));
    receiver.step(receive(0, swap(1, ROTATED)));
    assert_eq!(receiver.role(), 0);
    let mut initiator = Hardened::without(0, team(), Ingredient::Staging);
    initiator.step(rotation(&[1]));
    initiator.step(receive(1, ack_lock(1, configuration(0, 0, START))));
    let fails = initiator.step(Input::TimeOut(Timer::Acks));
    assert_eq!(fails, effects([Effect::Announce, Effect::Finished(Outcome::AcksMissing)]));
    assert_eq!(*initiator.configuration(), configuration(2, 0, START));
}
