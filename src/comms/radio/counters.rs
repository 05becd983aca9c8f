//! Counts of what was said on each link, and of what arrived.
//!
//! Sent + duplicated = delivered + lost + what is still under way.

use std::collections::BTreeMap;
use std::iter::Sum;
use std::ops::AddAssign;

use bevy::prelude::Resource;
use serde::{Deserialize, Serialize};

use super::channel::{Fate, Loss};
use super::packet::Packet;
use crate::ids::RobotId;

/// The packets of one directed link, or the sum over several.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct LinkCounters {
    pub sent: u64,
    /// Packets and duplicates that arrived.
    pub delivered: u64,
    /// Packets and duplicates that did not, by [`Loss::index`].
    pub lost: [u64; Loss::ALL.len()],
    /// Packets and duplicates that the channel held up.
    pub late: u64,
    /// Duplicates that the channel made.
    pub duplicated: u64,
    /// Bytes of the packets sent.
    pub bytes: u64,
}

/// The counters of every directed link, by sender and receiver.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    links: BTreeMap<(RobotId, RobotId), LinkCounters>,
}

impl LinkCounters {
    /// All that was lost, whatever the reason.
    pub fn lost_in_all(&self) -> u64 {
        self.lost.iter().sum()
    }

    /// What was lost for one reason.
    pub fn lost_to(&self, reason: Loss) -> u64 {
        self.lost[reason.index()]
    }

    /// Packets and duplicates that have neither arrived nor been lost.
    pub fn under_way(&self) -> u64 {
        (self.sent + self.duplicated).saturating_sub(self.delivered + self.lost_in_all())
    }
}

impl AddAssign for LinkCounters {
    fn add_assign(&mut self, other: LinkCounters) {
        self.sent += other.sent;
        self.delivered += other.delivered;
        for (mine, theirs) in self.lost.iter_mut().zip(other.lost) {
            *mine += theirs;
        }
        self.late += other.late;
        self.duplicated += other.duplicated;
        self.bytes += other.bytes;
    }
}

impl Sum for LinkCounters {
    fn sum<I: Iterator<Item = LinkCounters>>(counters: I) -> LinkCounters {
        counters.fold(LinkCounters::default(), |mut total, link| {
            total += link;
            total
        })
    }
}

impl Traffic {
    /// Counts a packet when it is sent, and what the channel makes of it.
    pub fn send(&mut self, packet: &Packet, fate: &Fate) {
        let link = self.links.entry((packet.from, packet.to)).or_default();
        link.sent += 1;
        link.bytes += packet.bytes as u64;
        if let Some(reason) = fate.lost {
            link.lost[reason.index()] += 1;
        }
        link.late += fate.copies.iter().filter(|copy| copy.late).count() as u64;
        link.duplicated += fate.copies.iter().filter(|copy| copy.duplicate).count() as u64;
    }

    /// Counts an arrival of a packet or duplicate.
    pub fn deliver(&mut self, from: RobotId, to: RobotId) {
        self.links.entry((from, to)).or_default().delivered += 1;
    }

    /// Counts a packet or duplicate that the channel let through and that was lost nevertheless.
    pub fn lose(&mut self, from: RobotId, to: RobotId, reason: Loss) {
        self.links.entry((from, to)).or_default().lost[reason.index()] += 1;
    }

    /// The links on which anything was sent, in the order of sender and receiver.
    pub fn links(&self) -> impl ExactSizeIterator<Item = (RobotId, RobotId, &LinkCounters)> {
        self.links.iter().map(|(&(from, to), counters)| (from, to, counters))
    }

    /// One link; all zero if nothing was sent on it.
    pub fn link(&self, from: RobotId, to: RobotId) -> LinkCounters {
        self.links.get(&(from, to)).copied().unwrap_or_default()
    }

    /// All that one robot sent.
    pub fn sent_by(&self, robot: RobotId) -> LinkCounters {
        self.links().filter(|(from, ..)| *from == robot).map(|(.., counters)| *counters).sum()
    }

