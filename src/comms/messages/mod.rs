//! What robots of a team say to each other, and how it crosses the radio: as bytes.
//!
//! Each type of message is one of the TCM's data types, serialised by
//! [postcard](https://postcard.jamesmunns.com/wire-format): its fields in their order; `u8` as they are, larger integers and
//! lengths as little-endian base 128, `f32` as four little-endian bytes, `bool` and variants as one byte.

mod inbox;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

pub use inbox::{Inbox, Received};

pub use crate::comms::tcm::MessageKind;
use crate::comms::tcm::{Data, DataType, Module, from_postcard, to_postcard};
use crate::protocol::{b3p, role_swap};

pub(super) fn plugin(app: &mut App) {
    inbox::plugin(app);
}

/// A message of one robot to its team mates. The first three are those of the Hammerheads' figure 3, with its fields.
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    Position(Position),
    HaveBall(HaveBall),
    Goalie(GoalieNews),
    RoleSwap(role_swap::Message),
    Values(Values),
    Book(Book),
    BallReport(BallReport),
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

/// The sender has booked the ball (TeamChaos, section 4).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Book(pub b3p::Book);

/// Where the sender sees the ball (TeamChaos, section 1).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BallReport {
    /// Milliseconds on the sender's clock.
    pub time: u32,
    /// m in the team frame.
    pub position: Vec2,
    /// How long ago it was seen there, s.
    pub age: f32,
}

/// A line for people to read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Text(pub String);

/// Makes a type a data type of the TCM that is serialised by postcard. `$sound` says whether what was read makes sense.
macro_rules! data {
    ($type:ty, $number:expr, $module:expr, $name:literal, $kind:expr, $sound:expr) => {
        data!($type, $number, $module, $name, $kind, $sound, |_| None);
    };
    ($type:ty, $number:expr, $module:expr, $name:literal, $kind:expr, $sound:expr, $sequence:expr) => {
        impl Data for $type {
            const TYPE: DataType = $number;
            const MODULE: Module = $module;
            const NAME: &'static str = $name;

            fn serialise(&self) -> Vec<u8> {
                to_postcard(self)
            }

            fn unserialise(bytes: &[u8]) -> Option<$type> {
                let sound: fn(&$type) -> bool = $sound;
                from_postcard(bytes, sound)
            }

            fn kind(&self) -> MessageKind {
                let kind: fn(&$type) -> MessageKind = $kind;
                kind(self)
            }

            fn sequence(&self) -> Option<role_swap::Sequence> {
                let sequence: fn(&$type) -> Option<role_swap::Sequence> = $sequence;
                sequence(self)
            }
        }
    };
}

data!(Position, DataType::POSITION, Module::WORLD_MODEL, "position", |_| MessageKind::Position, |position| {
    position.position.is_finite() && position.heading.is_finite()
});
data!(HaveBall, DataType::HAVE_BALL, Module::CLAIMS, "have-ball", |_| MessageKind::HaveBall, |_| true);
data!(GoalieNews, DataType::GOALIE_NEWS, Module::GOALIE, "goalie", |_| MessageKind::Goalie, |_| true);
data!(
    role_swap::Message,
    DataType::ROLE_SWAP,
    Module::ROLE_SWAP,
    "role swap",
    MessageKind::of_role_swap,
    |_| true,
    |message| Some(message.sequence())
);
data!(Values, DataType::VALUES, Module::POLICY, "values", |_| MessageKind::Values, |values| {
    values.values.iter().all(|value| value.is_finite())
});
data!(Book, DataType::BOOK, Module::BALL_BOOKING, "book", |_| MessageKind::Book, |_| true);
data!(
    BallReport,
    DataType::BALL_REPORT,
    Module::WORLD_MODEL,
    "ball report",
    |_| MessageKind::BallReport,
    |report| report.position.is_finite() && report.age.is_finite() && report.age >= 0.0
);
data!(Text, DataType::TEXT, Module::CHAOS_MANAGER, "text", |_| MessageKind::Other, |_| true);

/// The union of the types that robots of a team exchange.
macro_rules! into_message {
    ($($variant:ident($type:ty)),*) => {
        $(impl From<$type> for Message {
            fn from(data: $type) -> Message {
                Message::$variant(data)
            }
        })*
    };
}

into_message!(
    Position(Position),
    HaveBall(HaveBall),
    Goalie(GoalieNews),
    RoleSwap(role_swap::Message),
    Values(Values),
    Book(Book),
    BallReport(BallReport)
);

#[cfg(test)]
mod tests;
