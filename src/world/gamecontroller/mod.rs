//! The RoboCup GameController: the electronic referee of the leagues (TeamChaos, section 2, ORGCtrl).
//!
//! A match can be refereed by a real referee box, whose packets are heard between ticks and followed in the Referee stage; our
//! own rules then stand back. Every match can be announced in the same format, so that other tools can follow it.

pub mod announcement;
mod codes;
pub mod control;
pub mod league;
pub mod referee_box;
pub mod serving;
pub mod status;
mod view;

use std::collections::BTreeMap;
use std::net::SocketAddr;

use bevy::prelude::*;

use crate::clock::Clock;
use crate::ids::RobotId;
use control::{Penalty, Version};
use referee_box::{Heard, SILENCE_MS, View};

/// What the referee box that referees this match has said; there is none where our own referee does.
#[derive(Resource, Clone, Debug, Default)]
pub struct BoxNews {
    /// What it said last; nothing before its first packet.
    pub view: Option<View>,
    /// Where it is, and the version that it speaks.
    pub sender: Option<(SocketAddr, Version)>,
    /// The league's numbers of home and away, once they are known.
    pub team_numbers: Option<[u8; 2]>,
    /// What was heard and what was ignored.
    pub heard: Heard,
    /// How often it has given a robot a penalty. A substitute has none.
    pub penalties: BTreeMap<(RobotId, Penalty), u64>,
    /// The tick in which it was heard last.
    pub last: u64,
}

impl BoxNews {
    /// Seconds since it was heard last, or since the match began.
    pub fn silence(&self, clock: &Clock) -> f64 {
        clock.tick.saturating_sub(self.last) as f64 * f64::from(clock.dt)
    }

    /// Whether it has spoken and is lost.
    pub fn is_lost(&self, clock: &Clock) -> bool {
        self.view.is_some() && 1000.0 * self.silence(clock) > SILENCE_MS as f64
    }
}
