//! The hardened version: the same four messages, but what counts is the configuration, the whole team's roles with the
//! epoch and the initiator that committed them. Each robot tells its own in its position messages and adopts a greater
//! one wherever it hears it, so that lost, late or doubled messages and crashes can delay agreement but not prevent it.
//!
//! A SWAP only stages roles; they take effect with the configuration. A robot refuses attempts older than the newest it
//! has seen. There is no roll-back: an attempt that fails leaves nothing to undo.

use serde::{Deserialize, Serialize};

use super::assignment::{Assignment, Configuration, Reassignment, RoleIndex, Sequence};
use super::steps::{
    AttemptPhase, Effect, Effects, Holding, Input, Lock, Message, Numbers, Order, Outcome, Timer,
    participants,
};
use crate::ids::PlayerNumber;

/// Something in the design that an experiment leaves out, to show what it is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Ingredient {
    /// The assignment as the last key in the order of configurations. A robot that lost its memory may use an epoch twice;
    /// without the key the two assignments then both stay.
    AssignmentAsLastKey,
    /// Staging. Without it a SWAP takes effect at once and a failed attempt commits the previous roles again: roles flap, and
    /// configurations come about out of order.
    Staging,
}

/// A robot's side of the protocol, hardened.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Hardened {
    me: PlayerNumber,
    all: Assignment,
    without: Option<Ingredient>,
    configuration: Configuration,
    /// The newest attempt this robot knows of.
    seen: Id,
    held: Option<Held>,
    attempt: Attempt,
}

/// Identifies an attempt, and the configuration that it commits.
type Id = (Sequence, PlayerNumber);

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
struct Held {
    lock: Lock,
    staged: Option<Assignment>,
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Attempt {
    Idle,
    Locks { sequence: Sequence, reassignment: Reassignment, others: Numbers, awaited: Numbers },
    Acks { sequence: Sequence, assignment: Assignment, awaited: Numbers },
}

impl Hardened {
    /// `all` are the roles of the whole team at the start: the configuration of epoch 0.
    pub fn new(me: PlayerNumber, all: Assignment) -> Hardened {
        let configuration = Configuration { epoch: 0, initiator: 0, assignment: all.clone() };
        let (seen, attempt) = (identity(&configuration), Attempt::Idle);
        Hardened { me, all, without: None, configuration, seen, held: None, attempt }
    }

    /// For experiments that show what an ingredient is for.
    pub fn without(me: PlayerNumber, all: Assignment, ingredient: Ingredient) -> Hardened {
        Hardened { without: Some(ingredient), ..Hardened::new(me, all) }
    }

    /// Takes an input and says what follows.
    pub fn step(&mut self, input: Input) -> Effects {
        let mut effects = Effects::new();
        match input {
            Input::Initiate { reassignment, participants } => {
                self.initiate(reassignment, &participants, &mut effects);
            }
            Input::Receive { from, message } if from != self.me && self.all.of(from).is_some() => {
                self.receive(from, message, &mut effects);
            }
            Input::Receive { .. } => {}
            Input::Heard(configuration) => self.adopt(configuration, &mut effects),
            Input::TimeOut(timer) => self.time_out(timer, &mut effects),
        }
        effects
    }

    /// The robot's role.
    pub fn role(&self) -> RoleIndex {
        self.configuration.assignment.of(self.me).unwrap_or_default()
    }

    /// The lock that it has given, if any.
    pub fn lock(&self) -> Option<Lock> {
        self.held.as_ref().map(|held| held.lock)
    }

    /// The assignment that will hold if the attempt this robot is locked for succeeds.
    pub fn staged(&self) -> Option<&Assignment> {
        self.held.as_ref()?.staged.as_ref()
    }

    /// The newest configuration that it knows.
    pub fn configuration(&self) -> &Configuration {
        &self.configuration
    }

