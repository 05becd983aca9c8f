//! Matches that begin in the middle of something instead of at a kick-off.

use std::collections::BTreeMap;

use bevy::prelude::*;

use crate::geometry::Pose;
use crate::ids::RobotId;

/// Where a match begins: with the ball in play.
#[derive(Clone, Debug, PartialEq)]
pub struct Situation {
    /// Whether the rules hold; if not, the ball stays in play whatever happens.
    pub refereed: bool,
    /// The robots that take part. They believe that they are where they are.
    pub robots: BTreeMap<RobotId, Placed>,
    /// Where the ball is, m in the pitch frame.
    pub ball: Vec2,
    /// m/s
    pub velocity: Vec2,
}

/// A robot in a [`Situation`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// In the pitch frame.
    pub pose: Pose,
    /// Whether it is switched on.
    pub on: bool,
}
