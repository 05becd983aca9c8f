//! Counters of several robots' team communication modules, added up. Pure.

use std::collections::BTreeMap;

use crate::comms::tcm::counters::{TypeCount, TypeCounters};
use crate::comms::tcm::queues::QueueCounters;
use crate::comms::tcm::{DataType, Module};

/// What was counted, of one robot or of several together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SummedCounters {
    pub types: BTreeMap<(Module, DataType), TypeCount>,
    /// Items that wait, and the counters.
    pub queues: BTreeMap<Module, (usize, QueueCounters)>,
    /// Kinds that have no row, for want of room.
    pub others: TypeCount,
    pub foreign: u64,
    pub malformed: u64,
    pub expired: u64,
}

impl SummedCounters {
    /// Adds the counters of one robot.
    pub fn add(&mut self, counters: &TypeCounters) {
        for (module, data_type, count) in counters.rows() {
            *self.types.entry((module, data_type)).or_default() += count;
        }
        self.others += &counters.others();
        self.foreign += counters.foreign;
        self.malformed += counters.malformed;
        self.expired += counters.expired;
    }

    /// Adds the queues of one robot.
    pub fn add_queues(&mut self, rows: impl Iterator<Item = (Module, usize, QueueCounters)>) {
        for (module, waiting, counters) in rows {
            let (all, sum) = self.queues.entry(module).or_default();
            *all += waiting;
            sum.put_in += counters.put_in;
            sum.handed_over += counters.handed_over;
            sum.dropped += counters.dropped;
        }
    }

    /// Gives every type a row that somebody has registered, also where nothing was counted.
    pub fn name(&mut self, types: impl Iterator<Item = (Module, DataType)>) {
        for kind in types {
            self.types.entry(kind).or_default();
        }
    }

    /// All rows together.
    pub fn total(&self) -> TypeCount {
        self.types.values().fold(self.others, |mut total, count| {
            total += count;
            total
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comms::tcm::counters::Dropped;

    #[test]
    fn robots_are_added_up_row_by_row() {
        let mut counters = TypeCounters::default();
        counters.sent(Module::BALL_BOOKING, DataType::BOOK, 12, 3);
        counters.dropped(Module::BALL_BOOKING, DataType::BOOK, Dropped::TooLarge);
        counters.foreign += 1;
        let mut sums = SummedCounters::default();
        sums.name([(Module::GOALIE, DataType::GOALIE_NEWS)].into_iter());
        (0..2).for_each(|_| sums.add(&counters));
        let book = sums.types[&(Module::BALL_BOOKING, DataType::BOOK)];
        assert_eq!((book.messages_sent, book.bytes_sent, book.datagrams_sent), (2, 24, 6));
        assert_eq!(book.dropped_as(Dropped::TooLarge), 2);
        assert_eq!((sums.types.len(), sums.foreign, sums.total().messages_sent), (2, 2, 2));
    }

    #[test]
    fn queues_are_added_up_module_by_module() {
        let counters = QueueCounters { put_in: 5, handed_over: 3, dropped: 1 };
        let mut sums = SummedCounters::default();
        sums.add_queues([(Module::CLAIMS, 1, counters), (Module::GOALIE, 0, counters)].into_iter());
        sums.add_queues([(Module::CLAIMS, 2, counters)].into_iter());
        let (waiting, sum) = sums.queues[&Module::CLAIMS];
        assert_eq!((waiting, sum.put_in, sum.handed_over, sum.dropped), (3, 10, 6, 2));
    }
}