    /// Where it stands in a swap of its own.
    pub fn phase(&self) -> AttemptPhase {
        match self.attempt {
            Attempt::Idle => AttemptPhase::Idle,
            Attempt::Locks { sequence, .. } => AttemptPhase::WaitingForLocks { sequence },
            Attempt::Acks { sequence, .. } => AttemptPhase::WaitingForAcks { sequence },
        }
    }

    /// The robots whose answer this robot, as an initiator, still waits for.
    pub fn awaited(&self) -> &[PlayerNumber] {
        match &self.attempt {
            Attempt::Idle => &[],
            Attempt::Locks { awaited, .. } | Attempt::Acks { awaited, .. } => awaited,
        }
    }

    /// Memory kept: the configuration and the newest attempt seen survive. Memory lost: as at the start.
    pub fn restart(&mut self, memory_kept: bool) {
        let new = Hardened { without: self.without, ..Hardened::new(self.me, self.all.clone()) };
        let before = std::mem::replace(self, new);
        if memory_kept {
            (self.configuration, self.seen) = (before.configuration, before.seen);
        }
    }

    fn initiate(&mut self, reassignment: Reassignment, named: &[PlayerNumber], effects: &mut Effects) {
        let target = reassignment.apply(&self.configuration.assignment, &self.all);
        let newest = self.seen.0.max(self.configuration.epoch);
        let Some(sequence) = newest.checked_add(1) else { return };
        if self.held.is_some() || self.attempt != Attempt::Idle || !target.has_roles_of(&self.all) {
            return;
        }
        self.seen = (sequence, self.me);
        let others = participants(named, self.me, &self.all);
        if others.is_empty() {
            return self.commit(sequence, target, Outcome::Completed, effects);
        }
        effects.extend(others.iter().map(|to| Effect::Send { to: *to, message: Message::Lock { sequence } }));
        effects.push(Effect::Start(Timer::Locks));
        self.attempt = Attempt::Locks { sequence, reassignment, awaited: others.clone(), others };
    }

    fn receive(&mut self, from: PlayerNumber, message: Message, effects: &mut Effects) {
        match message {
            Message::Lock { sequence } => self.grant(from, sequence, effects),
            Message::AckLock { sequence, holds: Holding::Configuration(configuration) } => {
                self.adopt(configuration, effects);
                self.count_lock(from, sequence, effects);
            }
            Message::Swap { sequence, order: Order::Assignment(assignment) } => {
                self.stage(from, sequence, assignment, effects);
            }
            Message::AckSwap { sequence } => self.count_ack(from, sequence, effects),
            Message::AckLock { .. } | Message::Swap { .. } => {}
        }
    }

    fn grant(&mut self, by: PlayerNumber, sequence: Sequence, effects: &mut Effects) {
        let id = (sequence, by);
        let newer = id > self.seen && id > identity(&self.configuration);
        self.seen = self.seen.max(id);
        if newer && self.held.is_none() && self.attempt == Attempt::Idle {
            self.held = Some(Held { lock: Lock { by, sequence }, staged: None });
            let holds = Holding::Configuration(self.configuration.clone());
            effects.push(Effect::Send { to: by, message: Message::AckLock { sequence, holds } });
            effects.push(Effect::Start(Timer::Lock));
        }
    }

    fn stage(
        &mut self,
        from: PlayerNumber,
        sequence: Sequence,
        assignment: Assignment,
        effects: &mut Effects,
    ) {
        let Some(held) = &mut self.held else { return };
        if held.lock != (Lock { by: from, sequence }) || !assignment.has_roles_of(&self.all) {
            return;
        }
        effects.push(Effect::Send { to: from, message: Message::AckSwap { sequence } });
        if self.without == Some(Ingredient::Staging) {
            self.adopt(Configuration { epoch: sequence, initiator: from, assignment }, effects);
        } else {
            held.staged = Some(assignment);
            effects.push(Effect::Start(Timer::Lock));
        }
    }

