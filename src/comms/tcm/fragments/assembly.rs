//! The receiver's table of messages that have not arrived in full.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::header::{Header, Malformed};
use super::limits::{ENTRY_COST, Limits, PIECE_COST};
use crate::comms::tcm::external_message::{Address, DataType, ExternalMessage, Module, Peer};

/// Puts messages together from fragments that come in any order, more than once or never, from many sources.
///
/// It allocates for what has arrived, never for what is announced. The newest wins: where room is missing the oldest
/// unfinished message goes of the sender that takes most of it, and where a fragment contradicts an unfinished message of the same
/// source and counter, that message goes. Once a message is over, completed or not, its further fragments are ignored while it is remembered.
#[derive(Clone, Debug)]
pub struct Assembly {
    limits: Limits,
    open: BTreeMap<Key, Partial>,
    over: BTreeMap<Key, Finished>,
    memory: usize,
    /// Numbers the entries of both tables by age.
    next: u64,
    counters: AssemblyCounters,
}

/// Counts of an assembly's datagrams and of the messages in them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct AssemblyCounters {
    /// Messages that came in a single datagram.
    pub single: u64,
    /// Messages put together from several.
    pub completed: u64,
    /// Messages that were not complete in time.
    pub expired: u64,
    /// Messages that went for want of room.
    pub evicted: u64,
    /// Messages that went because a newer fragment of the same source and counter contradicted them.
    pub contradictory: u64,
    /// Fragments that had arrived before.
    pub duplicate: u64,
    /// Fragments of messages that were over.
    pub late: u64,
    /// Datagrams of messages too large for the limits.
    pub too_large: u64,
    /// Datagrams that are none of the TCM, by [`Malformed::index`].
    pub malformed: [u64; Malformed::ALL.len()],
}

/// A message of which fragments are missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unfinished {
    /// The sender.
    pub source: Address,
    /// The sender's counter of this message.
    pub counter: u32,
    /// How the data are to be read.
    pub data_type: DataType,
    /// Fragments that have arrived.
    pub have: u16,
    /// Fragments in all.
    pub of: u16,
    /// Bytes of data that have arrived.
    pub bytes: usize,
    /// The tick in which the first arrived.
    pub since: u64,
}

/// Why a datagram was not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Refused {
    /// The datagram is not well formed.
    #[error(transparent)]
    Malformed(#[from] Malformed),
    /// The message is longer than is accepted.
    #[error("a message of {bytes} bytes, but {most} is the most")]
    TooLarge { bytes: usize, most: usize },
    /// Counted like those too large.
    #[error("a message in {fragments} fragments would cost {memory} bytes of memory, but {most} is the most")]
    TooFine { fragments: u16, memory: usize, most: usize },
}

/// A message's source and counter.
type Key = (Peer, u32);

/// What all fragments of a message have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Shape {
    module: Module,
    destination: Address,
    data_type: DataType,
    total: usize,
    count: u16,
    /// Bytes in each fragment but the last.
    step: usize,
}

#[derive(Clone, Debug)]
struct Partial {
    shape: Shape,
    since: u64,
    age: u64,
    pieces: BTreeMap<u16, Box<[u8]>>,
    bytes: usize,
}

#[derive(Clone, Copy, Debug)]
struct Finished {
    shape: Shape,
    since: u64,
    age: u64,
}

impl AssemblyCounters {
    /// All datagrams that were none of the TCM, whatever the reason.
    pub fn malformed_in_all(&self) -> u64 {
        self.malformed.iter().sum()
    }
}

impl Assembly {
    /// An assembly without messages.
    pub fn new(limits: Limits) -> Assembly {
        Assembly {
            limits,
            open: BTreeMap::new(),
            over: BTreeMap::new(),
            memory: 0,
            next: 0,
            counters: AssemblyCounters::default(),
        }
    }

    /// What it accepts.
    pub fn limits(&self) -> Limits {
        self.limits
    }

    /// Since the assembly was made.
    pub fn counters(&self) -> AssemblyCounters {
        self.counters
    }

