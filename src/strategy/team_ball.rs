//! How a team shares the ball, as a strategy has it: how it is booked, and how reports of it become one place.

use serde::{Deserialize, Serialize};
use struct_patch::Patch;

use crate::data::{Bound, Fault, Validate, check_all, ensure};
use crate::protocol::b3p;

/// How the ball is booked (TeamChaos, section 4). Times in seconds, lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq, Patch)]
#[patch(
    name = "BallBookingFile",
    attribute(derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize))
)]
#[patch(attribute(serde(deny_unknown_fields, default)))]
#[patch(attribute(expect(missing_docs, reason = "the fields of what a file may leave out")))]
pub struct BallBooking {
    /// Which bookings count.
    pub rules: b3p::Rules,
    /// How much nearer than the booker a robot must be to book the ball in its stead.
    pub threshold: f32,
    /// A booking that was not renewed for this long is free.
    pub timeout: f32,
    /// Between two announcements of a robot that keeps its booking.
    pub renewal: f32,
    /// What makes a robot's position with respect to the ball better than another's.
    pub bid: BidBy,
}

impl Default for BallBooking {
    fn default() -> BallBooking {
        BallBooking {
            rules: b3p::Rules::Hardened { release: true },
            threshold: 0.3,
            timeout: 0.8,
            renewal: 0.2,
            bid: BidBy::Distance,
        }
    }
}

impl Validate for BallBooking {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("threshold", self.threshold, Bound::LENGTH),
            ("renewal", self.renewal, Bound::SECONDS.positive()),
            ("timeout", self.timeout, Bound::SECONDS),
        ])?;
        if let BidBy::Time { round } = self.bid {
            Bound::LENGTH.check("bid.round", round)?;
        }
        ensure(self.timeout > self.renewal, "timeout", || {
            format!("must be longer than the renewal of {} s, or every booking lapses", self.renewal)
        })
    }
}

/// What a robot bids for the ball.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum BidBy {
    /// Its distance from the ball, as in figure 5.
    Distance,
    /// The time until it can play the ball, as the way that it goes in it at full speed: it walks there, turns to the ball, and
    /// goes round it.
    Time {
        /// The radius at which it goes round the ball, m; 0 for one that takes the ball from any side.
        round: f32,
    },
}

/// How the ball reports of several robots become one place (TeamChaos, section 2: the global map).
#[derive(Clone, Copy, Debug, PartialEq, Patch)]
#[patch(
    name = "MapFusionFile",
    attribute(derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize))
)]
#[patch(attribute(serde(deny_unknown_fields, default)))]
#[patch(attribute(expect(missing_docs, reason = "the fields of what a file may leave out")))]
pub struct MapFusion {
    /// Whether they are fused; otherwise the robot's own belief counts, or else the freshest report.
    pub fused: bool,
    /// How far a robot may be off that tells where the ball is, m.
    pub position: f32,
    /// How far off the ball is seen, as a share of the distance.
    pub range: f32,
    /// How fast a report becomes wrong, since the ball rolls on, m/s.
    pub rolling: f32,
    /// Two reports contradict each other if they are more than this many deviations apart.
    pub gate: f32,
}

impl Default for MapFusion {
    fn default() -> MapFusion {
        MapFusion { fused: false, position: 0.15, range: 0.1, rolling: 0.5, gate: 3.0 }
    }
}

impl Validate for MapFusion {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("position", self.position, Bound::LENGTH.positive()),
            ("range", self.range, Bound::SHARE),
            ("rolling", self.rolling, Bound::SPEED),
            ("gate", self.gate, Bound::FACTOR.positive()),
        ])
    }
}
