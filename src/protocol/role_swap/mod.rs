//! Dynamic role assignment (Hammerheads, section VII): how a team changes its roles over a radio that loses, delays and
//! doubles messages.
//!
//! One robot, the initiator, asks the others for their locks (LOCK, ACKLOCK), tells each its new role (SWAP) and waits for
//! the acknowledgements (ACKSWAP). Two versions share these four messages: [`Paper`], as figure 7 has it, and [`Hardened`],
//! which survives what the first does not. When to swap, and to what, is decided elsewhere.

use crate::ids::PlayerNumber;

mod assignment;
mod hardened;
mod paper;

use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

pub use assignment::{Assignment, Configuration, Reassignment};
pub use hardened::{Hardened, Ingredient};
pub use paper::{OnMissingAck, Paper, PaperRules, Unlock, WhileInitiating};

/// A role, as an index into the strategy's roles.
pub type RoleIndex = u8;
/// Identifies an initiator's attempt: a sequence number in the paper, an epoch in the hardened version.
pub type Sequence = u32;
/// Robots by their numbers, in order.
pub type Numbers = SmallVec<[PlayerNumber; 8]>;
/// What a step asks for, in order.
pub type Effects = SmallVec<[Effect; 4]>;

/// The four messages of the protocol.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Message {
    /// Asks for the receiver's lock.
    Lock { sequence: Sequence },
    /// Grants it, and tells what the sender holds.
    AckLock { sequence: Sequence, holds: Holding },
    /// Reassigns the receiver.
    Swap { sequence: Sequence, order: Order },
    /// Acknowledges the reassignment.
    AckSwap { sequence: Sequence },
}

impl Message {
    /// The attempt that the message belongs to.
    pub fn sequence(&self) -> Sequence {
        match self {
            Message::Lock { sequence }
            | Message::AckLock { sequence, .. }
            | Message::Swap { sequence, .. }
            | Message::AckSwap { sequence } => *sequence,
        }
    }
}

/// What a robot that grants its lock holds.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Holding {
    /// Its role: the paper's version needs it to roll back.
    Role(RoleIndex),
    /// Its configuration: the hardened version.
    Configuration(Configuration),
}

/// What a SWAP tells its receiver.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Order {
    /// Its new role: the paper's version.
    Role(RoleIndex),
    /// The whole team's new roles, to be staged: the hardened version.
    Assignment(Assignment),
}

/// What happens to a robot's side of the protocol.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Input {
    /// The robot has decided that roles should be swapped, with these others taking part.
    Initiate {
        reassignment: Reassignment,
        participants: Numbers,
    },
    Receive {
        from: PlayerNumber,
        message: Message,
    },
    /// A position message told a team mate's configuration.
    Heard(Configuration),
    TimeOut(Timer),
}

/// What a step asks its surroundings to do.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Effect {
    Send {
        to: PlayerNumber,
        message: Message,
    },
    /// Restarts the timer.
    Start(Timer),
    Stop(Timer),
    /// Sends a position message at once, for it carries the new configuration.
    Announce,
    /// The attempt that this robot initiated is over.
    Finished(Outcome),
}

/// The timers of a robot; the surroundings know how long they run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Timer {
    /// Runs while the robot is locked by another.
    Lock,
    /// Runs while the robot, as the initiator, waits for locks.
    Locks,
    /// Runs while the initiator waits for the acknowledgements of its reassignments.
    Acks,
}

/// How an attempt ended, as its initiator sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Outcome {
    Completed,
    /// Not everybody's lock came in time.
    LocksMissing,
    /// Not every acknowledgement came in time.
    AcksMissing,
    /// A newer configuration was heard of meanwhile.
    Overtaken,
}

/// Whose attempt a robot is locked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Lock {
    pub by: PlayerNumber,
    pub sequence: Sequence,
}

/// What a robot does as an initiator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Phase {
    Idle,
    WaitingForLocks { sequence: Sequence },
    WaitingForAcks { sequence: Sequence },
}

/// A robot's side of the protocol, in the version that its strategy chose.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RoleSwap {
    Paper(Paper),
    Hardened(Hardened),
}

impl RoleSwap {
    /// Takes one step. Anything that does not fit the present state is ignored.
    pub fn step(&mut self, input: Input) -> Effects {
        match self {
            RoleSwap::Paper(machine) => machine.step(input),
            RoleSwap::Hardened(machine) => machine.step(input),
        }
    }

    /// The role that the robot plays now.
    pub fn role(&self) -> RoleIndex {
        match self {
            RoleSwap::Paper(machine) => machine.role(),
            RoleSwap::Hardened(machine) => machine.role(),
        }
    }

    /// The lock that another robot holds on this one.
    pub fn lock(&self) -> Option<Lock> {
        match self {
            RoleSwap::Paper(machine) => machine.lock(),
            RoleSwap::Hardened(machine) => machine.lock(),
        }
    }

    pub fn phase(&self) -> Phase {
        match self {
            RoleSwap::Paper(machine) => machine.phase(),
            RoleSwap::Hardened(machine) => machine.phase(),
        }
    }

    /// The robots whose answer this robot, as an initiator, still waits for.
    pub fn awaited(&self) -> &[PlayerNumber] {
        match self {
            RoleSwap::Paper(machine) => machine.awaited(),
            RoleSwap::Hardened(machine) => machine.awaited(),
        }
    }

    /// What the robot's position messages should carry.
    pub fn configuration(&self) -> Option<&Configuration> {
        match self {
            RoleSwap::Paper(_) => None,
            RoleSwap::Hardened(machine) => Some(machine.configuration()),
        }
    }

    /// Switches the robot off and on again. With its memory kept it knows its role and its counters; locks and attempts
    /// are gone in any case. With its memory lost it is as new.
    pub fn restart(&mut self, memory_kept: bool) {
        match self {
            RoleSwap::Paper(machine) => machine.restart(memory_kept),
            RoleSwap::Hardened(machine) => machine.restart(memory_kept),
        }
    }
}

/// The robots that an initiator asks: those named that its team has, each once and without itself.
fn participants(named: &[PlayerNumber], me: PlayerNumber, all: &Assignment) -> Numbers {
    let mut others: Numbers =
        named.iter().copied().filter(|robot| *robot != me && all.of(*robot).is_some()).collect();
    others.sort_unstable();
    others.dedup();
    others
}
