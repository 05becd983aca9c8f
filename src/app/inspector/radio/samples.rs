//! For the tests: robots and transmissions.

use crate::comms::messages::TeamMessage;
use crate::comms::radio::{Packet, Transmission, TransmissionState};
use crate::comms::tcm::fragments::{USUAL_DATAGRAM, cut};
use crate::comms::tcm::{DataType, ExternalMessage};
use crate::ids::{RobotId, Team};

pub fn home(number: u8) -> RobotId {
    RobotId::new(Team::Home, number)
}

/// A transmission between two robots of home, without its bytes.
pub fn transmission(kind: DataType, from: u8, to: u8, sent: u64, state: TransmissionState) -> Transmission {
    let packet = Packet { kind, from: home(from), to: home(to), bytes: [].into() };
    Transmission { id: 0, packet, sent, state, late: false, doubled: false }
}

/// The transmission of a whole message between two robots of home.
pub fn transmitted(
    message: &TeamMessage,
    from: u8,
    to: u8,
    sent: u64,
    state: TransmissionState,
) -> Transmission {
    let message = ExternalMessage::of(message, home(from).into(), home(to).into());
    let bytes = cut(&message, 1, USUAL_DATAGRAM).expect("it is short").remove(0);
    let mut transmission = transmission(message.data_type, from, to, sent, state);
    transmission.packet.bytes = bytes.into();
    transmission
}
