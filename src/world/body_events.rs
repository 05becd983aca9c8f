//! What happened to robots' bodies in a tick, for those who count it.

use bevy::prelude::*;

use crate::ids::RobotId;

/// What happened to robots' bodies in this tick. Written by the Drive stage, which begins it anew.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct BodyEvents(pub Vec<(RobotId, BodyEvent)>);

/// Something that happened to the body of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyEvent {
    /// It lost its footing.
    Fell,
    /// It began a kick.
    KickTried,
    /// Its kick met the ball.
    KickStruck,
    /// Its kick met nothing.
    KickMissed,
    /// Its chin got hold of the ball.
    BallCaught,
    /// Others pushed or kicked the ball out from under its chin.
    BallSlipped,
}
