//! When robots talk, how long they believe what they hear, and what they take what they see for.

use serde::{Deserialize, Serialize};
use struct_patch::Patch;

use crate::data::{Bound, Fault, Validate, check_all};

/// When robots talk and how long they believe what they heard, all in seconds, and how near to the ball it can be claimed.
#[derive(Clone, Copy, Debug, PartialEq, Patch)]
#[patch(
    name = "MessageTimingFile",
    attribute(derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize))
)]
#[patch(attribute(serde(deny_unknown_fields, default)))]
#[patch(attribute(expect(missing_docs, reason = "the fields of what a file may leave out")))]
pub struct MessageTiming {
    /// Between two position messages.
    pub position_every: f32,
    /// For how long a position is believed.
    pub position_memory: f32,
    /// Between two have-ball messages of a robot that keeps the ball.
    pub claim_every: f32,
    /// For how long a claim is believed that was neither renewed nor given up.
    pub claim_memory: f32,
    /// A robot claims a ball that is nearer than this, m.
    pub claim_radius: f32,
    /// A robot does not claim a ball that it has not seen for this long, although it still believes in it.
    pub claim_sight: f32,
    /// Between two reports of a ball that is in sight.
    pub ball_every: f32,
    /// For how long such a report is believed.
    pub ball_memory: f32,
}

impl Default for MessageTiming {
    fn default() -> MessageTiming {
        MessageTiming {
            position_every: 0.2,
            position_memory: 1.5,
            claim_every: 0.4,
            claim_memory: 1.2,
            claim_radius: 1.0,
            claim_sight: 60.0,
            ball_every: 0.3,
            ball_memory: 1.5,
        }
    }
}

impl Validate for MessageTiming {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("position_every", self.position_every, Bound::SECONDS.positive()),
            ("position_memory", self.position_memory, Bound::SECONDS),
            ("claim_every", self.claim_every, Bound::SECONDS.positive()),
            ("claim_memory", self.claim_memory, Bound::SECONDS),
            ("claim_radius", self.claim_radius, Bound::LENGTH),
            ("claim_sight", self.claim_sight, Bound::SECONDS),
            ("ball_every", self.ball_every, Bound::SECONDS.positive()),
            ("ball_memory", self.ball_memory, Bound::SECONDS),
        ])
    }
}

/// What tells a robot that another one has the ball, or that the goalie is out. Lengths in metres, times in seconds.
#[derive(Clone, Copy, Debug, PartialEq, Patch)]
#[patch(
    name = "TeamWatchFile",
    attribute(derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize))
)]
#[patch(attribute(serde(deny_unknown_fields, default)))]
#[patch(attribute(expect(missing_docs, reason = "the fields of what a file may leave out")))]
pub struct TeamWatch {
    /// A team mate that is seen nearer to the ball than this has it (section VIII).
    pub control: f32,
    /// The border of the goalie's area is this wide, so that a goalie that stands on it does not leave and enter all the time.
    pub border: f32,
    /// Crossings of the border nearer to the middle of the goal than this are at the centre.
    pub centre: f32,
    /// A goalie of which nothing was heard or seen for this long is taken to be back: its message may have been lost.
    pub goalie_memory: f32,
}

impl Default for TeamWatch {
    fn default() -> TeamWatch {
        TeamWatch { control: 0.5, border: 0.1, centre: 0.2, goalie_memory: 20.0 }
    }
}

impl Validate for TeamWatch {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("control", self.control, Bound::LENGTH),
            ("border", self.border, Bound::LENGTH),
            ("centre", self.centre, Bound::LENGTH),
            ("goalie_memory", self.goalie_memory, Bound::SECONDS),
        ])
    }
}
