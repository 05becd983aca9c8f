//! Which messages are looked at: by what they are about, and by who says or hears them.

use std::collections::BTreeSet;

use crate::comms::messages::MessageKind;
use crate::comms::radio::Transmission;
use crate::ids::RobotId;

/// Messages that are looked at, in the panel and on the pitch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Filter {
    /// By the kind's place among all.
    kinds: [bool; MessageKind::ALL.len()],
    /// Robots whose messages are left out.
    left_out: BTreeSet<RobotId>,
}

impl Default for Filter {
    /// Everything but positions, which are sent all the time.
    fn default() -> Filter {
        Filter {
            kinds: MessageKind::ALL.map(|kind| kind != MessageKind::Position),
            left_out: BTreeSet::new(),
        }
    }
}

impl Filter {
    /// Whether a message is looked at: its kind, and both robots.
    pub fn passes(&self, message: &Transmission) -> bool {
        self.kinds[message.kind as usize] && self.shows(message.from) && self.shows(message.to)
    }

    /// The switch of a kind.
    pub fn kind(&mut self, kind: MessageKind) -> &mut bool {
        &mut self.kinds[kind as usize]
    }

    pub fn shows(&self, robot: RobotId) -> bool {
        !self.left_out.contains(&robot)
    }

    /// Looks at a robot's messages or leaves them out.
    pub fn show(&mut self, robot: RobotId, shown: bool) {
        if shown {
            self.left_out.remove(&robot);
        } else {
            self.left_out.insert(robot);
        }
    }
}

/// Whether a message belongs to a role swap.
pub fn is_of_a_swap(kind: MessageKind) -> bool {
    use MessageKind::{AckLock, AckSwap, Lock, Swap};
    matches!(kind, Lock | AckLock | Swap | AckSwap)
}

#[cfg(test)]
mod tests {
    use super::super::samples::{home, transmission};
    use super::*;
    use crate::comms::radio::Outcome;

    #[test]
    fn positions_are_off_at_first_and_everything_else_is_on() {
        let mut filter = Filter::default();
        for kind in MessageKind::ALL {
            assert_eq!(*filter.kind(kind), kind != MessageKind::Position);
        }
        let position = transmission(MessageKind::Position, 0, 1, 10, Outcome::Arrived(12));
        assert!(!filter.passes(&position));
        *filter.kind(MessageKind::Position) = true;
        assert!(filter.passes(&position));
    }

    #[test]
    fn a_robot_that_is_left_out_takes_what_it_says_and_hears_with_it() {
        let mut filter = Filter::default();
        filter.show(home(2), false);
        let lock = |from, to| transmission(MessageKind::Lock, from, to, 10, Outcome::Arrived(12));
        assert!(!filter.passes(&lock(2, 1)) && !filter.passes(&lock(1, 2)) && filter.passes(&lock(1, 3)));
        filter.show(home(2), true);
        assert!(filter.passes(&lock(2, 1)));
    }

    #[test]
    fn the_four_messages_of_the_protocol_are_those_of_a_swap() {
        let swaps = MessageKind::ALL.into_iter().filter(|kind| is_of_a_swap(*kind));
        assert_eq!(swaps.count(), 4);
        assert!(!is_of_a_swap(MessageKind::Values));
    }
}
