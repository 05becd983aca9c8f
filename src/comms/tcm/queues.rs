//! The queues of a TcmClient (TeamChaos, section 3): what modules want to send waits in one bounded queue for each module
//! until the TCM is ready for more.

use std::collections::{BTreeMap, VecDeque};
use std::ops::Bound;

use serde::{Deserialize, Serialize};

use super::external_message::Module;

/// How long the queue of a module may become.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct QueueRule {
    /// Items that it holds at most. With 0 every item is dropped.
    pub capacity: usize,
    /// What happens if an item finds the queue full.
    pub when_full: WhenFull,
}

/// What goes when an item finds a queue full.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum WhenFull {
    /// What has waited longest: for news, of which the latest counts.
    DropOldest,
    /// The item itself: for pieces of something, of which the first are worth nothing without the rest.
    DropNewest,
}

/// One queue for each module, in the order of the modules.
#[derive(Clone, Debug)]
pub struct Queues<T> {
    rule: QueueRule,
    queues: BTreeMap<Module, Queue<T>>,
    /// The module that handed over the last item.
    last: Option<Module>,
}

/// Counts of a module's items. Put in = handed over + dropped + waiting.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct QueueCounters {
    /// Items put into the queue.
    pub put_in: u64,
    /// Items taken out of it in turn.
    pub handed_over: u64,
    /// Items that were dropped for want of room.
    pub dropped: u64,
}

#[derive(Clone, Debug)]
struct Queue<T> {
    items: VecDeque<T>,
    counters: QueueCounters,
}

impl<T> Queues<T> {
    /// Queues that all follow `rule`.
    pub fn new(rule: QueueRule) -> Queues<T> {
        Queues { rule, queues: BTreeMap::new(), last: None }
    }

    /// Puts an item at the end of its module's queue. Returns what was dropped for it: the queue's oldest item, or the item
    /// itself.
    pub fn push(&mut self, module: Module, item: T) -> Option<T> {
        let rule = self.rule;
        let empty = || Queue { items: VecDeque::new(), counters: QueueCounters::default() };
        let queue = self.queues.entry(module).or_insert_with(empty);
        queue.counters.put_in += 1;
        let room = queue.items.len() < rule.capacity;
        let dropped = match rule.when_full {
            _ if room => None,
            WhenFull::DropOldest if rule.capacity > 0 => queue.items.pop_front(),
            WhenFull::DropOldest | WhenFull::DropNewest => {
                queue.counters.dropped += 1;
                return Some(item);
            }
        };
        queue.counters.dropped += u64::from(dropped.is_some());
        queue.items.push_back(item);
        dropped
    }

    /// Hands over up to `most` items: one of each module that has any, in the order of the modules, then again, beginning
    /// after the module that handed over the last one before. Items of a module keep their order.
    pub fn take(&mut self, most: usize) -> Vec<T> {
        let mut taken = Vec::new();
        while taken.len() < most
            && let Some((module, queue)) = self.after_last()
            && let Some(item) = queue.items.pop_front()
        {
            queue.counters.handed_over += 1;
            taken.push(item);
            self.last = Some(module);
        }
        taken
    }

    /// Whether nothing waits.
    pub fn is_empty(&self) -> bool {
        self.queues.values().all(|queue| queue.items.is_empty())
    }