    /// The memory that the tables are counted as at present, bytes; at most [`Limits::memory`].
    pub fn memory(&self) -> usize {
        self.memory + self.over.len() * ENTRY_COST
    }

    /// The unfinished messages, in the order of source and counter.
    pub fn in_assembly(&self) -> impl ExactSizeIterator<Item = Unfinished> {
        self.open.iter().map(|(&(peer, counter), open)| Unfinished {
            source: Address { peer, module: open.shape.module },
            counter,
            data_type: open.shape.data_type,
            have: open.have(),
            of: open.shape.count,
            bytes: open.bytes,
            since: open.since,
        })
    }

    /// Takes a datagram that has arrived in tick `now`, and returns the message that it completes.
    ///
    /// # Errors
    /// If it is malformed, or belongs to a message that the limits do not allow.
    pub fn accept(&mut self, now: u64, datagram: &[u8]) -> Result<Option<ExternalMessage>, Refused> {
        let taken = Header::read(datagram).map_err(Refused::Malformed).and_then(|(header, piece)| {
            let shape = self.shape(&header, piece)?;
            Ok(self.take(now, &header, shape, piece))
        });
        match taken {
            Err(Refused::Malformed(reason)) => self.counters.malformed[reason.index()] += 1,
            Err(Refused::TooLarge { .. } | Refused::TooFine { .. }) => self.counters.too_large += 1,
            Ok(_) => {}
        }
        taken
    }

    /// Gives up the messages whose time is over, and forgets those that were over for as long. Returns how many were
    /// given up.
    pub fn expire(&mut self, now: u64) -> usize {
        if self.open.is_empty() && self.over.is_empty() {
            return 0;
        }
        let timeout = self.limits.timeout;
        self.over.retain(|_, over| !over.is_forgotten(now, timeout));
        let stale = |(&key, open): (&Key, &Partial)| open.is_stale(now, timeout).then_some(key);
        let stale: Vec<Key> = self.open.iter().filter_map(stale).collect();
        for &key in &stale {
            self.close(now, key);
        }
        self.counters.expired += stale.len() as u64;
        stale.len()
    }

    fn shape(&self, header: &Header, piece: &[u8]) -> Result<Shape, Refused> {
        let step = header.step(piece.len()).ok_or(Malformed::Total)?;
        let total = usize::try_from(header.total).unwrap_or(usize::MAX);
        let most = self.limits.message_bytes;
        if total > most {
            return Err(Refused::TooLarge { bytes: total, most });
        }
        let memory = total.saturating_add(ENTRY_COST + usize::from(header.count) * PIECE_COST);
        let most = if self.limits.messages == 0 { 0 } else { self.limits.bytes };
        if header.count > 1 && memory > most {
            return Err(Refused::TooFine { fragments: header.count, memory, most });
        }
        Ok(Shape {
            module: header.source.module,
            destination: header.destination,
            data_type: header.data_type,
            total,
            count: header.count,
            step,
        })
    }

    /// The message that this piece completes.
    fn take(&mut self, now: u64, header: &Header, shape: Shape, piece: &[u8]) -> Option<ExternalMessage> {
        let key = (header.source.peer, header.counter);
        let timeout = self.limits.timeout;
        if self.open.get(&key).is_some_and(|open| open.is_stale(now, timeout)) {
            self.close(now, key);
            self.counters.expired += 1;
        }
        if self.over.get(&key).is_some_and(|over| over.shape != shape || over.is_forgotten(now, timeout)) {
            self.over.remove(&key);
        }
        if self.open.get(&key).is_some_and(|open| open.contradicts(shape, header.index, piece)) {
            self.remove(key);
            self.counters.contradictory += 1;
        }
        if header.count == 1 {
            self.counters.single += 1;
            return Some(shape.message(header.source, piece.to_vec()));
        }
        if self.over.contains_key(&key) {
            self.counters.late += 1;
            return None;
        }
        if self.open.get(&key).is_some_and(|open| open.pieces.contains_key(&header.index)) {
            self.counters.duplicate += 1;
            return None;
        }
        if !self.make_room(now, key, piece.len()) {
            return None;
        }
        let next = &mut self.next;
        let open = self.open.entry(key).or_insert_with(|| {
            *next += 1;
            self.memory += ENTRY_COST;
            Partial { shape, since: now, age: *next, pieces: BTreeMap::new(), bytes: 0 }
        });
        open.bytes += piece.len();
        open.pieces.insert(header.index, piece.into());
        self.memory += piece.len() + PIECE_COST;
        if open.have() < shape.count {
            return None;
        }
        self.counters.completed += 1;
        let open = self.close(now, key)?;
        let mut data = Vec::with_capacity(open.bytes);
        open.pieces.values().for_each(|piece| data.extend_from_slice(piece));
        Some(shape.message(header.source, data))
    }

