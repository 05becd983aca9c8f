//! Which messages are looked at: by what they are about, and by who says or hears them.

use std::collections::BTreeSet;

use crate::comms::radio::Transmission;
use crate::comms::tcm::DataType;
use crate::ids::RobotId;

/// Messages that are looked at, in the panel and on the pitch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Filter {
    /// Kinds that are left out.
    kinds: BTreeSet<DataType>,
    /// Robots whose messages are left out.
    robots: BTreeSet<RobotId>,
}

impl Default for Filter {
    /// Everything but positions, which are sent all the time.
    fn default() -> Filter {
        Filter { kinds: [DataType::POSITION].into(), robots: BTreeSet::new() }
    }
}

impl Filter {
    /// Whether a message is looked at: its kind, and both robots.
    pub fn passes(&self, message: &Transmission) -> bool {
        let packet = &message.packet;
        self.shows_kind(packet.kind) && self.shows(packet.from) && self.shows(packet.to)
    }

    pub fn shows_kind(&self, kind: DataType) -> bool {
        !self.kinds.contains(&kind)
    }

    /// Looks at the messages of a kind or leaves them out.
    pub fn show_kind(&mut self, kind: DataType, shown: bool) {
        set(&mut self.kinds, kind, !shown);
    }

    pub fn shows(&self, robot: RobotId) -> bool {
        !self.robots.contains(&robot)
    }

    /// Looks at a robot's messages or leaves them out.
    pub fn show(&mut self, robot: RobotId, shown: bool) {
        set(&mut self.robots, robot, !shown);
    }
}

/// Puts an item into a set or takes it out.
fn set<T: Ord>(set: &mut BTreeSet<T>, item: T, is_in: bool) {
    if is_in {
        set.insert(item);
    } else {
        set.remove(&item);
    }
}

/// Whether a message belongs to a role swap.
pub fn is_of_a_swap(kind: DataType) -> bool {
    matches!(kind, DataType::LOCK | DataType::ACK_LOCK | DataType::SWAP | DataType::ACK_SWAP)
}

#[cfg(test)]
mod tests {
    use super::super::samples::{home, transmission};
    use super::*;
    use crate::comms::messages::TeamMessage;
    use crate::comms::radio::TransmissionState;
    use crate::comms::tcm::Data;

    #[test]
    fn positions_are_off_at_first_and_everything_else_is_on() {
        let mut filter = Filter::default();
        for known in TeamMessage::TYPES {
            assert_eq!(filter.shows_kind(known.number), known.number != DataType::POSITION);
        }
        let position = transmission(DataType::POSITION, 0, 1, 10, TransmissionState::Arrived(12));
        assert!(!filter.passes(&position));
        filter.show_kind(DataType::POSITION, true);
        assert!(filter.passes(&position));
    }

    #[test]
    fn a_robot_that_is_left_out_takes_what_it_says_and_hears_with_it() {
        let mut filter = Filter::default();
        filter.show(home(2), false);
        let lock = |from, to| transmission(DataType::LOCK, from, to, 10, TransmissionState::Arrived(12));
        assert!(!filter.passes(&lock(2, 1)) && !filter.passes(&lock(1, 2)) && filter.passes(&lock(1, 3)));
        filter.show(home(2), true);
        assert!(filter.passes(&lock(2, 1)));
    }

    #[test]
    fn the_four_messages_of_the_protocol_are_those_of_a_swap() {
        let swaps = TeamMessage::TYPES.iter().filter(|known| is_of_a_swap(known.number));
        assert_eq!(swaps.count(), 4);
        assert!(!is_of_a_swap(DataType::VALUES));
    }
}
