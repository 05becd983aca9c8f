//! Which of ChaosManager's messages goes over which of its sockets (TeamChaos, section 3: the TCM opens four UDP sockets, three of
//! them for ChaosManager, and the other one for communication among robots).

use std::net::SocketAddr;

use crate::comms::tcm::DataType;
use data_types::{ANSWER, CAMERA, DEBUG, IMAGE, SET_CAMERA, SET_COLOURS, STRATEGY, SUBSCRIBE, TELEOPERATE};

/// The data types of ChaosManager by their numbers on the wire.
pub(super) mod data_types {
    use crate::comms::tcm::DataType;

    pub const SUBSCRIBE: DataType = DataType(21);
    pub const IMAGE: DataType = DataType(22);
    pub const CAMERA: DataType = DataType(23);
    pub const DEBUG: DataType = DataType(24);
    pub const SET_CAMERA: DataType = DataType(25);
    pub const SET_COLOURS: DataType = DataType(26);
    pub const STRATEGY: DataType = DataType(27);
    pub const TELEOPERATE: DataType = DataType(28);
    pub const ANSWER: DataType = DataType(29);
}

/// One of the three sockets, by its place after the first port.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ChaosSocket {
    /// Pictures go out.
    Images,
    /// What robots believe and want goes out, and how their cameras are calibrated.
    Data,
    /// Orders come in, and answers go out.
    Orders,
}

/// The table.
const TABLE: [(DataType, ChaosSocket); 9] = [
    (IMAGE, ChaosSocket::Images),
    (CAMERA, ChaosSocket::Data),
    (DEBUG, ChaosSocket::Data),
    (SUBSCRIBE, ChaosSocket::Orders),
    (SET_CAMERA, ChaosSocket::Orders),
    (SET_COLOURS, ChaosSocket::Orders),
    (STRATEGY, ChaosSocket::Orders),
    (TELEOPERATE, ChaosSocket::Orders),
    (ANSWER, ChaosSocket::Orders),
];

impl ChaosSocket {
    /// All of them, in the order of their ports.
    pub const ALL: [ChaosSocket; 3] = [ChaosSocket::Images, ChaosSocket::Data, ChaosSocket::Orders];

    /// The socket over which a type of data goes.
    pub fn of(data_type: DataType) -> Option<ChaosSocket> {
        TABLE.iter().find(|(known, _)| *known == data_type).map(|(_, socket)| *socket)
    }

    /// Where it is if the first of the three is at `first`; nothing, if ports do not reach.
    pub fn address(self, first: SocketAddr) -> Option<SocketAddr> {
        let port = first.port().checked_add(self as u16).filter(|_| first.port() > 0)?;
        Some(SocketAddr::new(first.ip(), port))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_ports_follow_each_other_and_do_not_run_over() {
        let at = |port| SocketAddr::from(([127, 0, 0, 1], port));
        let all = |port| ChaosSocket::ALL.map(|socket| socket.address(at(port)));
        assert_eq!(all(7500), [Some(at(7500)), Some(at(7501)), Some(at(7502))]);
        assert_eq!(all(65_534), [Some(at(65_534)), Some(at(65_535)), None]);
        assert_eq!(all(0), [None; 3]);
    }

    #[test]
    fn every_type_has_one_socket() {
        let of = |number| ChaosSocket::of(DataType(number));
        assert!((21..=29).all(|number| of(number).is_some()));
        assert_eq!((of(20), of(30)), (None, None));
        assert!(TABLE.iter().all(|(known, _)| TABLE.iter().filter(|(other, _)| known == other).count() == 1));
    }
}
