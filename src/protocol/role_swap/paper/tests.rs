//! The state tables of the paper's version, a row or a group of rows each.

use smallvec::smallvec;

use super::super::Configuration;
use super::*;

const HALFBACK: RoleIndex = 0;
const FLOATER: RoleIndex = 1;
const FORWARD: RoleIndex = 2;

fn robot(me: PlayerNumber, on_missing_ack: OnMissingAck) -> Paper {
    let rules = PaperRules { on_missing_ack, ..PaperRules::default() };
    Paper::new(me, Assignment::new(0..3), rules)
}

fn receive(from: PlayerNumber, message: Message) -> Input {
    Input::Receive { from, message }
}

fn send(to: PlayerNumber, message: Message) -> Effect {
    Effect::Send { to, message }
}

fn lock(sequence: Sequence) -> Message {
    Message::Lock { sequence }
}

fn ack_lock(sequence: Sequence, role: RoleIndex) -> Message {
    Message::AckLock { sequence, holds: Holding::Role(role) }
}

fn swap(sequence: Sequence, role: RoleIndex) -> Message {
    Message::Swap { sequence, order: Order::Role(role) }
}

fn ack_swap(sequence: Sequence) -> Message {
    Message::AckSwap { sequence }
}

/// The halfback becomes the forward, the forward the floater and the floater the halfback.
fn rotation() -> Input {
    let pairs = smallvec![(HALFBACK, FORWARD), (FORWARD, FLOATER), (FLOATER, HALFBACK)];
    Input::Initiate { reassignment: Reassignment::Roles(pairs), participants: smallvec![2, 1] }
}

fn effects(effects: impl IntoIterator<Item = Effect>) -> Effects {
    effects.into_iter().collect()
}

/// Robot 0, waiting for the acknowledgements of its first attempt.
fn waiting_for_acks(rule: OnMissingAck) -> Paper {
    let mut initiator = robot(0, rule);
    initiator.step(rotation());
    initiator.step(receive(1, ack_lock(1, FLOATER)));
    initiator.step(receive(2, ack_lock(1, FORWARD)));
    initiator
}

/// Robot 1, locked for the first attempt of robot 0.
fn locked() -> Paper {
    let mut receiver = robot(1, OnMissingAck::RollBack);
    receiver.step(receive(0, lock(1)));
    receiver
}

#[test]
fn a_free_robot_grants_its_lock_and_tells_its_role() {
    let mut receiver = robot(1, OnMissingAck::RollBack);
    let asked = receiver.step(receive(0, lock(7)));
    assert_eq!(asked, effects([send(0, ack_lock(7, FLOATER)), Effect::Start(Timer::Lock)]));
    assert_eq!(receiver.lock(), Some(Lock { by: 0, sequence: 7 }));
}

#[test]
fn a_free_robot_ignores_everything_but_a_lock() {
    let mut receiver = robot(1, OnMissingAck::RollBack);
    for message in [ack_lock(0, FORWARD), swap(0, FORWARD), ack_swap(0)] {
        assert!(receiver.step(receive(0, message)).is_empty());
    }
    assert_eq!(receiver, robot(1, OnMissingAck::RollBack));
}

#[test]
fn a_locked_robot_obeys_the_robot_that_locked_it_and_stays_locked() {
    let mut receiver = locked();
    let told = receiver.step(receive(0, swap(1, HALFBACK)));
    assert_eq!(told, effects([send(0, ack_swap(1)), Effect::Start(Timer::Lock)]));
    assert_eq!(receiver.role(), HALFBACK);
    assert!(receiver.lock().is_some());
    receiver.step(receive(0, swap(1, FLOATER)));
    assert_eq!(receiver.role(), FLOATER);
}

#[test]
fn a_robot_may_unlock_when_it_has_acknowledged() {
    let rules = PaperRules { unlock: Unlock::WhenAcknowledged, ..PaperRules::default() };
    let mut receiver = Paper::new(1, Assignment::new(0..3), rules);
    receiver.step(receive(0, lock(1)));
    let told = receiver.step(receive(0, swap(1, HALFBACK)));
    assert_eq!(told, effects([send(0, ack_swap(1)), Effect::Stop(Timer::Lock)]));
    assert_eq!(receiver.lock(), None);
}

#[test]
fn a_locked_robot_ignores_other_robots_and_other_attempts() {
    for (from, message) in [(2, swap(1, HALFBACK)), (0, swap(2, HALFBACK)), (2, lock(1)), (0, lock(2))] {
        let mut receiver = locked();
        assert!(receiver.step(receive(from, message)).is_empty());
        assert_eq!(receiver, locked());
    }
}

