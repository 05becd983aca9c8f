//! What could have gone otherwise in a stretch of a match.

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

use crate::comms::radio::{FaultRule, Loss, RadioRecord, Transmission, TransmissionState};
use crate::comms::tcm::DataType;
use crate::game::requests::{RadioChange, Request, RobotChange};
use crate::ids::RobotId;
use crate::robot::RobotFailure;

/// Something that could have gone otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The first tick that goes another way.
    pub tick: u64,
    /// What is done.
    pub meddling: Meddling,
}

/// What is done to the match.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Meddling {
    /// A packet that was lost for this reason arrives.
    Deliver { packet: PacketName, reason: Loss },
    /// A packet that arrived is lost.
    Drop(PacketName),
    /// What a robot says of one kind is heard by nobody, from the tick of the candidate until before another one.
    Unheard { kind: DataType, from: RobotId, until: u64 },
    /// A robot does not crash.
    NoCrash(RobotId),
}

/// A packet for people, and its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PacketName {
    /// That of its transmission.
    pub id: u64,
    /// The kind of message.
    pub kind: DataType,
    /// The sender.
    pub from: RobotId,
    /// The receiver.
    pub to: RobotId,
}

/// Messages of one kind from one robot that follow each other this closely are one deed, s.
const DEED: f32 = 1.5;

/// What of a kind of message is called when a robot does it.
fn deed(kind: DataType) -> Option<&'static str> {
    match kind {
        DataType::LOCK => Some("swap"),
        DataType::HAVE_BALL => Some("claim"),
        DataType::BOOK => Some("booking"),
        _ => None,
    }
}

/// Whether a protocol rests on messages of this kind, and what else robots say does not.
fn is_of_a_protocol(kind: DataType) -> bool {
    [DataType::LOCK, DataType::ACK_LOCK, DataType::SWAP, DataType::ACK_SWAP, DataType::BOOK].contains(&kind)
}

/// What could have gone otherwise with the packets that were sent from a tick on.
pub(super) fn of_packets(radio: &RadioRecord, from: u64, dt: f32) -> Vec<Candidate> {
    let sent: Vec<&Transmission> = radio.transmissions().filter(|sent| sent.sent >= from).collect();
    let singles = sent.iter().filter_map(|transmission| {
        let Transmission { id, packet, sent, state, .. } = transmission;
        let packet = PacketName { id: *id, kind: packet.kind, from: packet.from, to: packet.to };
        let meddling = match *state {
            TransmissionState::Lost(reason) => Meddling::Deliver { packet, reason },
            TransmissionState::Arrived(_) if is_of_a_protocol(packet.kind) => Meddling::Drop(packet),
            _ => return None,
        };
        Some(Candidate { tick: sent + 1, meddling })
    });
    singles.chain(deeds(&sent, dt)).collect()
}

/// The swaps, claims and bookings among some packets, none of which is heard.
fn deeds(sent: &[&Transmission], dt: f32) -> Vec<Candidate> {
    let gap = (DEED / dt) as u64;
    let mut said: BTreeMap<(DataType, RobotId), Vec<(u64, u64)>> = BTreeMap::new();
    for transmission in sent.iter().filter(|sent| deed(sent.packet.kind).is_some()) {
        let spans = said.entry((transmission.packet.kind, transmission.packet.from)).or_default();
        match spans.last_mut().filter(|(_, last)| transmission.sent <= *last + gap) {
            Some((_, last)) => *last = transmission.sent,
            None => spans.push((transmission.sent, transmission.sent)),
        }
    }
    let candidate = |(kind, from): (DataType, RobotId), (tick, last): (u64, u64)| Candidate {
        tick,
        meddling: Meddling::Unheard { kind, from, until: last + 1 },
    };
    said.into_iter()
        .flat_map(|(who, spans)| spans.into_iter().map(move |span| candidate(who, span)))
        .collect()
}

/// The crashes that were asked for from a tick on and before another.
pub(super) fn of_crashes(script: &[(u64, Request)], from: u64, until: u64) -> Vec<Candidate> {
    let crashes = script.iter().filter(|(tick, _)| (from..until).contains(tick));
    let crash = |(tick, request): &(u64, Request)| {
        let robot = crashed(request)?;
        Some(Candidate { tick: *tick, meddling: Meddling::NoCrash(robot) })
    };
    crashes.filter_map(crash).collect()
}

/// The robot that a request lets crash.
fn crashed(request: &Request) -> Option<RobotId> {
    match request {
        Request::Robot(robot, RobotChange::Fail(RobotFailure::Crashed)) => Some(*robot),
        _ => None,
    }
}

impl Candidate {
    /// The requests of the match with this change.
    pub fn applied(&self, script: &[(u64, Request)], dt: f32) -> Vec<(u64, Request)> {
        let mut script = script.to_vec();
        match &self.meddling {
            Meddling::NoCrash(robot) => {
                script.retain(|(tick, request)| *tick != self.tick || crashed(request) != Some(*robot));
            }
            _ => script.extend(self.request(dt).map(|request| (self.tick, request))),
        }
        script
    }

    fn request(&self, dt: f32) -> Option<Request> {
        let change = match &self.meddling {
            Meddling::Deliver { packet, .. } => RadioChange::Deliver(packet.id),
            Meddling::Drop(packet) => RadioChange::Drop(packet.id),
            Meddling::Unheard { kind, from, until } => {
                RadioChange::Fault(FaultRule::silencing(*kind, *from, self.tick..*until, dt))
            }
            Meddling::NoCrash(_) => return None,
        };
        Some(Request::Radio(change))
    }
}

impl fmt::Display for PacketName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the {} from {} to {}", self.kind, self.from, self.to)
    }
}

impl fmt::Display for Meddling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Meddling::Deliver { packet, reason } => write!(f, "{packet} arrives, which was lost ({reason})"),
            Meddling::Drop(packet) => write!(f, "{packet} is lost, which arrived"),
            Meddling::Unheard { kind, from, .. } => {
                write!(f, "the {} of {from} is heard by nobody", deed(*kind).unwrap_or("message"))
            }
            Meddling::NoCrash(robot) => write!(f, "{robot} does not crash"),
        }
    }
}

/// In words.
impl Serialize for Meddling {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
