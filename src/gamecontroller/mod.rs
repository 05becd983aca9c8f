//! The RoboCup GameController: the electronic referee of the leagues (TeamChaos, section 2, ORGCtrl).
//!
//! A match can be refereed by a real referee box, whose packets are heard between ticks and followed in the Referee stage; our
//! own rules then stand back. Every match can be announced in the same format, so that other tools can follow it.

pub mod announcement;
mod codes;
pub mod control;
pub mod league;
pub mod referee_box;
pub mod status;

use bevy::prelude::*;

use referee_box::{Heard, View};

/// What the referee box that referees this match has said; there is none where our own referee does.
#[derive(Resource, Clone, Debug, Default)]
pub struct BoxNews {
    /// What it said last; nothing before its first packet.
    pub view: Option<View>,
    /// What was heard and what was ignored.
    pub heard: Heard,
    /// The tick in which it was heard last.
    pub last: u64,
}
