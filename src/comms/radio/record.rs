//! The record of what crossed the air, the same for the simulated radio and for UDP: counters of each link and data type
//! since the match began, and every transmission of the last minute.
//!
//! Sent + duplicated = delivered + lost + what is still under way.

use std::collections::{BTreeMap, VecDeque};
use std::iter::Sum;
use std::ops::AddAssign;

use bevy::prelude::Resource;
use serde::{Deserialize, Serialize};

use super::channel::{Delivery, Loss};
use super::packet::Packet;
use crate::clock::Clock;
use crate::comms::messages::TeamMessage;
use crate::comms::tcm::DataType;
use crate::ids::RobotId;

/// What was sent in a match and how much of it arrived. Carriers keep it.
#[derive(Resource, Clone, Debug, Default)]
pub struct RadioRecord {
    links: BTreeMap<(RobotId, RobotId, DataType), LinkCounters>,
    /// Of the last minute, oldest first.
    transmissions: VecDeque<Transmission>,
    next_id: u64,
}

/// The packets of one directed link, or the sum over several.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct LinkCounters {
    /// Packets sent.
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

/// A packet that was sent. A broadcast is one to each team mate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Transmission {
    /// Counts the packets of a match.
    pub id: u64,
    /// What was sent.
    pub packet: Packet,
    /// The tick in which it was sent.
    pub sent: u64,
    /// Where it is.
    pub state: TransmissionState,
    /// It took longer than the radio's ordinary delay.
    pub late: bool,
    /// A second copy was on its way too.
    pub doubled: bool,
}

/// Where a packet is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransmissionState {
    /// It is to arrive in this tick.
    InFlight(u64),
    /// It arrived in this tick.
    Arrived(u64),
    /// It was lost.
    Lost(Loss),
}

impl Transmission {
    /// What it is called: the kind, and which attempt at a role swap it belongs to.
    pub fn label(&self) -> String {
        let kind = self.packet.kind;
        match self.packet.message() {
            Some(TeamMessage::RoleSwap(message)) => format!("{kind} {}", message.sequence()),
            _ => kind.to_string(),
        }
    }
}

/// How long transmissions are kept, s.
const KEPT: f32 = 60.0;

impl RadioRecord {
    /// A packet was sent, and its carrier makes this of it. Returns the number of the transmission.
    pub fn sent(&mut self, packet: &Packet, delivery: &Delivery, tick: u64) -> u64 {
        let link = self.link_of(packet);
        link.sent += 1;
        link.bytes += packet.bytes.len() as u64;
        if let Some(reason) = delivery.lost {
            link.lost[reason.index()] += 1;
        }
        link.late += delivery.arrivals.iter().filter(|arrival| arrival.late).count() as u64;
        link.duplicated += delivery.arrivals.iter().filter(|arrival| arrival.duplicate).count() as u64;
        let id = self.next_id;
        self.next_id += 1;
        self.transmissions.push_back(Transmission {
            id,
            packet: packet.clone(),
            sent: tick,
            state: match (delivery.arrivals.first(), delivery.lost) {
                (Some(arrival), _) => TransmissionState::InFlight(arrival.due),
                (None, loss) => TransmissionState::Lost(loss.unwrap_or(Loss::Chance)),
            },
            late: delivery.arrivals.iter().any(|arrival| arrival.late),
            doubled: delivery.arrivals.len() > 1,
        });
        id
    }

    /// A mute robot's packet did not go on air.
    pub fn drop_muted(&mut self, packet: &Packet, tick: u64) {
        self.sent(packet, &Delivery::lost(Loss::Mute), tick);
    }

    /// A packet or duplicate arrived.
    pub fn delivered(&mut self, id: u64, packet: &Packet, tick: u64) {
        self.link_of(packet).delivered += 1;
        self.settle(id, TransmissionState::Arrived(tick));
    }

    /// A packet or duplicate that was on its way was lost.
    pub fn lost(&mut self, id: u64, packet: &Packet, reason: Loss) {
        self.link_of(packet).lost[reason.index()] += 1;
        self.settle(id, TransmissionState::Lost(reason));
    }

    /// A packet that was lost is sent once more by hand, as a duplicate that arrives in this tick. Returns it, if it is still
    /// known and was lost.
    pub(super) fn send_again(&mut self, id: u64, due: u64) -> Option<Packet> {
        let entry = self.transmissions.iter_mut().find(|entry| entry.id == id)?;
        if !matches!(entry.state, TransmissionState::Lost(_)) {
            return None;
        }
        (entry.state, entry.late) = (TransmissionState::InFlight(due), true);
        let packet = entry.packet.clone();
        let link = self.link_of(&packet);
        (link.duplicated, link.late) = (link.duplicated + 1, link.late + 1);
        Some(packet)
    }

