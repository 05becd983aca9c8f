//! For the tests: robots and transmissions.

use crate::comms::messages::MessageKind;
use crate::comms::radio::{Outcome, Transmission};
use crate::ids::{RobotId, Team};

pub fn home(number: u8) -> RobotId {
    RobotId::new(Team::Home, number)
}

/// A transmission between two robots of home, with sequence number 7.
pub fn transmission(kind: MessageKind, from: u8, to: u8, sent: u64, outcome: Outcome) -> Transmission {
    Transmission {
        id: 0,
        kind,
        sequence: Some(7),
        from: home(from),
        to: home(to),
        sent,
        outcome,
        late: false,
        doubled: false,
    }
}
