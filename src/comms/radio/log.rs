//! What was on air during the last minute, for people to see.

use std::collections::VecDeque;

use bevy::prelude::*;

use super::{Fate, Loss, Packet};
use crate::clock::Clock;
use crate::comms::messages::MessageKind;
use crate::ids::RobotId;
use crate::protocol::role_swap::Sequence;

/// The transmissions of the last minute, oldest first. A broadcast is one to each team mate.
#[derive(Resource, Clone, Debug, Default)]
pub struct RadioLog {
    entries: VecDeque<Transmission>,
    next_id: u64,
}

/// A message of one robot to one other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transmission {
    pub id: u64,
    pub kind: MessageKind,
    /// The attempt of a role swap that it belongs to.
    pub sequence: Option<Sequence>,
    pub from: RobotId,
    pub to: RobotId,
    /// The tick in which it was sent.
    pub sent: u64,
    pub outcome: Outcome,
    /// It took longer than the radio's ordinary delay.
    pub late: bool,
    /// A second copy was on its way too.
    pub doubled: bool,
}

/// What has become of a transmission so far.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It is to arrive in this tick.
    InFlight(u64),
    /// It arrived in this tick.
    Arrived(u64),
    Lost(Loss),
}

/// How long transmissions are kept, s.
pub const KEPT: f32 = 60.0;

impl RadioLog {
    /// Writes a transmission down and returns its number.
    pub fn sent(&mut self, packet: &Packet, sequence: Option<Sequence>, fate: &Fate, tick: u64) -> u64 {
        let id = self.next_id;
        self.next_id += 1;
        let outcome = match (fate.copies.first(), fate.lost) {
            (Some(copy), _) => Outcome::InFlight(copy.due),
            (None, loss) => Outcome::Lost(loss.unwrap_or(Loss::Chance)),
        };
        self.entries.push_back(Transmission {
            id,
            kind: packet.kind,
            sequence,
            from: packet.from,
            to: packet.to,
            sent: tick,
            outcome,
            late: fate.copies.iter().any(|copy| copy.late),
            doubled: fate.copies.len() > 1,
        });
        id
    }

    pub(crate) fn arrived(&mut self, id: u64, tick: u64) {
        self.settle(id, Outcome::Arrived(tick));
    }

    pub(crate) fn lost(&mut self, id: u64, loss: Loss) {
        self.settle(id, Outcome::Lost(loss));
    }

    /// The first copy to arrive settles the fate of a message.
    fn settle(&mut self, id: u64, outcome: Outcome) {
        let first = self.entries.front().map_or(self.next_id, |entry| entry.id);
        let entry = id.checked_sub(first).and_then(|index| self.entries.get_mut(index as usize));
        if let Some(entry) = entry.filter(|entry| matches!(entry.outcome, Outcome::InFlight(_))) {
            entry.outcome = outcome;
        }
    }

    pub(crate) fn forget(&mut self, clock: &Clock) {
        let kept = clock.ticks(KEPT);
        while self.entries.front().is_some_and(|entry| entry.sent + kept < clock.tick) {
            self.entries.pop_front();
        }
    }

    /// How many there were since the match began.
    pub fn transmissions(&self) -> u64 {
        self.next_id
    }

    /// Oldest first.
    pub fn entries(&self) -> impl DoubleEndedIterator<Item = &Transmission> + '_ {
        self.entries.iter()
    }
}