    fn link_of(&mut self, packet: &Packet) -> &mut LinkCounters {
        self.links.entry((packet.from, packet.to, packet.kind)).or_default()
    }

    /// The first copy to arrive settles the state of a transmission.
    fn settle(&mut self, id: u64, state: TransmissionState) {
        let first = self.transmissions.front().map_or(self.next_id, |entry| entry.id);
        let entry = id.checked_sub(first).and_then(|index| self.transmissions.get_mut(index as usize));
        if let Some(entry) = entry.filter(|entry| matches!(entry.state, TransmissionState::InFlight(_))) {
            entry.state = state;
        }
    }

    /// Forgets the transmissions of more than a minute ago.
    pub fn forget(&mut self, clock: &Clock) {
        let kept = clock.ticks(KEPT);
        while self.transmissions.front().is_some_and(|entry| entry.sent + kept < clock.tick) {
            self.transmissions.pop_front();
        }
    }

    /// The transmissions of the last minute, oldest first.
    pub fn transmissions(&self) -> impl DoubleEndedIterator<Item = &Transmission> + '_ {
        self.transmissions.iter()
    }

    /// Transmissions since the match began.
    pub fn transmitted(&self) -> u64 {
        self.next_id
    }

    /// The packets of those links and kinds, by sender and receiver, that count.
    pub fn sum(&self, counts: impl Fn(RobotId, RobotId, DataType) -> bool) -> LinkCounters {
        let links = self.links.iter().filter(|((from, to, kind), _)| counts(*from, *to, *kind));
        links.map(|(_, counters)| *counters).sum()
    }

    /// One link; all zero if nothing was sent on it.
    pub fn link(&self, from: RobotId, to: RobotId) -> LinkCounters {
        self.sum(|sender, receiver, _| (sender, receiver) == (from, to))
    }

    /// All that one robot sent.
    pub fn sent_by(&self, robot: RobotId) -> LinkCounters {
        self.sum(|from, _, _| from == robot)
    }

    /// All that was sent to one robot.
    pub fn sent_to(&self, robot: RobotId) -> LinkCounters {
        self.sum(|_, to, _| to == robot)
    }

    /// The packets of one kind, from a robot or any, to a robot or any.
    pub fn of_kind(&self, kind: DataType, from: Option<RobotId>, to: Option<RobotId>) -> LinkCounters {
        self.sum(|sender, receiver, of| {
            of == kind && from.is_none_or(|from| from == sender) && to.is_none_or(|to| to == receiver)
        })
    }

    /// All of the match.
    pub fn total(&self) -> LinkCounters {
        self.sum(|_, _, _| true)
    }
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

    /// Packets that went on air: what a mute robot wants to send does not.
    pub fn on_air(&self) -> u64 {
        self.sent - self.lost_to(Loss::Mute)
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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::comms::radio::channel::Arrival;
    use crate::ids::Team;

    fn home(number: u8) -> RobotId {
        RobotId::new(Team::Home, number)
    }

    fn packet(from: u8, to: u8, bytes: usize) -> Packet {
        Packet { kind: DataType::POSITION, from: home(from), to: home(to), bytes: vec![0; bytes].into() }
    }

    fn arriving(copies: usize, late: bool) -> Delivery {
        let arrivals = (0..copies).map(|place| Arrival { due: 3, late, duplicate: place > 0 });
        Delivery { arrivals: arrivals.collect(), lost: None }
    }

    #[test]
    fn every_reason_has_its_own_place() {
        for (place, reason) in Loss::ALL.into_iter().enumerate() {
            assert_eq!(reason.index(), place);
        }
    }

    #[test]
    fn a_packet_is_under_way_until_it_arrives_or_is_lost() {
        let mut record = RadioRecord::default();
        let first = record.sent(&packet(0, 1, 20), &arriving(1, false), 0);
        record.sent(&packet(0, 1, 30), &Delivery::lost(Loss::Range), 0);
        let late = record.sent(&packet(0, 1, 50), &arriving(1, true), 0);
        assert_eq!(record.total().under_way(), 2);
        record.delivered(first, &packet(0, 1, 20), 3);
        record.lost(late, &packet(0, 1, 50), Loss::Deaf);
        let link = record.link(home(0), home(1));
        assert_eq!((link.sent, link.delivered, link.late, link.under_way(), link.bytes), (3, 1, 1, 0, 100));
        assert_eq!((link.lost_to(Loss::Range), link.lost_to(Loss::Deaf), link.lost_in_all()), (1, 1, 2));
        let states: Vec<_> = record.transmissions().map(|entry| entry.state).collect();
        let lost = TransmissionState::Lost;
        assert_eq!(states, [TransmissionState::Arrived(3), lost(Loss::Range), lost(Loss::Deaf)]);
    }

    #[test]
    fn a_duplicate_is_under_way_like_a_packet_but_is_not_sent() {
        let mut record = RadioRecord::default();
        let id = record.sent(&packet(0, 1, 20), &arriving(3, true), 0);
        record.delivered(id, &packet(0, 1, 20), 3);
        let total = record.total();
        assert_eq!((total.sent, total.duplicated, total.late, total.bytes), (1, 2, 3, 20));
        assert_eq!((total.delivered, total.under_way()), (1, 2));
    }

    #[test]
    fn a_lost_packet_that_is_sent_again_by_hand_is_a_duplicate_under_way() {
        let mut record = RadioRecord::default();
        let id = record.sent(&packet(0, 1, 20), &Delivery::lost(Loss::Chance), 0);
        assert_eq!(record.send_again(id, 5), Some(packet(0, 1, 20)));
        assert_eq!(record.send_again(id, 5), None, "it is on its way");
        assert_eq!(record.send_again(id + 1, 5), None, "nobody sent it");
        assert_eq!(record.total().under_way(), 1);
        record.delivered(id, &packet(0, 1, 20), 5);
        let total = record.total();
        assert_eq!((total.sent, total.lost_in_all(), total.delivered, total.under_way()), (1, 1, 1, 0));
        assert_eq!(record.transmissions().next().map(|sent| sent.state), Some(TransmissionState::Arrived(5)));
    }

    #[test]
    fn a_link_without_traffic_counts_nothing() {
        let mut record = RadioRecord::default();
        record.sent(&packet(2, 1, 20), &arriving(1, false), 0);
        assert_eq!(record.link(home(1), home(2)), LinkCounters::default());
        assert_eq!(record.link(home(2), home(1)).sent, 1);
    }

    #[test]
    fn packets_are_counted_by_kind_sender_and_receiver() {
        let mut record = RadioRecord::default();
        let id = record.sent(&packet(1, 2, 20), &arriving(1, false), 0);
        record.sent(&packet(1, 3, 20), &arriving(1, false), 0);
        record.drop_muted(&packet(2, 3, 20), 0);
        record.delivered(id, &packet(1, 2, 20), 3);
        let positions = |from: Option<u8>, to: Option<u8>| {
            let count = record.of_kind(DataType::POSITION, from.map(home), to.map(home));
            (count.on_air(), count.delivered)
        };
        assert_eq!(positions(None, None), (2, 1));
        assert_eq!(positions(Some(1), Some(3)), (1, 0));
        assert_eq!(positions(Some(2), None), (0, 0), "it is mute");
        assert_eq!(positions(Some(1), None), (2, 1));
        assert_eq!(record.of_kind(DataType::LOCK, None, None), LinkCounters::default());
    }

    proptest! {
        #[test]
        fn totals_by_sender_and_by_receiver_add_up_to_the_whole(
            sends in prop::collection::vec((0u8..4, 0u8..4, 0usize..100, 0usize..12), 0..60),
        ) {
            let mut record = RadioRecord::default();
            for &(from, to, bytes, reason) in &sends {
                let copies = 1 + bytes % 3;
                let lost = Loss::ALL.get(reason).map(|reason| Delivery::lost(*reason));
                let delivery = lost.unwrap_or_else(|| arriving(copies, bytes > 50));
                let id = record.sent(&packet(from, to, bytes), &delivery, 0);
                for _ in &delivery.arrivals {
                    record.delivered(id, &packet(from, to, bytes), 3);
                }
            }
            let total = record.total();
            prop_assert_eq!((total.sent, record.transmitted()), (sends.len() as u64, sends.len() as u64));
            prop_assert_eq!(total.under_way(), 0);
            prop_assert_eq!((0..4).map(|n| record.sent_by(home(n))).sum::<LinkCounters>(), total);
            prop_assert_eq!((0..4).map(|n| record.sent_to(home(n))).sum::<LinkCounters>(), total);
        }
    }
}
