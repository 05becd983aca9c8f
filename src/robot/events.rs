//! What happens to a robot from outside: its state starts and changes with these events, as it is
//! [registered](crate::state).

use std::sync::Arc;

use bevy::math::Vec2;

use super::{Restart, RobotKind, Sensing};
use crate::clock::Clock;
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::rng::Seed;
use crate::strategy::Strategy;
use crate::vision::CameraCalibration;

/// A robot comes into a match.
#[derive(Clone, Debug)]
pub struct RobotStart {
    /// Who.
    pub id: RobotId,
    /// Index into the strategy's roles.
    pub role: usize,
    /// What it is made of.
    pub kind: Arc<RobotKind>,
    /// How it sees.
    pub sensing: Arc<Sensing>,
    /// How its camera is calibrated, if it sees by pictures.
    pub calibration: Option<Arc<CameraCalibration>>,
    /// What its team plays.
    pub strategy: Arc<Strategy>,
    /// From which its dice come.
    pub seed: Seed,
    /// The clock at the start.
    pub clock: Clock,
    /// In the pitch frame.
    pub pose: Pose,
    /// Where it has been told that it is, in its team frame. Such a robot plays at once.
    pub told: Option<Pose>,
    /// Whether it is switched on.
    pub on: bool,
    /// Whether a person drives it.
    pub piloted: bool,
}

/// People have put a robot down somewhere and told it where it is.
#[derive(Clone, Debug)]
pub struct PutDown {
    /// In its team frame.
    pub told: Pose,
    /// What its team plays.
    pub strategy: Arc<Strategy>,
    /// When.
    pub tick: u64,
}

/// A robot's computer goes off.
#[derive(Clone, Copy, Debug)]
pub struct SwitchedOff;

/// A robot's computer comes on again. What the robot was in the middle of is gone in any case.
#[derive(Clone, Debug)]
pub struct SwitchedOn {
    /// What it still knows.
    pub restart: Restart,
    /// What its team plays.
    pub strategy: Arc<Strategy>,
    /// When.
    pub tick: u64,
}

/// A robot's team plays on with another strategy.
#[derive(Clone, Debug)]
pub struct StrategyChanged {
    /// What its team played.
    pub old: Arc<Strategy>,
    /// What it plays now.
    pub new: Arc<Strategy>,
    /// When.
    pub tick: u64,
}

/// A robot takes itself to be elsewhere from now on, and cannot know: its localisation errs by this much more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misled {
    /// m in the pitch frame.
    pub by: Vec2,
    /// rad
    pub turn: f32,
}
