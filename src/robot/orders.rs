//! What the referee tells each robot: in which of the league's six states it is (TeamChaos, section 2, ORGCtrl).

use std::fmt;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::RobotStart;
use crate::geometry::Pose;

/// The state that a robot is told to be in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, Reflect)]
pub enum RobotState {
    /// It stands until the match begins.
    #[default]
    Initial,
    /// It walks to its kick-off place, or is carried there.
    Ready,
    /// It stands.
    Set,
    /// It plays.
    Playing,
    /// It has been taken off and stands outside, or stands where it is until its penalty is over.
    Penalised,
    /// The match is over.
    Finished,
}

/// What a robot was told last; written by the Referee stage.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, Reflect)]
#[reflect(Component)]
pub struct Orders {
    /// What the robot is to do.
    pub state: RobotState,
    /// Where it should stand at the kick-off, in its team frame; nothing if people put it there.
    pub place: Option<Pose>,
    /// Which share of the messages that the league allows its team is left; nothing, if nobody counts them.
    pub messages_left: Option<f32>,
}

impl Orders {
    /// Whether the robot serves a penalty, off the pitch or where it stands.
    pub fn is_penalised(&self) -> bool {
        self.state == RobotState::Penalised
    }

    /// A robot that has been told where it is plays at once.
    pub(super) fn at_start(start: &RobotStart, _: &World) -> Orders {
        let state = if start.told.is_some() { RobotState::Playing } else { RobotState::Initial };
        Orders { state, ..Orders::default() }
    }

    /// Whether the robot may move by itself.
    pub fn may_move(&self) -> bool {
        match self.state {
            RobotState::Playing => true,
            RobotState::Ready => self.place.is_some(),
            RobotState::Initial | RobotState::Set | RobotState::Penalised | RobotState::Finished => false,
        }
    }
}

impl fmt::Display for RobotState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            RobotState::Initial => "initial",
            RobotState::Ready => "ready",
            RobotState::Set => "set",
            RobotState::Playing => "playing",
            RobotState::Penalised => "penalised",
            RobotState::Finished => "finished",
        })
    }
}
