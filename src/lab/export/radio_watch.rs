//! Collects what crossed the air: each packet once, as soon as its fate is known.

use crate::comms::radio::{RadioRecord, Transmission, TransmissionState};

/// What is known of the packets of a match.
#[derive(Clone, Debug, Default)]
pub(super) struct RadioWatch {
    /// Those that are under way, oldest first.
    under_way: Vec<Transmission>,
    /// The number of the first packet that has not been seen.
    next: u64,
}

impl RadioWatch {
    /// Packets that were sent before do not count.
    pub fn starting_at(record: &RadioRecord) -> RadioWatch {
        RadioWatch { under_way: Vec::new(), next: record.transmitted() }
    }

    /// The packets whose fate has become known since the last look, oldest first.
    pub fn look(&mut self, record: &RadioRecord) -> Vec<Transmission> {
        let oldest = self.under_way.first().map_or(self.next, |entry| entry.id);
        if self.under_way.is_empty() && self.next == record.transmitted() {
            return Vec::new();
        }
        let mut news: Vec<&Transmission> =
            record.transmissions().rev().take_while(|entry| entry.id >= oldest).collect();
        news.reverse();
        let known = std::mem::take(&mut self.under_way);
        let is_watched = |entry: &Transmission| {
            entry.id >= self.next || known.binary_search_by_key(&entry.id, |known| known.id).is_ok()
        };
        let (under_way, settled): (Vec<_>, Vec<_>) = (news.into_iter())
            .filter(|entry| is_watched(entry))
            .cloned()
            .partition(|entry| matches!(entry.state, TransmissionState::InFlight(_)));
        // The record forgets what was sent a minute ago, whatever has become of it.
        let first_kept = record.transmissions().next().map_or(record.transmitted(), |entry| entry.id);
        let forgotten = known.into_iter().take_while(|entry| entry.id < first_kept);
        let settled = forgotten.chain(settled).collect();
        (self.under_way, self.next) = (under_way, record.transmitted());
        settled
    }

    /// Those whose fate is not known.
    pub fn under_way(&self) -> impl Iterator<Item = &Transmission> {
        self.under_way.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock::Clock;
    use crate::comms::radio::{Delivery, Loss, Packet};
    use crate::comms::tcm::DataType;
    use crate::ids::{RobotId, Team};

    fn packet() -> Packet {
        let (from, to) = (RobotId::new(Team::Home, 1), RobotId::new(Team::Home, 2));
        Packet { kind: DataType::LOCK, from, to, bytes: [].into() }
    }

    #[test]
    fn each_packet_is_told_once_and_when_its_fate_is_known() {
        let mut record = RadioRecord::default();
        record.sent(&packet(), &Delivery::lost(Loss::Chance), 0);
        let mut watch = RadioWatch::starting_at(&record);
        assert_eq!(watch.look(&record).len(), 0, "it was sent before");
        let slow = record.sent(&packet(), &Delivery::on_time(4), 1);
        let fast = record.sent(&packet(), &Delivery::on_time(4), 1);
        record.sent(&packet(), &Delivery::lost(Loss::Range), 1);
        let ids = |settled: Vec<Transmission>| settled.iter().map(|entry| entry.id).collect::<Vec<_>>();
        assert_eq!(ids(watch.look(&record)), [3], "the lost one");
        record.delivered(fast, &packet(), 4);
        assert_eq!(ids(watch.look(&record)), [fast]);
        assert_eq!(watch.under_way().map(|entry| entry.id).collect::<Vec<_>>(), [slow]);
        record.lost(slow, &packet(), Loss::Deaf);
        let settled = watch.look(&record);
        assert_eq!(settled[0].state, TransmissionState::Lost(Loss::Deaf));
        assert_eq!(watch.look(&record), []);
    }

    #[test]
    fn a_packet_that_the_record_forgets_is_told_as_it_was() {
        let mut record = RadioRecord::default();
        let mut watch = RadioWatch::starting_at(&record);
        record.sent(&packet(), &Delivery::on_time(4), 1);
        assert_eq!(watch.look(&record), []);
        record.forget(&Clock { tick: 60_000, ..Clock::default() });
        let told = watch.look(&record);
        assert!(matches!(told[..], [Transmission { state: TransmissionState::InFlight(_), .. }]), "{told:?}");
        assert_eq!(watch.under_way().count(), 0);
    }
}
