//! What messages are about, as the radio tells them apart.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::protocol::role_swap;

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
    Book,
    BallReport,
    /// Of a type that the radio knows nothing of.
    Other,
}

impl MessageKind {
    /// All kinds, in their order.
    pub const ALL: [MessageKind; 11] = [
        MessageKind::Position,
        MessageKind::HaveBall,
        MessageKind::Goalie,
        MessageKind::Values,
        MessageKind::Lock,
        MessageKind::AckLock,
        MessageKind::Swap,
        MessageKind::AckSwap,
        MessageKind::Book,
        MessageKind::BallReport,
        MessageKind::Other,
    ];

    pub fn of_role_swap(message: &role_swap::Message) -> MessageKind {
        match message {
            role_swap::Message::Lock { .. } => MessageKind::Lock,
            role_swap::Message::AckLock { .. } => MessageKind::AckLock,
            role_swap::Message::Swap { .. } => MessageKind::Swap,
            role_swap::Message::AckSwap { .. } => MessageKind::AckSwap,
        }
    }
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
            MessageKind::Book => "book",
            MessageKind::BallReport => "ball report",
            MessageKind::Other => "other",
        })
    }
}