    /// The modules that have a queue, how many items wait in it, and its counters.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = (Module, usize, QueueCounters)> {
        self.queues.iter().map(|(&module, queue)| (module, queue.items.len(), queue.counters))
    }

    /// The next queue with an item, after that of the last module and round to it.
    fn after_last(&mut self) -> Option<(Module, &mut Queue<T>)> {
        let waits = |(&module, queue): (&Module, &Queue<T>)| (!queue.items.is_empty()).then_some(module);
        let from = self.last.map_or(Bound::Unbounded, Bound::Excluded);
        let after = self.queues.range((from, Bound::Unbounded)).find_map(waits);
        let module = after.or_else(|| self.queues.iter().find_map(waits))?;
        Some((module, self.queues.get_mut(&module)?))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const A: Module = Module(0);
    const B: Module = Module(1);
    const C: Module = Module(9);

    fn rule(capacity: usize, when_full: WhenFull) -> QueueRule {
        QueueRule { capacity, when_full }
    }

    #[test]
    fn a_full_queue_drops_its_oldest_or_its_newest_item() {
        for (when_full, expected) in [
            (WhenFull::DropOldest, ([None, None, Some(1)], [2, 3])),
            (WhenFull::DropNewest, ([None, None, Some(3)], [1, 2])),
        ] {
            let mut queues = Queues::new(rule(2, when_full));
            let dropped = [1, 2, 3].map(|item| queues.push(A, item));
            assert_eq!((dropped, queues.push(B, 4)), (expected.0, None));
            assert_eq!(queues.take(9), [expected.1[0], 4, expected.1[1]]);
            let counters = QueueCounters { put_in: 3, handed_over: 2, dropped: 1 };
            let others = QueueCounters { put_in: 1, handed_over: 1, dropped: 0 };
            assert_eq!(queues.rows().collect::<Vec<_>>(), [(A, 0, counters), (B, 0, others)]);
        }
    }

    #[test]
    fn a_queue_without_room_drops_everything() {
        for when_full in [WhenFull::DropOldest, WhenFull::DropNewest] {
            let mut queues = Queues::new(rule(0, when_full));
            assert_eq!(queues.push(A, 1), Some(1));
            assert_eq!(queues.rows().map(|row| (row.1, row.2.dropped)).collect::<Vec<_>>(), [(0, 1)]);
        }
    }

    #[test]
    fn modules_take_turns_also_from_one_call_to_the_next() {
        let mut queues = Queues::new(rule(32, WhenFull::DropOldest));
        for item in 0..3 {
            queues.push(A, ('a', item));
            queues.push(C, ('c', item));
        }
        queues.push(B, ('b', 0));
        let taken: Vec<_> = (0..4).flat_map(|_| queues.take(2)).collect();
        assert_eq!(taken, [('a', 0), ('b', 0), ('c', 0), ('a', 1), ('c', 1), ('a', 2), ('c', 2)]);
        assert!(queues.is_empty());
    }

    #[test]
    fn a_rule_is_read_from_a_file() {
        let text = "(capacity: 3, when_full: DropNewest)";
        assert_eq!(ron::from_str::<QueueRule>(text).unwrap(), rule(3, WhenFull::DropNewest));
    }

    proptest! {
        #[test]
        fn nothing_is_lost_uncounted_reordered_or_starved(
            steps in prop::collection::vec((0u8..4, 0usize..3), 0..200),
            capacity in 0usize..6,
            oldest: bool,
        ) {
            let when_full = if oldest { WhenFull::DropOldest } else { WhenFull::DropNewest };
            let mut queues = Queues::new(rule(capacity, when_full));
            let mut taken = Vec::new();
            for (number, &(module, most)) in steps.iter().enumerate() {
                queues.push(Module(module), (module, number));
                taken.extend(queues.take(most));
                prop_assert!(queues.rows().all(|(_, waiting, _)| waiting <= capacity));
            }
            let waiting: Vec<_> = queues.rows().filter(|row| row.1 > 0).map(|row| row.0).collect();
            let round = queues.take(waiting.len());
            let mut served: Vec<_> = round.iter().map(|&(module, _)| Module(module)).collect();
            served.sort();
            prop_assert_eq!(served, waiting);
            taken.extend(round);
            for module in 0..4 {
                let numbers = taken.iter().filter(|item| item.0 == module).map(|item| item.1);
                prop_assert!(numbers.is_sorted());
            }
            for (_, waiting, counters) in queues.rows() {
                prop_assert_eq!(counters.put_in, counters.handed_over + counters.dropped + waiting as u64);
            }
        }
    }
}
