//! What the radio carries.

use std::sync::Arc;

use bevy::prelude::{Component, Reflect, ReflectComponent};

use crate::comms::messages::TeamMessage;
use crate::comms::tcm::fragments::Header;
use crate::comms::tcm::{Data, DataType, Datagram};
use crate::ids::RobotId;

/// A datagram from one robot to one other.
#[derive(Clone, Debug, PartialEq, Eq, Reflect)]
#[reflect(from_reflect = false)]
pub struct Packet {
    /// What the message is about of which it brings a piece.
    pub kind: DataType,
    /// The sender.
    pub from: RobotId,
    /// The receiver.
    pub to: RobotId,
    /// The length of the datagram.
    #[reflect(ignore)]
    pub bytes: Arc<[u8]>,
}

impl Packet {
    /// The packet that a datagram is; `None` if it is for a computer.
    pub fn of(datagram: &Datagram) -> Option<Packet> {
        let (from, to) = (datagram.from, datagram.to.robot()?);
        Some(Packet { kind: datagram.kind, from, to, bytes: datagram.bytes.clone() })
    }

    /// The message that it brings; nothing, if it brings a piece of one.
    pub fn message(&self) -> Option<TeamMessage> {
        let (header, data) = Header::read(&self.bytes).ok()?;
        TeamMessage::unserialise(header.data_type, data)
    }
}

/// A packet, or a second copy of it, on its way.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[component(immutable)]
#[reflect(Component, from_reflect = false)]
pub struct InFlight {
    /// That of its [`Transmission`](super::Transmission).
    pub id: u64,
    /// What is under way.
    pub packet: Packet,
    /// The tick in which it arrives.
    pub due: u64,
    /// It takes longer than the radio's ordinary delay.
    pub late: bool,
}
