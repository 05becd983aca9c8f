//! Announces a match in the GameController's own format, so that other tools can follow it.
//!
//! Without a window a match is announced twice a second by its own clock, however fast it is played, so that nothing of it
//! is left out; at half time and at its end also at once. In the window it is announced twice a second by the wall's clock,
//! as boxes do it, also while it is paused or over.

use std::net::SocketAddr;

use bevy::log::warn;
use bevy::prelude::*;

use super::announced::{announcement, half_time};
use crate::clock::Clock;
use crate::comms::tcm::udp::{UdpConn, UdpError};
use crate::world::gamecontroller::BoxNews;
use crate::world::gamecontroller::announcement::MatchAnnouncement;
use crate::world::gamecontroller::control::Version;
use crate::world::referee::MatchState;

/// How often a match is announced, per second: as often as referee boxes speak.
const HZ: f32 = 2.0;
pub(super) struct Announcer {
    conn: UdpConn,
    to: SocketAddr,
    version: Version,
    /// The league's numbers of home and away.
    team_numbers: [u8; 2],
    packet_number: u8,
    /// Whether the last packet was about the first half.
    first_half: bool,
    /// Seconds on the wall since the last packet, where they decide.
    waited: Option<f32>,
    /// Why the last packet that was not sent was not.
    trouble: Option<String>,
    /// Whether that is still to be told.
    is_news: bool,
}

impl Announcer {
    /// Opens the socket.
    pub fn open(to: SocketAddr, version: Version, team_numbers: [u8; 2]) -> Result<Announcer, UdpError> {
        Ok(Announcer {
            conn: UdpConn::speaker(to)?,
            to,
            version,
            team_numbers,
            packet_number: 0,
            first_half: true,
            waited: None,
            trouble: None,
            is_news: false,
        })
    }

    /// Announces what is due between two ticks.
    pub fn announce_after_tick(&mut self, world: &mut World) {
        let due = self.waited.is_none() && world.resource::<Clock>().is_due(HZ);
        if due || self.is_half_time(world) {
            self.announce(world);
        }
    }

    /// Announces what is due so many seconds on the wall after the last call. From the first call on the match's own clock
    /// does not decide any more. Returns why nothing can be announced, once.
    pub fn announce_in_real_time(&mut self, world: &mut World, elapsed: f32) -> Option<String> {
        let waited = self.waited.map_or(elapsed, |waited| waited + elapsed);
        self.waited = Some(waited);
        if waited >= 1.0 / HZ {
            self.announce(world);
        }
        std::mem::take(&mut self.is_news).then(|| self.trouble.clone()).flatten()
    }

    /// A box tells of half time itself.
    fn is_half_time(&self, world: &World) -> bool {
        let state = world.resource::<MatchState>();
        self.first_half && state.half > 1 && !world.contains_resource::<BoxNews>()
    }

    /// Sends what is due.
    pub fn announce(&mut self, world: &mut World) {
        let is_half_time = self.is_half_time(world);
        let followed = world.get_resource::<BoxNews>().and_then(BoxNews::team_numbers);
        self.team_numbers = followed.unwrap_or(self.team_numbers);
        let announcement = announcement(world);
        if is_half_time {
            for view in half_time(&announcement.view) {
                self.send(MatchAnnouncement { view, ..announcement.clone() });
            }
        }
        self.send(announcement);
        self.waited = self.waited.map(|_| 0.0);
    }

    fn send(&mut self, announcement: MatchAnnouncement) {
        let (version, packet_number, team_numbers) = (self.version, self.packet_number, self.team_numbers);
        self.first_half = announcement.view.first_half;
        self.packet_number = packet_number.wrapping_add(1);
        let announcement = MatchAnnouncement { version, packet_number, team_numbers, ..announcement };
        // Whether anybody listens there is not known.
        if let Err(error) = self.conn.send(self.to, &announcement.packet().write()) {
            let trouble = format!("the match cannot be announced: {error}");
            if self.trouble.as_ref() != Some(&trouble) {
                warn!("{trouble}");
                (self.trouble, self.is_news) = (Some(trouble), true);
            }
        }
    }
}
