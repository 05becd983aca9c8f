//! What robots of a team say to each other, and how it crosses the radio: as bytes.
//!
//! The wire format is [postcard](https://postcard.jamesmunns.com/wire-format): a message is its kind as one byte, then its
//! fields in their order; `u8` as they are, larger integers and lengths as little-endian base 128, `f32` as four
//! little-endian bytes, `bool` and variants as one byte.

use std::fmt;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

use crate::protocol::role_swap;

/// A message of one robot to its team mates. The first three are those of figure 3, with its fields.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Message {
    Position(Position),
    HaveBall(HaveBall),
    Goalie(GoalieNews),
    RoleSwap(role_swap::Message),
    Values(Values),
}

/// Where the sender is; sent by every player again and again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Position {
    /// Milliseconds on the sender's clock.
    pub time: u32,
    pub robot: u8,
    /// m in the team frame.
    pub position: Vec2,
    /// A unit vector in the team frame.
    pub heading: Vec2,
    /// The roles that the sender knows of; carried by the hardened role swap only.
    pub configuration: Option<role_swap::Configuration>,
}

/// Sent while the sender performs an acquire behaviour within 1 m of the ball, and once when that ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HaveBall {
    /// Milliseconds on the sender's clock.
    pub time: u32,
    pub robot: u8,
    pub have_ball: bool,
    /// An index into the strategy's roles.
    pub role: role_swap::RoleIndex,
}

/// Sent by the goalie when it leaves or enters the penalty area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GoalieNews {
    /// Milliseconds on the sender's clock.
    pub time: u32,
    pub robot: u8,
    pub behaviour: GoalieBehaviour,
    pub side: Side,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum GoalieBehaviour {
    Leaving,
    Entering,
}

/// A side of the goal, as seen by the goalie looking up the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Side {
    Left,
    Centre,
    Right,
}

/// What the sender thinks each role, or each action, would be worth in its hands (section II: utilities, Q-values).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Values {
    /// Milliseconds on the sender's clock.
    pub time: u32,
    pub robot: u8,
    /// One for each column of the policy.
    pub values: Vec<f32>,
    /// The column that the sender would rather have than the one it has.
    pub wish: Option<u8>,
}

/// What a message is about: what fault rules, filters and counters tell apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum MessageKind {
    Position,
    HaveBall,
    Goalie,
    Values,
    Lock,
    AckLock,
    Swap,
    AckSwap,
}

impl Message {
    pub fn kind(&self) -> MessageKind {
        match self {
            Message::Position(_) => MessageKind::Position,
            Message::HaveBall(_) => MessageKind::HaveBall,
            Message::Goalie(_) => MessageKind::Goalie,
            Message::Values(_) => MessageKind::Values,
            Message::RoleSwap(role_swap::Message::Lock { .. }) => MessageKind::Lock,
            Message::RoleSwap(role_swap::Message::AckLock { .. }) => MessageKind::AckLock,
            Message::RoleSwap(role_swap::Message::Swap { .. }) => MessageKind::Swap,
            Message::RoleSwap(role_swap::Message::AckSwap { .. }) => MessageKind::AckSwap,
        }
    }

    /// The attempt that a message of the role swap belongs to.
    pub fn sequence(&self) -> Option<role_swap::Sequence> {
        match self {
            Message::RoleSwap(message) => Some(message.sequence()),
            _ => None,
        }
    }

    /// The bytes that cross the radio.
    pub fn encode(&self) -> Bytes {
        // Serialising into a growing vector fails for types of unknown length only, of which there are none here.
        postcard::to_extend(self, Bytes::new()).unwrap_or_default()
    }

    /// The message in these bytes.
    ///
    /// # Errors
    /// If they are not a message from beginning to end, or hold a number that is not finite.
    pub fn decode(bytes: &[u8]) -> Result<Message, NotAMessage> {
        let (message, rest) = postcard::take_from_bytes::<Message>(bytes).map_err(|_| NotAMessage)?;
        if rest.is_empty() && message.is_finite() { Ok(message) } else { Err(NotAMessage) }
    }

    fn is_finite(&self) -> bool {
        match self {
            Message::Position(position) => position.position.is_finite() && position.heading.is_finite(),
            Message::Values(values) => values.values.iter().all(|value| value.is_finite()),
            Message::HaveBall(_) | Message::Goalie(_) | Message::RoleSwap(_) => true,
        }
    }
}

/// An encoded message; most fit without an allocation.
pub type Bytes = SmallVec<[u8; 40]>;

/// Bytes that are no message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("these bytes are no message")]
pub struct NotAMessage;

impl MessageKind {
    /// All kinds, in their order.
    pub const ALL: [MessageKind; 8] = [
        MessageKind::Position,
        MessageKind::HaveBall,
        MessageKind::Goalie,
        MessageKind::Values,
        MessageKind::Lock,
        MessageKind::AckLock,
        MessageKind::Swap,
        MessageKind::AckSwap,
    ];
}

/// As the papers write them.
impl fmt::Display for MessageKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            MessageKind::Position => "position",
            MessageKind::HaveBall => "have-ball",
            MessageKind::Goalie => "goalie",
            MessageKind::Values => "values",
            MessageKind::Lock => "LOCK",
            MessageKind::AckLock => "ACKLOCK",
            MessageKind::Swap => "SWAP",
            MessageKind::AckSwap => "ACKSWAP",
        })
    }
}

#[cfg(test)]
mod tests;
