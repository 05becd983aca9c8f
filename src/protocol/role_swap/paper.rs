//! The paper's version (figure 7): what a robot does that is asked for its lock, and what the initiator does.
//!
//! With a radio that loses nothing, no crash and no timer that runs out early, the team has a permutation of its roles
//! after each attempt. One loss, one late message or one crash can leave a role doubled for good, for nothing ever
//! compares the robots' roles again.

use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

use super::assignment::{Assignment, Reassignment, RoleIndex, Sequence};
use super::steps::{
    AttemptPhase, Effect, Effects, Holding, Input, Lock, Message, Numbers, Order, Outcome, Timer,
    participants,
};
use crate::ids::PlayerNumber;

/// What the paper leaves open. The defaults are what its authors implemented.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PaperRules {
    /// What an initiator does if an acknowledgement is missing.
    pub on_missing_ack: OnMissingAck,
    /// When a robot gives up its lock.
    pub unlock: Unlock,
    /// What an initiator does with another's LOCK.
    pub while_initiating: WhileInitiating,
}

/// What the initiator does when it misses an acknowledgement of its reassignments.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum OnMissingAck {
    /// Tells everybody its previous role, once.
    #[default]
    RollBack,
    /// Tells everybody its previous role, and repeats that to silent robots this many times, or for ever (`None`).
    #[expect(missing_docs, reason = "the sentence of the variant says what its fields are")]
    RollBackUntilAcknowledged { retries: Option<u8> },
    /// Repeats the reassignment to silent robots this many times, or for ever (`None`).
    #[expect(missing_docs, reason = "the sentence of the variant says what its fields are")]
    Resend { tries: Option<u8> },
}

/// When a robot that was locked and reassigned is unlocked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Unlock {
    /// When its timer runs out, as in figure 7.
    #[default]
    AtTimeout,
    /// When it has acknowledged, as in the text. No roll-back reaches it then.
    WhenAcknowledged,
}

/// What an initiator does with another's request for its lock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum WhileInitiating {
    /// It ignores the LOCK.
    #[default]
    Refuse,
    /// Shows why it must refuse: two attempts run into each other and double a role even over a perfect radio.
    Grant,
}

/// A robot's side of the protocol, as in the paper.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Paper {
    me: PlayerNumber,
    rules: PaperRules,
    at_start: Assignment,
    role: RoleIndex,
    sequence: Sequence,
    lock: Option<Lock>,
    attempt: PaperAttempt,
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum PaperAttempt {
    Idle,
    Locks { reassignment: Reassignment, others: Numbers, awaited: Numbers, current: Assignment },
    Acks { changes: SmallVec<[Change; 8]>, own: RoleIndex, awaited: Numbers, repeats: u8, rolls_back: bool },
}

/// What an attempt changes for another robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
struct Change {
    robot: PlayerNumber,
    from: RoleIndex,
    to: RoleIndex,
}

impl Paper {
    /// `all` are the roles of the whole team at the start.
    pub fn new(me: PlayerNumber, all: Assignment, rules: PaperRules) -> Paper {
        let role = all.of(me).unwrap_or_default();
        Paper { me, rules, at_start: all, role, sequence: 0, lock: None, attempt: PaperAttempt::Idle }
    }

    /// Takes an input and says what follows.
    pub fn step(&mut self, input: Input) -> Effects {
        match input {
            Input::Initiate { reassignment, participants } => self.initiate(reassignment, &participants),
            Input::Receive { from, message } if from != self.me && self.at_start.of(from).is_some() => {
                self.receive(from, message)
            }
            Input::TimeOut(timer) => self.time_out(timer),
            Input::Receive { .. } | Input::Heard(_) => Effects::new(),
        }
    }

    /// The robot's role.
    pub fn role(&self) -> RoleIndex {
        self.role
    }

    /// The lock that it has given, if any.
    pub fn lock(&self) -> Option<Lock> {
        self.lock
    }

    /// Where it stands in a swap of its own.
    pub fn phase(&self) -> AttemptPhase {
        let sequence = self.sequence;
        match self.attempt {
            PaperAttempt::Idle => AttemptPhase::Idle,
            PaperAttempt::Locks { .. } => AttemptPhase::WaitingForLocks { sequence },
            PaperAttempt::Acks { .. } => AttemptPhase::WaitingForAcks { sequence },
        }
    }

