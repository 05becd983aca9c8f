//! What waits to leave one of ChaosManager's sockets: a bounded queue of messages, each cut into datagrams. If it is full, the
//! oldest message goes, and one that has begun to leave is finished. A tick sends a bounded number of datagrams.

use std::net::SocketAddr;
use std::vec::IntoIter;

use serde::Serialize;

use crate::comms::tcm::Module;
use crate::comms::tcm::fragments::{USUAL_DATAGRAM, cut};
use crate::comms::tcm::queues::{QueueRule, Queues, WhenFull};
use crate::comms::tcm::{Data, ExternalMessage, Peer};
use crate::ids::RobotId;

/// Messages on their way out of one socket.
#[derive(Debug)]
pub(super) struct Outbox {
    waiting: Queues<Parcel>,
    leaving: Option<(SocketAddr, IntoIter<Vec<u8>>)>,
    datagrams_a_tick: usize,
    counter: u32,
    figures: OutboxFigures,
}

/// A message for one receiver.
#[derive(Debug)]
struct Parcel {
    to: SocketAddr,
    datagrams: Vec<Vec<u8>>,
}

/// Counts of the messages of one socket: put in = sent + dropped + waiting or leaving.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct OutboxFigures {
    /// Messages that were to be sent.
    pub put_in: u64,
    /// Messages that were sent whole.
    pub sent: u64,
    /// Messages that went for want of room, the oldest first.
    pub dropped: u64,
    /// Datagrams sent.
    pub datagrams: u64,
    /// Bytes of those.
    pub bytes: u64,
    /// Datagrams that the operating system did not take.
    pub refused: u64,
}

impl Outbox {
    /// A queue for so many messages that sends so many datagrams in a tick. Messages are counted from `counter` on.
    pub fn new(capacity: usize, datagrams_a_tick: usize, counter: u32) -> Outbox {
        Outbox {
            waiting: Queues::new(QueueRule { capacity, when_full: WhenFull::DropOldest }),
            leaving: None,
            datagrams_a_tick,
            counter,
            figures: OutboxFigures::default(),
        }
    }

    /// What was counted so far.
    pub fn figures(&self) -> OutboxFigures {
        self.figures
    }

    /// Puts what a robot says to a computer at the end of the queue.
    pub fn put<T: Data>(&mut self, data: &T, from: RobotId, (peer, to): (Peer, SocketAddr)) {
        self.counter = self.counter.wrapping_add(1);
        let message = ExternalMessage::of(data, from.into(), peer);
        self.figures.put_in += 1;
        let Ok(datagrams) = cut(&message, self.counter, USUAL_DATAGRAM) else {
            self.figures.dropped += 1;
            return;
        };
        let dropped = self.waiting.push(Module::CHAOS_MANAGER, Parcel { to, datagrams });
        self.figures.dropped += u64::from(dropped.is_some());
    }

    /// Sends as much as a tick may; `send` tells whether a datagram was taken.
    pub fn send(&mut self, send: &mut dyn FnMut(SocketAddr, &[u8]) -> bool) {
        for _ in 0..self.datagrams_a_tick {
            let Some((to, datagram)) = self.next() else { return };
            if send(to, &datagram) {
                self.figures.datagrams += 1;
                self.figures.bytes += datagram.len() as u64;
            } else {
                self.figures.refused += 1;
            }
            if self.leaving.as_ref().is_some_and(|(_, rest)| rest.len() == 0) {
                self.leaving = None;
                self.figures.sent += 1;
            }
        }
    }

    fn next(&mut self) -> Option<(SocketAddr, Vec<u8>)> {
        if self.leaving.is_none() {
            let Parcel { to, datagrams } = self.waiting.take(1).pop()?;
            self.leaving = Some((to, datagrams.into_iter()));
        }
        let (to, rest) = self.leaving.as_mut()?;
        Some((*to, rest.next()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comms::messages::TeamMessage;
    use crate::comms::tcm::fragments::{Assembly, Limits};
    use crate::ids::Team;

    const ROBOT: RobotId = RobotId::new(Team::Home, 1);

    fn receiver() -> (Peer, SocketAddr) {
        (Peer::Computer(0), SocketAddr::from(([127, 0, 0, 1], 9)))
    }

    /// The texts that one tick completes.
    fn tick(outbox: &mut Outbox, assembly: &mut Assembly) -> (usize, Vec<usize>) {
        let (mut datagrams, mut texts) = (0, Vec::new());
        outbox.send(&mut |to, datagram| {
            assert_eq!(to, receiver().1);
            datagrams += 1;
            if let Some(message) = assembly.accept(0, datagram).unwrap() {
                let Some(TeamMessage::Text(text)) =
                    TeamMessage::unserialise(message.data_type, &message.data)
                else {
                    panic!("it is a text")
                };
                texts.push(text.len());
            }
            true
        });
        (datagrams, texts)
    }

    #[test]
    fn the_oldest_that_has_not_begun_to_leave_goes_and_everything_is_counted() {
        let mut outbox = Outbox::new(2, 3, 0);
        let mut assembly = Assembly::new(Limits::default());
        // Four datagrams each.
        let put =
            |outbox: &mut Outbox, bytes| outbox.put(&TeamMessage::Text("x".repeat(bytes)), ROBOT, receiver());
        put(&mut outbox, 5_000);
        assert_eq!(tick(&mut outbox, &mut assembly), (3, vec![]));
        for bytes in [5_001, 5_002, 5_003] {
            put(&mut outbox, bytes);
        }
        let figures = outbox.figures();
        assert_eq!((figures.put_in, figures.sent, figures.dropped), (4, 0, 1));
        assert_eq!(tick(&mut outbox, &mut assembly), (3, vec![5_000]));
        assert_eq!(tick(&mut outbox, &mut assembly), (3, vec![5_002]));
        assert_eq!(tick(&mut outbox, &mut assembly), (3, vec![5_003]));
        assert_eq!(tick(&mut outbox, &mut assembly), (0, vec![]));
        let figures = outbox.figures();
        assert_eq!((figures.put_in, figures.sent, figures.dropped), (4, 3, 1));
        assert_eq!((figures.datagrams, figures.refused), (12, 0));
    }

    #[test]
    fn what_the_system_does_not_take_is_counted_and_does_not_block() {
        let mut outbox = Outbox::new(2, 8, 0);
        outbox.put(&TeamMessage::Text("hello".into()), ROBOT, receiver());
        outbox.send(&mut |_, _| false);
        let figures = outbox.figures();
        assert_eq!((figures.sent, figures.refused, figures.datagrams, figures.bytes), (1, 1, 0, 0));
    }
}
