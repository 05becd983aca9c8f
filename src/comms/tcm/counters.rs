//! How much was said and heard of each type by each module, and what was dropped.

use std::collections::BTreeMap;
use std::ops::AddAssign;

use serde::{Deserialize, Serialize};

use super::external_message::{DataType, Module};

/// Why a message was dropped by its sender or its receiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Dropped {
    /// The module's queue had no room.
    QueueFull,
    /// It does not fit into as many datagrams as a message may have, or into what a receiver assembles.
    TooLarge,
    /// It would have gone beyond the team's budget of messages.
    OverBudget,
    /// No module has registered for it.
    UnknownType,
    /// The module that has registered for it cannot read the data.
    NotUnserialisable,
}

/// The messages of one type and module, or the sum over several.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct TypeCount {
    /// Messages sent, each once however many receive it.
    pub messages_sent: u64,
    /// Data of the messages sent, bytes, once for each message however many receive it.
    pub bytes_sent: u64,
    /// Fragments sent, counted for each receiver.
    pub datagrams_sent: u64,
    /// Messages received whole.
    pub messages_received: u64,
    /// Data of the messages received, bytes.
    pub bytes_received: u64,
    /// By [`Dropped::index`].
    pub dropped: [u64; Dropped::ALL.len()],
}

/// The counters of one peer.
///
/// Strangers may send any type to any module; beyond [`TypeCounters::ROWS`] kinds all others are counted as one.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TypeCounters {
    types: BTreeMap<(Module, DataType), TypeCount>,
    others: TypeCount,
    /// Datagrams and messages from nobody in the directory, or for somebody else.
    pub foreign: u64,
    /// Datagrams that are none of the TCM.
    pub malformed: u64,
    /// Messages that were not complete in time.
    pub expired: u64,
}

impl Dropped {
    /// All reasons, in their order.
    pub const ALL: [Dropped; 5] = [
        Dropped::QueueFull,
        Dropped::TooLarge,
        Dropped::OverBudget,
        Dropped::UnknownType,
        Dropped::NotUnserialisable,
    ];

    /// The place of this reason in [`Dropped::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }
}

impl TypeCount {
    /// What was dropped for one reason.
    pub fn dropped_as(&self, reason: Dropped) -> u64 {
        self.dropped[reason.index()]
    }
}

impl AddAssign<&TypeCount> for TypeCount {
    fn add_assign(&mut self, other: &TypeCount) {
        self.messages_sent += other.messages_sent;
        self.bytes_sent += other.bytes_sent;
        self.datagrams_sent += other.datagrams_sent;
        self.messages_received += other.messages_received;
        self.bytes_received += other.bytes_received;
        for (mine, theirs) in self.dropped.iter_mut().zip(other.dropped) {
            *mine += theirs;
        }
    }
}

impl TypeCounters {
    /// The most kinds of message, by module and type, that are told apart.
    pub const ROWS: usize = 256;

    /// Counts a message that `module` has sent, as so many datagrams in all.
    pub fn sent(&mut self, module: Module, data_type: DataType, bytes: usize, datagrams: usize) {
        let count = self.count(module, data_type);
        count.messages_sent += 1;
        count.bytes_sent += bytes as u64;
        count.datagrams_sent += datagrams as u64;
    }

    /// Counts a message that has arrived.
    pub fn received(&mut self, module: Module, data_type: DataType, bytes: usize) {
        let count = self.count(module, data_type);
        count.messages_received += 1;
        count.bytes_received += bytes as u64;
    }

    /// Counts a message that was not sent, or that arrived in vain.
    pub fn dropped(&mut self, module: Module, data_type: DataType, reason: Dropped) {
        self.count(module, data_type).dropped[reason.index()] += 1;
    }

    /// One kind; all zero if nothing was counted for it.
    pub fn of(&self, module: Module, data_type: DataType) -> TypeCount {
        self.types.get(&(module, data_type)).copied().unwrap_or_default()
    }

    /// The kinds for which anything was counted, in the order of module and type.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = (Module, DataType, &TypeCount)> {
        self.types.iter().map(|(&(module, data_type), count)| (module, data_type, count))
    }

    /// What is in none of the rows, for want of room.
    pub fn others(&self) -> TypeCount {
        self.others
    }

    /// All kinds together.
    pub fn total(&self) -> TypeCount {
        self.types.values().fold(self.others, |mut total, count| {
            total += count;
            total
        })
    }

    fn count(&mut self, module: Module, data_type: DataType) -> &mut TypeCount {
        let kind = (module, data_type);
        if self.types.len() >= TypeCounters::ROWS && !self.types.contains_key(&kind) {
            return &mut self.others;
        }
        self.types.entry(kind).or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_has_counters_of_its_own() {
        let mut counters = TypeCounters::default();
        counters.sent(Module::WORLD_MODEL, DataType::POSITION, 20, 3);
        counters.sent(Module::WORLD_MODEL, DataType::POSITION, 28, 3);
        counters.received(Module::WORLD_MODEL, DataType::POSITION, 20);
        counters.dropped(Module::WORLD_MODEL, DataType::TEXT, Dropped::UnknownType);
        counters.dropped(Module::GOALIE, DataType::GOALIE_NEWS, Dropped::QueueFull);
        let expected = TypeCount {
            messages_sent: 2,
            bytes_sent: 48,
            datagrams_sent: 6,
            messages_received: 1,
            bytes_received: 20,
            dropped: [0; 5],
        };
        assert_eq!(counters.of(Module::WORLD_MODEL, DataType::POSITION), expected);
        assert_eq!(counters.of(Module::GOALIE, DataType::GOALIE_NEWS).dropped_as(Dropped::QueueFull), 1);
        assert_eq!(counters.of(Module::GOALIE, DataType::TEXT), TypeCount::default());
        let rows: Vec<_> = counters.rows().map(|(module, data_type, _)| (module.0, data_type.0)).collect();
        assert_eq!(rows, [(0, 1), (0, 8), (2, 3)]);
        assert_eq!((counters.total().messages_sent, counters.total().dropped), (2, [1, 0, 0, 1, 0]));
    }

    #[test]
    fn kinds_without_number_share_a_row() {
        let mut counters = TypeCounters::default();
        for data_type in 0..1_000 {
            counters.received(Module(200), DataType(data_type), 1);
        }
        assert_eq!(counters.rows().len(), TypeCounters::ROWS);
        assert_eq!(counters.others().messages_received, 1_000 - TypeCounters::ROWS as u64);
        assert_eq!(counters.total().bytes_received, 1_000);
    }

    #[test]
    fn every_reason_has_its_own_place() {
        for (place, reason) in Dropped::ALL.into_iter().enumerate() {
            assert_eq!(reason.index(), place);
        }
    }
}
