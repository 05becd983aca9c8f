//! What a four-legged robot has besides a body, as data: its gait, its neck, its chin and its kicks.

use serde::{Deserialize, Serialize};

use crate::data::{Bound, Fault, Validate, check_all, ensure};

/// An omnidirectional gait.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Walker {
    /// Fastest walk ahead, m/s.
    pub ahead: f32,
    /// Fastest walk back, m/s.
    pub back: f32,
    /// Fastest walk to either side, m/s.
    pub aside: f32,
    /// Fastest turn, degrees/s.
    pub turn: f32,
    /// How fast the velocity may be changed, m/s².
    pub acceleration: f32,
    /// How fast the turn may be changed, degrees/s².
    pub turn_acceleration: f32,
    /// Most that the legs can push, N.
    pub push: f32,
    /// Turn rate per heading error, 1/s.
    pub turn_gain: f32,
    /// How its gait misses the command.
    pub noise: GaitNoise,
}

/// How a gait misses its command: an error, drawn again with each step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GaitNoise {
    /// Time of one step, s.
    pub step: f32,
    /// Share of the commanded velocity.
    pub share: f32,
    /// In any direction, m/s.
    pub drift: f32,
    /// degrees/s
    pub turn: f32,
}

/// A head that turns from side to side.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Neck {
    /// Farthest turn to either side, degrees.
    pub pan: f32,
    /// degrees/s
    pub speed: f32,
    /// How fast the head turns from side to side while it looks for the ball, degrees/s.
    pub scan: f32,
}

/// The chin, which holds a ball against the chest. It hides the ball from the camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chin {
    /// Nearest and farthest centre of a ball that can be caught, ahead of the body's centre, m.
    pub reach: (f32, f32),
    /// Largest offset to the side, m.
    pub half_width: f32,
    /// Fastest ball that can be caught, relative to the robot, m/s.
    pub speed: f32,
    /// Chance that an attempt succeeds.
    pub success: f32,
    /// Time that an attempt takes, s.
    pub time: f32,
    /// Most that the hold pulls, N.
    pub force: f32,
    /// Push of other robots on a held ball at which it slips out, N; it never does, if not given.
    #[serde(default)]
    pub slips_at: Option<f32>,
    /// Share of the speed that is left while it holds a ball.
    pub walk: f32,
    /// Fastest turn with a ball, degrees/s.
    pub turn: f32,
}

/// A kick: where the ball goes, how far, and how well that is aimed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Kick {
    /// Mean direction, degrees to the left of straight ahead.
    pub direction: f32,
    /// Mean distance that a free ball rolls, m.
    pub run_out: f32,
    /// Standard deviation of that distance, m.
    pub run_out_spread: f32,
    /// Standard deviation of the direction, degrees.
    pub spread: f32,
    /// Time in which the robot does nothing else, s. It strikes half-way.
    pub time: f32,
    /// Whether the chin has to hold the ball first.
    #[serde(default)]
    pub from_hold: bool,
}

/// Where a kick meets the ball. Measured kicks are those of a lone robot that meets it squarely.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Strike {
    /// A ball that is no farther than this off the middle is met squarely, m.
    pub square: f32,
    /// A ball that is so much farther aside than that is not met at all, m; in between it is met with less and less.
    pub edge: f32,
    /// How far a ball that is met at the very edge is turned outwards, degrees.
    pub glance: f32,
    /// Chance that a robot that is wholly entangled with others misses.
    pub bumped: f32,
}

impl Validate for Strike {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("square", self.square, Bound::SIZE),
            ("edge", self.edge, Bound::SIZE.positive()),
            ("glance", self.glance, Bound::ANGLE),
            ("bumped", self.bumped, Bound::SHARE),
        ])
    }
}

impl Validate for Walker {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("ahead", self.ahead, Bound::SPEED.positive()),
            ("back", self.back, Bound::SPEED.positive()),
            ("aside", self.aside, Bound::SPEED.positive()),
            ("turn", self.turn, Bound::TURN_RATE.positive()),
            ("acceleration", self.acceleration, Bound::ACCELERATION.positive()),
            ("turn_acceleration", self.turn_acceleration, Bound::TURN_ACCELERATION.positive()),
            ("push", self.push, Bound::FORCE.positive()),
            ("turn_gain", self.turn_gain, Bound::GAIN.positive()),
            ("noise.step", self.noise.step, Bound::SECONDS.positive()),
            ("noise.share", self.noise.share, Bound::COEFFICIENT),
            ("noise.drift", self.noise.drift, Bound::SPEED),
            ("noise.turn", self.noise.turn, Bound::TURN_RATE),
        ])
    }
}

impl Validate for Neck {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("pan", self.pan, Bound::ANGLE.positive()),
            ("speed", self.speed, Bound::TURN_RATE.positive()),
            ("scan", self.scan, Bound::TURN_RATE.positive()),
        ])
    }
}

impl Validate for Chin {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("reach.0", self.reach.0, Bound::SIZE),
            ("reach.1", self.reach.1, Bound::SIZE),
            ("half_width", self.half_width, Bound::SIZE.positive()),
            ("speed", self.speed, Bound::SPEED.positive()),
            ("force", self.force, Bound::FORCE.positive()),
            ("turn", self.turn, Bound::TURN_RATE.positive()),
            ("time", self.time, Bound::SECONDS),
            ("success", self.success, Bound::SHARE),
            ("walk", self.walk, Bound::SHARE),
            ("slips_at", self.slips_at.unwrap_or_default(), Bound::FORCE),
        ])?;
        let is_ordered = self.reach.0 < self.reach.1;
        ensure(is_ordered, "reach", || "needs two lengths, the lesser one first".into())
    }
}

impl Validate for Kick {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("run_out", self.run_out, Bound::LENGTH.positive()),
            ("run_out_spread", self.run_out_spread, Bound::LENGTH),
            ("spread", self.spread, Bound::ANGLE),
            ("direction", self.direction, Bound::HEADING),
            ("time", self.time, Bound::SECONDS.positive()),
        ])
    }
}
