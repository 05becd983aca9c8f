//! The radio of a model: the messages in flight, and what may happen to them.

use touchline::ids::PlayerNumber;
use touchline::protocol::role_swap::Message;

/// A message in flight.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Envelope {
    pub from: PlayerNumber,
    pub to: PlayerNumber,
    pub message: Message,
    /// A SWAP that rolls back, or the acknowledgement of one. The robots cannot see it.
    pub roll_back: bool,
}

/// What a radio does to messages. All of them may be delayed without bound.
#[derive(Clone, Copy, Debug)]
pub struct Radio {
    /// Messages of one robot to another keep their order.
    pub ordered: bool,
    pub loss: Loss,
    /// So many deliveries may leave a copy behind.
    pub duplicates: u8,
    /// At most so many equal messages are in flight; a further one is not sent.
    pub alike: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss {
    Never,
    AtMost(u8),
    /// At most so many, and only ACKLOCK and ACKSWAP.
    AcknowledgementsAtMost(u8),
    Any,
}

impl Radio {
    pub const RELIABLE: Radio = Radio { ordered: false, loss: Loss::Never, duplicates: 0, alike: 2 };
    pub const LOSSY: Radio = Radio { loss: Loss::Any, ..Radio::RELIABLE };

    pub fn losing(losses: u8) -> Radio {
        Radio { loss: Loss::AtMost(losses), ..Radio::RELIABLE }
    }

    pub fn doubling(self, duplicates: u8) -> Radio {
        Radio { duplicates, ..self }
    }

    pub fn in_order(self) -> Radio {
        Radio { ordered: true, ..self }
    }
}

/// The messages in flight, as a multiset if the radio keeps no order, else in order on each link.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Network {
    in_flight: Vec<Envelope>,
}

impl Network {
    pub fn in_flight(&self) -> &[Envelope] {
        &self.in_flight
    }

    pub fn send(&mut self, radio: Radio, envelope: Envelope) {
        if self.in_flight.iter().filter(|other| **other == envelope).count() >= radio.alike {
            return;
        }
        let place = if radio.ordered {
            let link = (envelope.from, envelope.to);
            self.in_flight.partition_point(|other| (other.from, other.to) <= link)
        } else {
            self.in_flight.partition_point(|other| *other <= envelope)
        };
        self.in_flight.insert(place, envelope);
    }

    pub fn remove(&mut self, index: usize) -> Envelope {
        self.in_flight.remove(index)
    }

    /// Drops the messages at these places.
    pub fn drop_all(&mut self, places: &[usize]) {
        let mut place = 0..;
        self.in_flight.retain(|_| place.next().is_some_and(|place| !places.contains(&place)));
    }

    /// The places of the messages that may arrive next.
    pub fn deliverable(&self, radio: Radio) -> impl Iterator<Item = usize> {
        self.first_of_each(move |a, b| if radio.ordered { (a.from, a.to) == (b.from, b.to) } else { a == b })
    }

    /// The places of the messages that may be lost, after so many losses; of equal ones the first.
    pub fn losable(&self, radio: Radio, losses: u8) -> impl Iterator<Item = usize> {
        self.first_of_each(|a, b| a == b).filter(move |place| match radio.loss {
            Loss::Never => false,
            Loss::AtMost(most) => losses < most,
            Loss::AcknowledgementsAtMost(most) => {
                let message = &self.in_flight[*place].message;
                losses < most && matches!(message, Message::AckLock { .. } | Message::AckSwap { .. })
            }
            Loss::Any => true,
        })
    }

    fn first_of_each(&self, same: impl Fn(&Envelope, &Envelope) -> bool) -> impl Iterator<Item = usize> {
        (0..self.in_flight.len()).filter(move |place| {
            let before = place.checked_sub(1).map(|before| &self.in_flight[before]);
            before.is_none_or(|before| !same(before, &self.in_flight[*place]))
        })
    }

    pub fn any(&self, from: PlayerNumber, to: PlayerNumber, matches: impl Fn(&Message) -> bool) -> bool {
        self.in_flight.iter().any(|e| (e.from, e.to) == (from, to) && matches(&e.message))
    }
}
