//! Dynamic role assignment (Hammerheads, section VII): how a team changes its roles over a radio that loses, delays and
//! doubles messages.
//!
//! One robot, the initiator, asks the others for their locks (LOCK, ACKLOCK), tells each its new role (SWAP) and waits for
//! the acknowledgements (ACKSWAP). Two versions share these four messages: [`Paper`], as figure 7 has it, and [`Hardened`],
//! which survives what the first does not. When to swap, and to what, is decided elsewhere.

mod assignment;
mod hardened;
mod paper;
mod steps;

pub use assignment::{Assignment, Configuration, Reassignment, RoleIndex, Sequence};
pub use hardened::{Hardened, Ingredient};
pub use paper::{OnMissingAck, Paper, PaperRules, Unlock, WhileInitiating};
pub use steps::{
    AttemptPhase, Effect, Effects, Holding, Input, Lock, Message, Numbers, Order, Outcome, Timer,
};

use crate::ids::PlayerNumber;

/// A robot's side of the protocol, in the version that its strategy chose.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RoleSwap {
    /// The version of the paper.
    Paper(Paper),
    /// The hardened version.
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

    /// Where the robot stands in a swap of its own.
    pub fn phase(&self) -> AttemptPhase {
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