    /// Gives up messages until a piece of the message `key` fits, each time the oldest of the sender that takes most room, so that who
    /// sends too much loses its own; false if that message had to go itself.
    fn make_room(&mut self, now: u64, key: Key, piece: usize) -> bool {
        let is_new = !self.open.contains_key(&key);
        let entries = if is_new { self.limits.messages.saturating_sub(1) } else { self.limits.messages };
        let cost = piece + PIECE_COST + if is_new { ENTRY_COST } else { 0 };
        while self.open.len() > entries || self.memory + cost > self.limits.bytes {
            let Some(oldest) = self.oldest_of_greediest() else { return true };
            self.close(now, oldest);
            self.counters.evicted += 1;
            if oldest == key {
                return false;
            }
        }
        true
    }

    /// The oldest message of the sender whose messages take most room; of several such senders, the oldest of all.
    fn oldest_of_greediest(&self) -> Option<Key> {
        let mut senders: BTreeMap<Peer, (usize, u64, Key)> = BTreeMap::new();
        for (&key, open) in &self.open {
            let (cost, age, oldest) = senders.entry(key.0).or_insert((0, open.age, key));
            *cost += open.cost();
            if open.age < *age {
                (*age, *oldest) = (open.age, key);
            }
        }
        let greediest = senders.into_values().max_by_key(|(cost, age, _)| (*cost, Reverse(*age)));
        greediest.map(|(_, _, oldest)| oldest)
    }

    /// Moves a message to those that are over.
    fn close(&mut self, now: u64, key: Key) -> Option<Partial> {
        let open = self.remove(key)?;
        if self.over.len() >= self.limits.messages
            && let Some((&oldest, _)) = self.over.iter().min_by_key(|(_, over)| over.age)
        {
            self.over.remove(&oldest);
        }
        self.next += 1;
        self.over.insert(key, Finished { shape: open.shape, since: now, age: self.next });
        Some(open)
    }

    fn remove(&mut self, key: Key) -> Option<Partial> {
        let open = self.open.remove(&key)?;
        self.memory -= open.cost();
        Some(open)
    }
}

impl Shape {
    fn message(&self, source: Address, data: Vec<u8>) -> ExternalMessage {
        ExternalMessage { source, destination: self.destination, data_type: self.data_type, data }
    }
}

impl Finished {
    fn is_forgotten(&self, now: u64, timeout: u64) -> bool {
        now.saturating_sub(self.since) >= timeout
    }
}

impl Partial {
    fn have(&self) -> u16 {
        u16::try_from(self.pieces.len()).unwrap_or(u16::MAX)
    }

    fn is_stale(&self, now: u64, timeout: u64) -> bool {
        now.saturating_sub(self.since) >= timeout
    }

    /// Whether a fragment cannot be of the same message.
    fn contradicts(&self, shape: Shape, index: u16, piece: &[u8]) -> bool {
        shape != self.shape || self.pieces.get(&index).is_some_and(|mine| **mine != *piece)
    }

    fn cost(&self) -> usize {
        ENTRY_COST + self.bytes + self.pieces.len() * PIECE_COST
    }
}

#[cfg(test)]
mod tests;