    /// All that was sent to one robot.
    pub fn sent_to(&self, robot: RobotId) -> LinkCounters {
        self.links().filter(|(_, to, _)| *to == robot).map(|(.., counters)| *counters).sum()
    }

    /// All of the match.
    pub fn total(&self) -> LinkCounters {
        self.links.values().copied().sum()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::comms::messages::MessageKind;
    use crate::comms::radio::channel::Arrival;
    use crate::ids::Team;

    fn home(number: u8) -> RobotId {
        RobotId::new(Team::Home, number)
    }

    fn packet(from: u8, to: u8, bytes: usize) -> Packet {
        Packet { kind: MessageKind::Position, from: home(from), to: home(to), bytes, distance: 1.0 }
    }

    fn arriving(copies: usize, late: bool) -> Fate {
        let copies = (0..copies).map(|place| Arrival { due: 3, late, duplicate: place > 0 });
        Fate { copies: copies.collect(), lost: None }
    }

    #[test]
    fn every_reason_has_its_own_place() {
        for (place, reason) in Loss::ALL.into_iter().enumerate() {
            assert_eq!(reason.index(), place);
        }
    }

    #[test]
    fn a_packet_is_under_way_until_it_arrives_or_is_lost() {
        let mut traffic = Traffic::default();
        traffic.send(&packet(0, 1, 20), &arriving(1, false));
        traffic.send(&packet(0, 1, 30), &Fate::lost(Loss::Range));
        traffic.send(&packet(0, 1, 50), &arriving(1, true));
        assert_eq!(traffic.total().under_way(), 2);
        traffic.deliver(home(0), home(1));
        traffic.lose(home(0), home(1), Loss::Deaf);
        let link = traffic.link(home(0), home(1));
        assert_eq!((link.sent, link.delivered, link.late, link.under_way(), link.bytes), (3, 1, 1, 0, 100));
        assert_eq!((link.lost_to(Loss::Range), link.lost_to(Loss::Deaf), link.lost_in_all()), (1, 1, 2));
    }

    #[test]
    fn a_duplicate_is_under_way_like_a_packet_but_is_not_sent() {
        let mut traffic = Traffic::default();
        traffic.send(&packet(0, 1, 20), &arriving(3, true));
        traffic.deliver(home(0), home(1));
        let total = traffic.total();
        assert_eq!((total.sent, total.duplicated, total.late, total.bytes), (1, 2, 3, 20));
        assert_eq!((total.delivered, total.under_way()), (1, 2));
    }

    #[test]
    fn a_link_without_traffic_counts_nothing_and_is_not_listed() {
        let mut traffic = Traffic::default();
        traffic.send(&packet(2, 1, 20), &arriving(1, false));
        traffic.send(&packet(0, 1, 20), &arriving(1, false));
        assert_eq!(traffic.link(home(1), home(0)), LinkCounters::default());
        let listed: Vec<_> = traffic.links().map(|(from, to, _)| (from, to)).collect();
        assert_eq!(listed, [(home(0), home(1)), (home(2), home(1))]);
    }

    proptest! {
        #[test]
        fn totals_by_sender_and_by_receiver_add_up_to_the_whole(
            sends in prop::collection::vec((0u8..4, 0u8..4, 0usize..100, 0usize..12), 0..60),
        ) {
            let mut traffic = Traffic::default();
            for &(from, to, bytes, reason) in &sends {
                let copies = 1 + bytes % 3;
                let lost = Loss::ALL.get(reason).map(|reason| Fate::lost(*reason));
                let fate = lost.unwrap_or_else(|| arriving(copies, bytes > 50));
                traffic.send(&packet(from, to, bytes), &fate);
                for _ in &fate.copies {
                    traffic.deliver(home(from), home(to));
                }
            }
            let total = traffic.total();
            prop_assert_eq!(total.sent, sends.len() as u64);
            prop_assert_eq!(total.under_way(), 0);
            prop_assert_eq!((0..4).map(|n| traffic.sent_by(home(n))).sum::<LinkCounters>(), total);
            prop_assert_eq!((0..4).map(|n| traffic.sent_to(home(n))).sum::<LinkCounters>(), total);
        }
    }
}
