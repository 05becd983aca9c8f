//! What a referee box says, and what is remembered of one that is followed.

use bevy::prelude::Vec2;

use crate::ids::{RobotId, Team};
use crate::world::gamecontroller::control::SetPlay;
use crate::world::gamecontroller::referee_box::BoxView;

/// What a referee box has said last.
#[derive(Clone, Copy, Debug)]
pub struct BoxStatement<'a> {
    /// What the box says of the match.
    pub view: &'a BoxView,
    /// Seconds since it said so.
    pub silence: f64,
    /// Whether it has been silent for so long that it is lost.
    pub is_lost: bool,
}

/// What is remembered of a box that is followed.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Following {
    /// The robots have been put on their side of the pitch for these ends.
    pub(super) lined_up: bool,
    /// Seconds for which the box has said that a match that may be over is finished.
    pub(super) finished_for: f64,
    /// The set play that runs, who has it, and where the ball was put for it.
    pub(super) set_play: Option<(SetPlay, Team, Vec2)>,
    /// Who takes part in the penalty kick that runs.
    pub(super) penalty_kick: Option<Duel>,
}

/// The two that take part. One that is off the field is missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Duel {
    pub(super) kicker: Option<RobotId>,
    pub(super) keeper: Option<RobotId>,
    /// The ball has been in play.
    pub(super) begun: bool,
}