    fn count_lock(&mut self, from: PlayerNumber, counted: Sequence, effects: &mut Effects) {
        let Attempt::Locks { sequence, reassignment, others, awaited } = &mut self.attempt else { return };
        if *sequence != counted || !awaited.contains(&from) {
            return;
        }
        awaited.retain(|robot| *robot != from);
        if !awaited.is_empty() {
            return;
        }
        let assignment = reassignment.apply(&self.configuration.assignment, &self.all);
        let awaited = std::mem::take(others);
        effects.push(Effect::Stop(Timer::Locks));
        effects.extend(awaited.iter().map(|to| {
            let order = Order::Assignment(assignment.clone());
            Effect::Send { to: *to, message: Message::Swap { sequence: counted, order } }
        }));
        effects.push(Effect::Start(Timer::Acks));
        self.attempt = Attempt::Acks { sequence: counted, assignment, awaited };
    }

    fn count_ack(&mut self, from: PlayerNumber, counted: Sequence, effects: &mut Effects) {
        let Attempt::Acks { sequence, assignment, awaited } = &mut self.attempt else { return };
        if *sequence != counted {
            return;
        }
        awaited.retain(|robot| *robot != from);
        if awaited.is_empty() {
            let assignment = assignment.clone();
            effects.push(Effect::Stop(Timer::Acks));
            self.commit(counted, assignment, Outcome::Completed, effects);
        }
    }

    fn commit(&mut self, epoch: Sequence, assignment: Assignment, outcome: Outcome, effects: &mut Effects) {
        self.configuration = Configuration { epoch, initiator: self.me, assignment };
        self.seen = self.seen.max((epoch, self.me));
        self.attempt = Attempt::Idle;
        effects.extend([Effect::Announce, Effect::Finished(outcome)]);
    }

    fn adopt(&mut self, heard: Configuration, effects: &mut Effects) {
        let sound = heard.assignment.has_roles_of(&self.all) && self.all.of(heard.initiator).is_some();
        if !sound || !self.is_newer(&heard) {
            return;
        }
        let id = identity(&heard);
        self.configuration = heard;
        self.seen = self.seen.max(id);
        if self.lock().is_some_and(|lock| (lock.sequence, lock.by) <= id) {
            self.held = None;
            effects.push(Effect::Stop(Timer::Lock));
        }
        let (sequence, timer) = match self.attempt {
            Attempt::Idle => return,
            Attempt::Locks { sequence, .. } => (sequence, Timer::Locks),
            Attempt::Acks { sequence, .. } => (sequence, Timer::Acks),
        };
        if (sequence, self.me) <= id {
            self.attempt = Attempt::Idle;
            effects.extend([Effect::Stop(timer), Effect::Finished(Outcome::Overtaken)]);
        }
    }

    fn is_newer(&self, heard: &Configuration) -> bool {
        if self.without == Some(Ingredient::AssignmentAsLastKey) {
            identity(heard) > identity(&self.configuration)
        } else {
            *heard > self.configuration
        }
    }

    fn time_out(&mut self, timer: Timer, effects: &mut Effects) {
        match (timer, &self.attempt) {
            (Timer::Lock, _) => self.held = None,
            (Timer::Locks, Attempt::Locks { .. }) => {
                self.attempt = Attempt::Idle;
                effects.push(Effect::Finished(Outcome::LocksMissing));
            }
            (Timer::Acks, Attempt::Acks { .. }) => self.miss_acks(effects),
            _ => {}
        }
    }

    fn miss_acks(&mut self, effects: &mut Effects) {
        self.attempt = Attempt::Idle;
        let newest = self.seen.0.max(self.configuration.epoch);
        match newest.checked_add(1) {
            Some(epoch) if self.without == Some(Ingredient::Staging) => {
                let previous = self.configuration.assignment.clone();
                self.commit(epoch, previous, Outcome::AcksMissing, effects);
            }
            _ => effects.push(Effect::Finished(Outcome::AcksMissing)),
        }
    }
}

fn identity(configuration: &Configuration) -> Id {
    (configuration.epoch, configuration.initiator)
}

#[cfg(test)]
mod tests;
