//! What cannot be done with a network.

use std::net::SocketAddr;
use std::time::Duration;

use crate::comms::tcm::Peer;
use crate::comms::tcm::udp::UdpError;
use crate::data::DataError;
use crate::ids::RobotId;

/// What cannot be done with a network.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum NetworkError {
    /// A socket failed.
    #[error(transparent)]
    Udp(#[from] UdpError),
    /// An entity of the match has no address.
    #[error("{0} has no address: add it to the addresses")]
    NoAddress(Peer),
    /// There are not three ports from this one on.
    #[error("{0} is not the first of three ports for ChaosManager: give one from 1 to 65533")]
    NoPorts(SocketAddr),
    /// No match has answered ChaosManager in time.
    #[error("no match answers ChaosManager at {address} within {} s: start it with `--chaos {address}`",
        patience.as_secs_f32())]
    NoAnswer { address: SocketAddr, patience: Duration },
    /// No referee box was heard in time.
    #[error("no referee box was heard at {address} within {} s", patience.as_secs_f32())]
    NoBox { address: SocketAddr, patience: Duration },
    /// A robot did not answer in time.
    #[error("{robot} has not answered at {address} for {} s: start it with `{}`", patience.as_secs_f32(), start(*robot))]
    Silent { robot: RobotId, address: SocketAddr, patience: Duration },
    /// A robot heard of no match in time.
    #[error("no match has greeted {robot} at {address} for {} s: start it with `touchline run --remote {}:{}`",
        patience.as_secs_f32(), robot.team, robot.number)]
    NoMatch { robot: RobotId, address: SocketAddr, patience: Duration },
    /// A robot plays another match.
    #[error("{robot} does not belong to the match at {address}: {difference}")]
    OtherMatch { robot: RobotId, address: SocketAddr, difference: String },
}

/// What starts a robot in a process of its own, but for the options of its match.
pub fn start(robot: RobotId) -> String {
    format!("touchline robot --team {} --number {}", robot.team, robot.number)
}

impl From<NetworkError> for DataError {
    fn from(error: NetworkError) -> DataError {
        DataError::new("network", error.to_string())
    }
}
