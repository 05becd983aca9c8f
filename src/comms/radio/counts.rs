//! How many packets of each kind were sent and delivered.

use std::collections::BTreeMap;

use bevy::prelude::*;

use crate::comms::messages::MessageKind;
use crate::ids::RobotId;

/// Packets since the match began, by kind, sender and receiver: a message to three team mates is three packets. What a mute
/// robot wants to send is not sent.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct MessageCounts {
    sent: BTreeMap<Link, u64>,
    delivered: BTreeMap<Link, u64>,
}

/// Kind, sender and receiver.
type Link = (MessageKind, RobotId, RobotId);

impl MessageCounts {
    pub fn count_sent(&mut self, kind: MessageKind, from: RobotId, to: RobotId) {
        *self.sent.entry((kind, from, to)).or_default() += 1;
    }

    pub fn count_delivered(&mut self, kind: MessageKind, from: RobotId, to: RobotId) {
        *self.delivered.entry((kind, from, to)).or_default() += 1;
    }

    /// The packets sent so far of a kind, from a robot or any, to a robot or any.
    pub fn sent(&self, kind: MessageKind, from: Option<RobotId>, to: Option<RobotId>) -> u64 {
        total(&self.sent, kind, from, to)
    }

    /// The packets delivered so far, in the same way.
    pub fn delivered(&self, kind: MessageKind, from: Option<RobotId>, to: Option<RobotId>) -> u64 {
        total(&self.delivered, kind, from, to)
    }
}

fn total(counts: &BTreeMap<Link, u64>, kind: MessageKind, from: Option<RobotId>, to: Option<RobotId>) -> u64 {
    let matching = counts.iter().filter(|((of, sender, receiver), _)| {
        *of == kind && from.is_none_or(|from| from == *sender) && to.is_none_or(|to| to == *receiver)
    });
    matching.map(|(_, count)| count).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    #[test]
    fn packets_are_counted_by_kind_sender_and_receiver() {
        let home = |number| RobotId::new(Team::Home, number);
        let mut counts = MessageCounts::default();
        counts.count_sent(MessageKind::Position, home(1), home(2));
        counts.count_sent(MessageKind::Position, home(1), home(3));
        counts.count_delivered(MessageKind::Position, home(1), home(2));
        let position = MessageKind::Position;
        assert_eq!(counts.sent(position, None, None), 2);
        assert_eq!(counts.sent(position, Some(home(1)), Some(home(3))), 1);
        assert_eq!(counts.sent(position, Some(home(2)), None), 0);
        assert_eq!(counts.delivered(position, None, Some(home(3))), 0);
        assert_eq!(counts.delivered(position, Some(home(1)), None), 1);
        assert_eq!(counts.sent(MessageKind::Lock, None, None), 0);
    }
}