#[test]
fn a_lock_ends_with_its_timer() {
    let mut receiver = locked();
    assert!(receiver.step(Input::TimeOut(Timer::Lock)).is_empty());
    assert_eq!(receiver.lock(), None);
}

#[test]
fn an_initiator_asks_everybody_named_for_locks() {
    let mut initiator = robot(0, OnMissingAck::RollBack);
    let asks = initiator.step(rotation());
    assert_eq!(asks, effects([send(1, lock(1)), send(2, lock(1)), Effect::Start(Timer::Locks)]));
    assert_eq!(initiator.phase(), AttemptPhase::WaitingForLocks { sequence: 1 });
    assert_eq!(initiator.awaited(), [1, 2]);
}

#[test]
fn neither_a_locked_robot_nor_an_initiator_begins_an_attempt() {
    for busy in [locked(), waiting_for_acks(OnMissingAck::RollBack)] {
        let mut robot = busy.clone();
        assert!(robot.step(rotation()).is_empty());
        assert_eq!(robot, busy);
    }
}

#[test]
fn an_initiator_refuses_its_lock_unless_told_otherwise() {
    let mut initiator = waiting_for_acks(OnMissingAck::RollBack);
    assert!(initiator.step(receive(1, lock(1))).is_empty());
    let rules = PaperRules { while_initiating: WhileInitiating::Grant, ..PaperRules::default() };
    let mut granting = Paper::new(0, Assignment::new(0..3), rules);
    granting.step(rotation());
    granting.step(receive(1, lock(1)));
    assert!(granting.lock().is_some());
}

#[test]
fn with_all_locks_the_initiator_tells_each_its_new_role() {
    let mut initiator = robot(0, OnMissingAck::RollBack);
    initiator.step(rotation());
    for (from, sequence) in [(1, 1), (1, 1), (2, 9)] {
        assert!(initiator.step(receive(from, ack_lock(sequence, from))).is_empty());
    }
    let tells = initiator.step(receive(2, ack_lock(1, FORWARD)));
    let orders = [send(1, swap(1, HALFBACK)), send(2, swap(1, FLOATER))];
    assert_eq!(tells[0], Effect::Stop(Timer::Locks));
    assert_eq!(tells[1..3], orders);
    assert_eq!(tells[3..], [Effect::Start(Timer::Acks)]);
    assert_eq!(initiator.role(), HALFBACK);
}

#[test]
fn with_all_acknowledgements_the_initiator_changes_its_own_role() {
    let mut initiator = waiting_for_acks(OnMissingAck::RollBack);
    assert!(initiator.step(receive(1, ack_swap(1))).is_empty());
    assert!(initiator.step(receive(1, ack_swap(1))).is_empty());
    let done = initiator.step(receive(2, ack_swap(1)));
    assert_eq!(done, effects([Effect::Stop(Timer::Acks), Effect::Finished(Outcome::Completed)]));
    assert_eq!((initiator.role(), initiator.phase()), (FORWARD, AttemptPhase::Idle));
}

#[test]
fn without_all_locks_in_time_nothing_is_sent() {
    let mut initiator = robot(0, OnMissingAck::RollBack);
    initiator.step(rotation());
    let gives_up = initiator.step(Input::TimeOut(Timer::Locks));
    assert_eq!(gives_up, effects([Effect::Finished(Outcome::LocksMissing)]));
    initiator.step(rotation());
    assert_eq!(initiator.phase(), AttemptPhase::WaitingForLocks { sequence: 2 });
}

#[test]
fn a_roll_back_tells_everybody_its_previous_role_once() {
    let mut initiator = waiting_for_acks(OnMissingAck::RollBack);
    initiator.step(receive(1, ack_swap(1)));
    let rolls_back = initiator.step(Input::TimeOut(Timer::Acks));
    let orders = [send(1, swap(1, FLOATER)), send(2, swap(1, FORWARD))];
    let over = Effect::Finished(Outcome::AcksMissing);
    assert_eq!(rolls_back, effects(orders.into_iter().chain([over])));
    assert_eq!((initiator.role(), initiator.phase()), (HALFBACK, AttemptPhase::Idle));
}

