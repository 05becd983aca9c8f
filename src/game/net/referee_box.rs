//! The socket on which a referee box is heard, and on which it is told how the robots are.

use std::net::SocketAddr;
use std::time::Duration;

use bevy::log::{info, warn};
use bevy::prelude::*;

use super::box_log::{BoxLog, ignored_line, new_penalties};
use super::remote::DATAGRAMS_A_TICK;
use super::robot_status::Observers;
use super::{WireError, WirePlan};
use crate::clock::Clock;
use crate::comms::tcm::udp::UdpConn;
use crate::world::gamecontroller::BoxNews;
use crate::world::gamecontroller::control::Penalty;
use crate::world::gamecontroller::referee_box::{RefereeBox, View};

/// How often robots say how they are, per second.
const STATUS_HZ: f32 = 2.0;
/// Seconds without a box after which a line says that it is waited for.
const SAY_WAITING_AFTER: f64 = 1.0;

pub(super) struct BoxSocket {
    conn: UdpConn,
    follower: RefereeBox,
    log: BoxLog,
    /// Where the box is whose coming was told.
    sender: Option<SocketAddr>,
    said_waiting: bool,
    said_lost: bool,
    numbers_are_given: bool,
    /// How long a match without a box waits for one.
    patience: Option<Duration>,
    observers: Observers,
}

impl BoxSocket {
    pub fn open(address: SocketAddr, players: [u8; 2], plan: &WirePlan) -> Result<BoxSocket, WireError> {
        Ok(BoxSocket {
            conn: UdpConn::bind(address)?,
            follower: RefereeBox::new(plan.team_numbers, players),
            log: BoxLog::default(),
            sender: None,
            said_waiting: false,
            said_lost: false,
            numbers_are_given: plan.team_numbers.is_some(),
            patience: plan.wait_for_box,
            observers: Observers::default(),
        })
    }

    pub fn exchange(&mut self, world: &mut World) {
        let clock = *world.resource::<Clock>();
        self.hear(&clock, &mut world.get_resource_or_init::<BoxNews>());
        self.tell_silence(&clock);
        self.observers.look(world);
        if let (true, Some(to), Some(teams)) =
            (clock.is_due(STATUS_HZ), self.sender, self.follower.team_numbers())
        {
            self.observers.tell(world, &mut self.conn, to, teams);
        }
    }

    /// Takes the packets that have arrived.
    fn hear(&mut self, clock: &Clock, news: &mut BoxNews) {
        let now = millis(clock);
        let mut view: Option<View> = None;
        for _ in 0..DATAGRAMS_A_TICK {
            let Ok(Some((from, bytes))) = self.conn.receive() else { break };
            match self.follower.hear(from, bytes, now) {
                Ok(None) => {}
                Ok(Some(next)) => {
                    self.join(from);
                    let numbers = self.follower.team_numbers().unwrap_or_default();
                    let last = view.as_ref().or(news.view.as_ref());
                    for (robot, penalty) in new_penalties(last, &next) {
                        if !matches!(penalty, Penalty::None | Penalty::Substitute) {
                            *news.penalties.entry((robot, penalty)).or_default() += 1;
                        }
                    }
                    for line in self.log.changes(last, &next, numbers) {
                        info!("referee box: {line}");
                    }
                    view = Some(next);
                }
                Err(ignored) => {
                    if self.follower.first_time(&ignored) {
                        warn!("a packet from {from} is ignored, as others like it will be: {ignored}");
                    }
                }
            }
        }
        news.heard = self.follower.heard();
        news.sender = self.follower.followed();
        news.team_numbers = self.follower.team_numbers();
        if view.is_some() {
            (news.view, news.last) = (view, clock.tick);
        }
    }

    /// Says which box is followed, if that is news.
    fn join(&mut self, from: SocketAddr) {
        if self.sender == Some(from) && std::mem::take(&mut self.said_lost) {
            info!("the referee box at {from} is heard again");
        }
        self.said_lost = false;
        if self.sender.replace(from) == Some(from) {
            return;
        }
        let (Some((_, version)), Some([home, away])) =
            (self.follower.followed(), self.follower.team_numbers())
        else {
            return;
        };
        let assumed = if self.numbers_are_given {
            ""
        } else {
            ", taken from its first packet: --team-numbers names them the other way"
        };
        let version = version as u8;
        info!(
            "a referee box at {from} (version {version}) referees the match: \
             home is team {home}, away team {away}{assumed}"
        );
    }

    /// Says that nobody is heard yet, or nobody any more.
    fn tell_silence(&mut self, clock: &Clock) {
        let at = self.conn.address();
        match self.sender {
            None if !self.said_waiting && clock.now() >= SAY_WAITING_AFTER => {
                self.said_waiting = true;
                match self.follower.team_numbers() {
                    Some([home, away]) => {
                        info!("waiting for a referee box at {at} for the match of teams {home} and {away}");
                    }
                    None => info!("waiting for a referee box at {at}, for any teams"),
                }
            }
            Some(sender) if !self.said_lost && self.follower.is_silent(millis(clock)) => {
                self.said_lost = true;
                warn!("the referee box at {sender} is silent: all robots stand until one is heard");
            }
            _ => {}
        }
    }

    /// # Errors
    /// If nobody has been heard for as long as the match waits.
    pub fn check_patience(&self, clock: &Clock) -> Result<(), WireError> {
        let (None, Some(patience)) = (self.sender, self.patience) else { return Ok(()) };
        let address = self.conn.address();
        if clock.now() < patience.as_secs_f64() {
            Ok(())
        } else {
            Err(WireError::NoBox { address, patience })
        }
    }

    /// Says how many packets were ignored.
    pub fn finish(&self) {
        if let Some(line) = ignored_line(&self.follower.heard()) {
            warn!("{line}");
        }
    }
}

/// The match's clock in milliseconds. A match that a box referees runs in real time.
fn millis(clock: &Clock) -> u64 {
    (1000.0 * clock.now()).round() as u64
}
