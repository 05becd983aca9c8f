//! The words of the protocol: its messages, and what goes into a step of a machine and comes out of it.

use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

use super::assignment::{Assignment, Configuration, Reassignment, RoleIndex, Sequence};
use crate::ids::PlayerNumber;

/// Robots by their numbers, in order.
pub type Numbers = SmallVec<[PlayerNumber; 8]>;

/// What a step asks for, in order.
pub type Effects = SmallVec<[Effect; 4]>;

/// The four messages of the protocol.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
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
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Input {
    /// The robot has decided that roles should be swapped, with these others taking part.
    Initiate { reassignment: Reassignment, participants: Numbers },
    /// A message has arrived.
    Receive { from: PlayerNumber, message: Message },
    /// A position message told a team mate's configuration.
    Heard(Configuration),
    /// A timer has run out.
    TimeOut(Timer),
}

/// What a step asks its surroundings to do.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Effect {
    /// Send a message.
    Send { to: PlayerNumber, message: Message },
    /// Restarts the timer.
    Start(Timer),
    /// Stop a timer.
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
    /// All have acknowledged their new roles.
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
    /// The initiator that holds it.
    pub by: PlayerNumber,
    /// The initiator's attempt.
    pub sequence: Sequence,
}

/// What a robot does as an initiator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum AttemptPhase {
    /// It initiates nothing.
    Idle,
    /// It has asked for locks.
    #[expect(missing_docs, reason = "the sentence of the variant says what its fields are")]
    WaitingForLocks { sequence: Sequence },
    /// It has sent the new roles.
    #[expect(missing_docs, reason = "the sentence of the variant says what its fields are")]
    WaitingForAcks { sequence: Sequence },
}

/// The robots that an initiator asks: those named that its team has, each once and without itself.
pub(super) fn participants(named: &[PlayerNumber], me: PlayerNumber, all: &Assignment) -> Numbers {
    let mut others: Numbers =
        named.iter().copied().filter(|robot| *robot != me && all.of(*robot).is_some()).collect();
    others.sort_unstable();
    others.dedup();
    others
}
