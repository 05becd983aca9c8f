//! The league's network for team messages: its ports, how long a message may be and how many a team may send.
//!
//! Referee boxes listen at the ports of both teams and count. A message too many or too long costs the team its goals.

use super::control::Version;

/// The port of a team's messages is this and the team's number.
const PORTS: u16 = 10_000;

/// The UDP port for the messages of the team with this number.
pub fn port_of(team_number: u8) -> u16 {
    PORTS + u16::from(team_number)
}

impl Version {
    /// The longest team message, bytes.
    pub const fn longest_message(self) -> usize {
        match self {
            Version::V18 => 128,
            Version::V19 | Version::V20 => 512,
        }
    }

    /// Messages that a team may send in the two halves of a match.
    pub const fn message_budget(self) -> u64 {
        match self {
            Version::V18 => 1_200,
            Version::V19 | Version::V20 => 12_000,
        }
    }

    /// Messages that a team may send more when there is extra time.
    pub const fn extra_time_budget(self) -> u64 {
        match self {
            Version::V18 => 0,
            Version::V19 | Version::V20 => 6_000,
        }
    }
}
