//! The RoboCup GameController: the electronic referee of the leagues (TeamChaos, section 2, ORGCtrl).
//!
//! A match can be refereed by a real referee box, whose packets come in by the door of [`crate::game::requests`] and are followed in the Referee stage; our
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
use referee_box::{BoxView, Ignored, PacketCounts, RefereeBox, SILENCE_MS};

/// What is known of the referee box that referees this match; there is none where our own referee does.
#[derive(Resource, Clone, Debug)]
pub struct BoxNews {
    follower: RefereeBox,
    /// What it said last; nothing before its first packet.
    pub view: Option<BoxView>,
    /// How often it has given a robot a penalty. A substitute has none.
    pub penalties: BTreeMap<(RobotId, Penalty), u64>,
    /// The tick in which it was heard last.
    pub last: u64,
}

impl BoxNews {
    /// A match of these teams, if their numbers are known, with so many players each, whose box has not been heard.
    pub fn new(team_numbers: Option<[u8; 2]>, players: [u8; 2]) -> BoxNews {
        let follower = RefereeBox::new(team_numbers, players);
        BoxNews { follower, view: None, penalties: BTreeMap::new(), last: 0 }
    }

    /// Takes a packet that has arrived.
    pub fn hear(&mut self, from: SocketAddr, bytes: &[u8], clock: &Clock) {
        // A match that a box referees runs in real time.
        let now = (1000.0 * clock.now()).round() as u64;
        let Ok(Some(view)) = self.follower.hear(from, bytes, now) else { return };
        for (robot, penalty) in view.new_penalties(self.view.as_ref()) {
            if !matches!(penalty, Penalty::None | Penalty::Substitute) {
                *self.penalties.entry((robot, penalty)).or_default() += 1;
            }
        }
        (self.view, self.last) = (Some(view), clock.tick);
    }

    /// Where the box is, and the version that it speaks.
    pub fn sender(&self) -> Option<(SocketAddr, Version)> {
        self.follower.followed()
    }

    /// The league's numbers of home and away, once they are known.
    pub fn team_numbers(&self) -> Option<[u8; 2]> {
        self.follower.team_numbers()
    }

    /// What was heard and what was ignored.
    pub fn heard(&self) -> PacketCounts {
        self.follower.heard()
    }

    /// The first packet that was ignored for each reason, by its sender.
    pub fn ignored(&self) -> &[(SocketAddr, Ignored)] {
        self.follower.ignored()
    }

    /// Seconds since it was heard last, or since the match began.
    pub fn silence(&self, clock: &Clock) -> f64 {
        clock.tick.saturating_sub(self.last) as f64 * f64::from(clock.dt)
    }

    /// Whether it has spoken and is lost.
    pub fn is_lost(&self, clock: &Clock) -> bool {
        self.view.is_some() && 1000.0 * self.silence(clock) > SILENCE_MS as f64
    }
}
