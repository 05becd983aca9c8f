//! What a four-legged robot has besides a body, as data: its gait, its neck, its chin and its kicks.

use serde::{Deserialize, Serialize};

use crate::data::Bounds;

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
    pub noise: GaitNoise,
}

/// How a gait misses its command: an error that is drawn anew with each step.
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
    /// Most that the hold pulls before the ball slips out, N.
    pub force: f32,
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

impl Walker {
    pub(super) fn bounds(&self) -> Bounds {
        Bounds {
            positive: vec![
                ("drive.ahead", self.ahead),
                ("drive.back", self.back),
                ("drive.aside", self.aside),
                ("drive.turn", self.turn),
                ("drive.acceleration", self.acceleration),
                ("drive.turn_acceleration", self.turn_acceleration),
                ("drive.push", self.push),
                ("drive.turn_gain", self.turn_gain),
                ("drive.noise.step", self.noise.step),
            ],
            at_least_0: vec![
                ("drive.noise.share", self.noise.share),
                ("drive.noise.drift", self.noise.drift),
                ("drive.noise.turn", self.noise.turn),
            ],
            shares: vec![],
        }
    }
}

impl Neck {
    pub(super) fn bounds(&self) -> Bounds {
        let positive = vec![("neck.pan", self.pan), ("neck.speed", self.speed), ("neck.scan", self.scan)];
        Bounds { positive, ..Bounds::default() }
    }
}

impl Chin {
    pub(super) fn bounds(&self) -> Bounds {
        Bounds {
            positive: vec![
                ("chin.half_width", self.half_width),
                ("chin.speed", self.speed),
                ("chin.force", self.force),
                ("chin.turn", self.turn),
                ("chin.reach", self.reach.1 - self.reach.0),
            ],
            at_least_0: vec![("chin.time", self.time), ("chin.reach", self.reach.0)],
            shares: vec![("chin.success", self.success), ("chin.walk", self.walk)],
        }
    }
}

impl Kick {
    pub(super) fn bounds(&self) -> Bounds {
        Bounds {
            positive: vec![("kicks.run_out", self.run_out), ("kicks.time", self.time)],
            at_least_0: vec![
                ("kicks.run_out_spread", self.run_out_spread),
                ("kicks.spread", self.spread),
                ("kicks.direction", self.direction.abs()),
            ],
            shares: vec![],
        }
    }
}
