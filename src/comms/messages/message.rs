//! The messages of a team, and how they cross the radio: as bytes.
//!
//! A message is written by [postcard](https://postcard.jamesmunns.com/wire-format): its fields in their order; `u8` as they
//! are, larger integers and lengths as little-endian base 128, `f32` as four little-endian bytes, `bool` and variants as one
//! byte. Which message it is its data type tells, so [`TeamMessage`] itself is never written. A new message is a type, a variant
//! and a row of the table below, and then its sender and its receiver.

use std::fmt;

use bevy::prelude::*;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::comms::tcm::{Data, DataType, Module, data};
use crate::protocol::{b3p, role_swap};

/// A message of one robot to its team mates. The first three are those of the Hammerheads' figure 3, with its fields.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum TeamMessage {
    Position(Position),
    HaveBall(HaveBall),
    Goalie(GoalieNews),
    /// LOCK, ACKLOCK, SWAP and ACKSWAP.
    RoleSwap(role_swap::Message),
    Values(Values),
    /// The sender has booked the ball (TeamChaos, section 4).
    Book(b3p::Book),
    BallReport(BallReport),
    /// A line for people to read.
    Text(String),
}

impl TeamMessage {
    /// Whether it is a step of a protocol, for which others wait, and not news that comes again.
    pub fn is_step(&self) -> bool {
        matches!(self, TeamMessage::RoleSwap(_) | TeamMessage::Book(_))
    }
}

/// Where the sender is; sent by every player again and again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Position {
    /// Milliseconds on the sender's clock.
    pub time: u32,
    /// The sender's number in its team.
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
    /// The sender's number in its team.
    pub robot: u8,
    /// Whether it has the ball; false gives the claim up.
    pub have_ball: bool,
    /// An index into the strategy's roles.
    pub role: role_swap::RoleIndex,
}

/// Sent by the goalie when it leaves or enters the penalty area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GoalieNews {
    /// Milliseconds on the sender's clock.
    pub time: u32,
    /// The goalie's number in its team.
    pub robot: u8,
    /// Whether it leaves or enters its area.
    pub behaviour: GoalieBehaviour,
    /// The side by which it does.
    pub side: GoalSide,
}

/// What the goalie does at the border of its area.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum GoalieBehaviour {
    /// It leaves its area.
    Leaving,
    /// It is back in its area.
    Entering,
}

/// A side of the goal, as seen by the goalie looking up the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum GoalSide {
    /// The left half.
    Left,
    /// The middle.
    Centre,
    /// The right half.
    Right,
}

/// What the sender thinks each role, or each action, would be worth in its hands (section II: utilities, Q-values).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Values {
    /// Milliseconds on the sender's clock.
    pub time: u32,
    /// The sender's number in its team.
    pub robot: u8,
    /// One for each column of the policy.
    pub values: Vec<f32>,
    /// The column that the sender would rather have than the one it has.
    pub wish: Option<u8>,
}

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

/// The table of messages. A row is a data type: its constant, its word in files and its number; its name, its module and
/// its priority; the messages of this type, what is written of them, and what they must satisfy.
macro_rules! messages {
    ($($constant:ident $word:ident $number:literal: $name:literal $module:ident $priority:ident;
        ($($message:tt)+) = $written:tt: $type:ty $(, if $is_sound:expr)?;)+) => {
        impl DataType {
            $(#[doc = $name] pub const $constant: DataType = DataType($number);)+
        }

        data!(TeamMessage {
            $(DataType::$constant, $name, Module::$module, $priority; ($($message)+) = $written: $type $(, if $is_sound)?;)+
        });

        /// The data types of messages by their words in files.
        #[derive(Serialize, Deserialize)]
        #[serde(rename = "MessageKind")]
        enum MessageWord {
            $($word),+
        }

        impl Serialize for DataType {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                match *self {
                    $(DataType::$constant => MessageWord::$word.serialize(serializer),)+
                    other => Err(serde::ser::Error::custom(format!("{other} is no message"))),
                }
            }
        }

        impl<'de> Deserialize<'de> for DataType {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<DataType, D::Error> {
                Ok(match MessageWord::deserialize(deserializer)? {
                    $(MessageWord::$word => DataType::$constant,)+
                })
            }
        }
    };
}

messages! {
    POSITION Position 1: "position" WORLD_MODEL Routine; (TeamMessage::Position(it)) = it: Position,
        if |it: &Position| it.position.is_finite() && it.heading.is_finite();
    HAVE_BALL HaveBall 2: "have-ball" CLAIMS Routine; (TeamMessage::HaveBall(it)) = it: HaveBall;
    GOALIE_NEWS Goalie 3: "goalie" GOALIE Routine; (TeamMessage::Goalie(it)) = it: GoalieNews;
    VALUES Values 5: "values" POLICY Routine; (TeamMessage::Values(it)) = it: Values,
        if |it: &Values| it.values.iter().all(|value| value.is_finite());
    LOCK Lock 9: "LOCK" ROLE_SWAP Urgent; (TeamMessage::RoleSwap(role_swap::Message::Lock { sequence }))
        = sequence: role_swap::Sequence;
    ACK_LOCK AckLock 10: "ACKLOCK" ROLE_SWAP Urgent; (TeamMessage::RoleSwap(role_swap::Message::AckLock { sequence, holds }))
        = (sequence, holds): (role_swap::Sequence, role_swap::Holding);
    SWAP Swap 11: "SWAP" ROLE_SWAP Urgent; (TeamMessage::RoleSwap(role_swap::Message::Swap { sequence, order }))
        = (sequence, order): (role_swap::Sequence, role_swap::Order);
    ACK_SWAP AckSwap 12: "ACKSWAP" ROLE_SWAP Urgent; (TeamMessage::RoleSwap(role_swap::Message::AckSwap { sequence }))
        = sequence: role_swap::Sequence;
    BOOK Book 6: "book" BALL_BOOKING Urgent; (TeamMessage::Book(it)) = it: b3p::Book;
    BALL_REPORT BallReport 7: "ball report" WORLD_MODEL Routine; (TeamMessage::BallReport(it)) = it: BallReport,
        if |it: &BallReport| it.position.is_finite() && it.age.is_finite() && it.age >= 0.0;
    TEXT Text 8: "text" CHAOS_MANAGER Routine; (TeamMessage::Text(it)) = it: String;
}

impl fmt::Display for DataType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match TeamMessage::TYPES.iter().find(|known| known.number == *self) {
            Some(known) => f.write_str(known.name),
            None => write!(f, "type {}", self.0),
        }
    }
}

/// The table of modules: their constants, numbers and names.
macro_rules! modules {
    ($($constant:ident $number:literal: $name:literal;)+) => {
        impl Module {
            $(#[doc = $name] pub const $constant: Module = Module($number);)+
        }

        impl fmt::Display for Module {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match *self {
                    $(Module::$constant => f.write_str($name),)+
                    Module(other) => write!(f, "module {other}"),
                }
            }
        }
    };
}

modules! {
    WORLD_MODEL 0: "world model";
    CLAIMS 1: "claims";
    GOALIE 2: "goalie";
    ROLE_SWAP 3: "role swap";
    POLICY 4: "policy";
    BALL_BOOKING 5: "ball booking";
    CHAOS_MANAGER 6: "ChaosManager";
    REMOTE_ROBOTS 7: "remote robots";
}

#[cfg(test)]
mod tests;