    /// The robots whose answer this robot, as an initiator, still waits for.
    pub fn awaited(&self) -> &[PlayerNumber] {
        match &self.attempt {
            PaperAttempt::Idle => &[],
            PaperAttempt::Locks { awaited, .. } | PaperAttempt::Acks { awaited, .. } => awaited,
        }
    }

    /// Whether the acknowledgements waited for are those of a roll-back.
    pub fn rolls_back(&self) -> bool {
        matches!(self.attempt, PaperAttempt::Acks { rolls_back: true, .. })
    }

    /// Memory kept: the role and the counter survive. Memory lost: as at the start.
    pub fn restart(&mut self, memory_kept: bool) {
        let before = (self.role, self.sequence);
        *self = Paper::new(self.me, self.at_start.clone(), self.rules);
        if memory_kept {
            (self.role, self.sequence) = before;
        }
    }

    fn initiate(&mut self, reassignment: Reassignment, named: &[PlayerNumber]) -> Effects {
        let mut effects = Effects::new();
        if self.lock.is_some() || self.attempt != PaperAttempt::Idle {
            return effects;
        }
        self.sequence = self.sequence.wrapping_add(1);
        let others = participants(named, self.me, &self.at_start);
        let message = Message::Lock { sequence: self.sequence };
        effects.extend(others.iter().map(|to| Effect::Send { to: *to, message: message.clone() }));
        let (awaited, current) = (others.clone(), self.at_start.clone());
        self.attempt = PaperAttempt::Locks { reassignment, others, awaited, current };
        if self.awaited().is_empty() {
            self.reassign(&mut effects);
        } else {
            effects.push(Effect::Start(Timer::Locks));
        }
        effects
    }

    fn receive(&mut self, from: PlayerNumber, message: Message) -> Effects {
        match message {
            Message::Lock { sequence } => self.grant(from, sequence),
            Message::AckLock { sequence, holds: Holding::Role(role) } if self.has_role(role) => {
                self.count_lock(from, sequence, role)
            }
            Message::Swap { sequence, order: Order::Role(role) } if self.has_role(role) => {
                self.obey(from, sequence, role)
            }
            Message::AckSwap { sequence } => self.count_ack(from, sequence),
            Message::AckLock { .. } | Message::Swap { .. } => Effects::new(),
        }
    }

    fn has_role(&self, role: RoleIndex) -> bool {
        self.at_start.roles().contains(&role)
    }

    fn grant(&mut self, by: PlayerNumber, sequence: Sequence) -> Effects {
        let busy =
            self.attempt != PaperAttempt::Idle && self.rules.while_initiating == WhileInitiating::Refuse;
        if busy || self.lock.is_some() {
            return Effects::new();
        }
        self.lock = Some(Lock { by, sequence });
        let message = Message::AckLock { sequence, holds: Holding::Role(self.role) };
        [Effect::Send { to: by, message }, Effect::Start(Timer::Lock)].into_iter().collect()
    }

    fn obey(&mut self, from: PlayerNumber, sequence: Sequence, role: RoleIndex) -> Effects {
        if self.lock != Some(Lock { by: from, sequence }) {
            return Effects::new();
        }
        self.role = role;
        let timer = match self.rules.unlock {
            Unlock::AtTimeout => Effect::Start(Timer::Lock),
            Unlock::WhenAcknowledged => {
                self.lock = None;
                Effect::Stop(Timer::Lock)
            }
        };
        [Effect::Send { to: from, message: Message::AckSwap { sequence } }, timer].into_iter().collect()
    }

    fn count_lock(&mut self, from: PlayerNumber, counted: Sequence, role: RoleIndex) -> Effects {
        let mut effects = Effects::new();
        if let PaperAttempt::Locks { awaited, current, .. } = &mut self.attempt
            && counted == self.sequence
            && awaited.contains(&from)
        {
            awaited.retain(|robot| *robot != from);
            current.set(from, role);
            if awaited.is_empty() {
                effects.push(Effect::Stop(Timer::Locks));
                self.reassign(&mut effects);
            }
        }
        effects
    }

