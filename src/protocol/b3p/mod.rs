//! Ball booking (TeamChaos, section 4): which robot of a team goes to the ball.
//!
//! A robot that sees a ball which nobody has booked books it and says so. It repeats that while it sees the ball; the
//! others leave the ball alone unless they are nearer by a threshold or the booker has not been heard for too
//! long. [`Rules`] says how far this is as figure 5 has it and what is done about its gaps. Nobody answers anything, so a
//! robot knows no more than what it heard last: each has its own belief about the one booking.

mod distance;
mod machine;

use serde::{Deserialize, Serialize};

pub use distance::Distance;
pub use machine::B3p;

use crate::ids::PlayerNumber;

/// A moment on a robot's own clock.
pub type OwnTick = u64;
/// Counts who had the ball before: a booking of a greater term is newer.
pub type BookingTerm = u32;

/// Which bookings a robot believes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Rules {
    /// As in figure 5.
    Paper(Update),
    /// A booking by another robot counts if its distance is smaller, or equal and its robot's number is. Enough for a ball
    /// that lies still: once it moves, an old announcement with a good distance may win against a new one.
    Lexicographic,
    /// Every new booking has a term above all that its robot knows of, and a key, the distance at which it was booked. The
    /// greater term counts, then the smaller key, then the smaller number; renewals change neither. With `release`, a booker
    /// that loses sight of the ball or is penalised books it once more at an infinite distance, so that anybody is nearer.
    Hardened { release: bool },
}

/// What a robot does with another's booking, on which the paper says only that it updates its information.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Update {
    /// Believes it. Two robots that book at once then each believe the other, and nobody goes.
    #[default]
    Always,
    /// Believes it only if it would have let the other book: if the ball is free or the booking expired, if it renews what
    /// the robot believes, or if the other is nearer by the threshold. Two that book at once then both go, for good.
    Cautious,
}

/// How a team books the ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BookingSettings {
    /// Which bookings count.
    pub rules: Rules,
    /// A robot is nearer only if it is by at least so much. Above what the measured distances vary by, else robots take the
    /// ball from each other in turn.
    pub threshold: Distance,
    /// A booking older than this has expired. At least the longest time between two renewals that are heard, else a booker
    /// loses the ball although it is there.
    pub timeout: OwnTick,
    /// Ticks between two announcements of a booking.
    pub renewal: OwnTick,
}

/// What a robot believes about the ball: the paper's robot booker, distance and timestamp. That the ball is booked at all is
/// that there is one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct KnownBooking {
    /// Who has booked the ball.
    pub robot_booker: PlayerNumber,
    /// The booker's distance when it was last heard; infinite if it has let the ball go.
    pub distance: Distance,
    /// When the booking was made or last renewed, on the clock of the robot that believes this.
    pub timestamp: OwnTick,
    /// Zero but under the hardened rules.
    pub term: BookingTerm,
    /// The distance at which the ball was first booked in this term; under the other rules the distance.
    pub key: Distance,
}

/// The one message of the protocol: its sender has the ball booked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Book {
    /// From the booker to the ball.
    pub distance: Distance,
    /// How often the ball has changed hands, under the hardened rules.
    pub term: BookingTerm,
    /// The distance at which the ball was booked first in this term.
    pub key: Distance,
}

/// What happens to a robot's side of the protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum BookingInput {
    /// One turn of the robot's loop. Without a distance it does not know where the ball is.
    #[expect(missing_docs, reason = "the sentence of the variant says what its fields are")]
    Turn { distance: Option<Distance> },
    /// A team mate announced a booking.
    #[expect(missing_docs, reason = "the sentence of the variant says what its fields are")]
    Hear { from: PlayerNumber, book: Book },
    /// The robot is penalised: it frees the ball if it has it booked.
    Withdraw,
}