#[test]
fn a_roll_back_may_be_repeated_to_the_silent() {
    let mut initiator = waiting_for_acks(OnMissingAck::RollBackUntilAcknowledged { retries: Some(1) });
    let orders = [send(1, swap(1, FLOATER)), send(2, swap(1, FORWARD))];
    let first = initiator.step(Input::TimeOut(Timer::Acks));
    assert_eq!(first, effects(orders.into_iter().chain([Effect::Start(Timer::Acks)])));
    assert!(initiator.rolls_back());
    initiator.step(receive(1, ack_swap(1)));
    let second = initiator.step(Input::TimeOut(Timer::Acks));
    assert_eq!(second, effects([send(2, swap(1, FORWARD)), Effect::Start(Timer::Acks)]));
    let mut given_up = initiator.clone();
    let over = Effect::Finished(Outcome::AcksMissing);
    assert_eq!(given_up.step(Input::TimeOut(Timer::Acks)), effects([over.clone()]));
    let acknowledged = initiator.step(receive(2, ack_swap(1)));
    assert_eq!(acknowledged, effects([Effect::Stop(Timer::Acks), over]));
    assert_eq!(initiator.role(), HALFBACK);
}

#[test]
fn a_reassignment_may_be_sent_again_to_the_silent() {
    let mut initiator = waiting_for_acks(OnMissingAck::Resend { tries: Some(1) });
    initiator.step(receive(1, ack_swap(1)));
    let again = initiator.step(Input::TimeOut(Timer::Acks));
    assert_eq!(again, effects([send(2, swap(1, FLOATER)), Effect::Start(Timer::Acks)]));
    let gives_up = initiator.step(Input::TimeOut(Timer::Acks));
    assert_eq!(gives_up, effects([Effect::Finished(Outcome::AcksMissing)]));
}

#[test]
fn for_ever_means_for_ever_and_the_state_stays_the_same() {
    let mut initiator = waiting_for_acks(OnMissingAck::Resend { tries: None });
    let before = initiator.clone();
    for _ in 0..300 {
        assert_eq!(initiator.step(Input::TimeOut(Timer::Acks)).len(), 3);
    }
    assert_eq!(initiator, before);
}

#[test]
fn an_initiator_alone_changes_its_role_at_once() {
    let mut initiator = robot(0, OnMissingAck::RollBack);
    let pairs = smallvec![(HALFBACK, FORWARD)];
    let participants = smallvec![0, 9];
    let alone = Input::Initiate { reassignment: Reassignment::Roles(pairs), participants };
    assert_eq!(initiator.step(alone), effects([Effect::Finished(Outcome::Completed)]));
    assert_eq!(initiator.role(), FORWARD);
}

#[test]
fn strangers_and_messages_that_make_no_sense_are_ignored() {
    let configuration = Configuration { epoch: 9, initiator: 2, assignment: Assignment::new(0..3) };
    let nonsense = [
        receive(3, lock(1)),
        receive(1, lock(1)),
        receive(0, swap(1, 9)),
        receive(0, Message::Swap { sequence: 1, order: Order::Assignment(Assignment::new([])) }),
        receive(0, Message::AckLock { sequence: 1, holds: Holding::Configuration(configuration.clone()) }),
        Input::Heard(configuration),
        Input::TimeOut(Timer::Acks),
    ];
    for input in nonsense {
        let mut receiver = locked();
        assert!(receiver.step(input).is_empty());
        assert_eq!(receiver, locked());
    }
}

#[test]
fn a_restart_ends_locks_and_attempts_and_keeps_what_memory_keeps() {
    let mut receiver = locked();
    receiver.step(receive(0, swap(1, HALFBACK)));
    receiver.restart(true);
    assert_eq!((receiver.role(), receiver.lock()), (HALFBACK, None));
    receiver.restart(false);
    assert_eq!(receiver, robot(1, OnMissingAck::RollBack));
    let mut initiator = waiting_for_acks(OnMissingAck::RollBack);
    initiator.restart(true);
    initiator.step(rotation());
    assert_eq!(initiator.phase(), AttemptPhase::WaitingForLocks { sequence: 2 });
}

#[test]
fn a_strategy_file_names_the_choices() {
    let twice = OnMissingAck::RollBackUntilAcknowledged { retries: Some(2) };
    let for_ever = OnMissingAck::Resend { tries: None };
    for (text, on_missing_ack, unlock) in [
        ("()", OnMissingAck::RollBack, Unlock::AtTimeout),
        ("(on_missing_ack: RollBackUntilAcknowledged(retries: Some(2)))", twice, Unlock::AtTimeout),
        (
            "(on_missing_ack: Resend(tries: None), unlock: WhenAcknowledged)",
            for_ever,
            Unlock::WhenAcknowledged,
        ),
    ] {
        let rules = PaperRules { on_missing_ack, unlock, ..PaperRules::default() };
        assert_eq!(ron::from_str(text), Ok(rules));
    }
    assert!(ron::from_str::<PaperRules>("(on_missing_ack: Resend(tries: None, pause: 1))").is_err());
}