    /// All locks are there.
    fn reassign(&mut self, effects: &mut Effects) {
        let PaperAttempt::Locks { reassignment, others, current, .. } = &mut self.attempt else { return };
        current.set(self.me, self.role);
        let target = reassignment.apply(current, &self.at_start);
        let own = target.of(self.me).unwrap_or(self.role);
        let change = |robot: &PlayerNumber| {
            Some(Change { robot: *robot, from: current.of(*robot)?, to: target.of(*robot)? })
        };
        let changes: SmallVec<[Change; 8]> = others.iter().filter_map(change).collect();
        let awaited = std::mem::take(others);
        self.attempt = PaperAttempt::Acks { changes, own, awaited, repeats: 0, rolls_back: false };
        if self.awaited().is_empty() {
            self.complete(own, effects);
        } else {
            self.send_orders(effects);
            effects.push(Effect::Start(Timer::Acks));
        }
    }

    fn complete(&mut self, role: RoleIndex, effects: &mut Effects) {
        self.role = role;
        self.attempt = PaperAttempt::Idle;
        effects.push(Effect::Finished(Outcome::Completed));
    }

    fn count_ack(&mut self, from: PlayerNumber, counted: Sequence) -> Effects {
        let mut effects = Effects::new();
        if let PaperAttempt::Acks { awaited, own, rolls_back, .. } = &mut self.attempt
            && counted == self.sequence
        {
            awaited.retain(|robot| *robot != from);
            if awaited.is_empty() {
                let (own, rolls_back) = (*own, *rolls_back);
                effects.push(Effect::Stop(Timer::Acks));
                if rolls_back {
                    self.give_up(Outcome::AcksMissing, &mut effects);
                } else {
                    self.complete(own, &mut effects);
                }
            }
        }
        effects
    }

    fn give_up(&mut self, outcome: Outcome, effects: &mut Effects) {
        self.attempt = PaperAttempt::Idle;
        effects.push(Effect::Finished(outcome));
    }

    fn time_out(&mut self, timer: Timer) -> Effects {
        let mut effects = Effects::new();
        match (timer, &self.attempt) {
            (Timer::Lock, _) => self.lock = None,
            (Timer::Locks, PaperAttempt::Locks { .. }) => self.give_up(Outcome::LocksMissing, &mut effects),
            (Timer::Acks, PaperAttempt::Acks { .. }) => self.miss_acks(&mut effects),
            _ => {}
        }
        effects
    }

    fn miss_acks(&mut self, effects: &mut Effects) {
        let PaperAttempt::Acks { changes, awaited, repeats, rolls_back, .. } = &mut self.attempt else {
            return;
        };
        let (sends, waits) = match (self.rules.on_missing_ack, *rolls_back) {
            (OnMissingAck::Resend { tries: limit }, _)
            | (OnMissingAck::RollBackUntilAcknowledged { retries: limit }, true) => {
                let more = once_more(repeats, limit);
                (more, more)
            }
            (rule, _) => {
                *rolls_back = true;
                *awaited = changes.iter().map(|change| change.robot).collect();
                (true, rule != OnMissingAck::RollBack)
            }
        };
        if sends {
            self.send_orders(effects);
        }
        if waits {
            effects.push(Effect::Start(Timer::Acks));
        } else {
            self.give_up(Outcome::AcksMissing, effects);
        }
    }

    /// A SWAP to each robot whose acknowledgement is awaited, there or back.
    fn send_orders(&self, effects: &mut Effects) {
        let PaperAttempt::Acks { changes, awaited, rolls_back, .. } = &self.attempt else { return };
        let sequence = self.sequence;
        effects.extend(changes.iter().filter(|change| awaited.contains(&change.robot)).map(|change| {
            let order = Order::Role(if *rolls_back { change.from } else { change.to });
            Effect::Send { to: change.robot, message: Message::Swap { sequence, order } }
        }));
    }
}

/// Counts a repetition, unless they are unlimited.
fn once_more(repeats: &mut u8, limit: Option<u8>) -> bool {
    let Some(limit) = limit else { return true };
    let more = *repeats < limit;
    *repeats = repeats.saturating_add(1);
    more
}

#[cfg(test)]
mod tests;
