//! The socket on which a referee box is heard, and on which it is told how the robots are.

use std::net::SocketAddr;
use std::time::Duration;

use bevy::prelude::*;

use super::box_log::{BoxLog, ignored_line};
use super::error::NetworkError;
use super::robot_status::Observers;
use super::timing::DATAGRAMS_A_TICK;
use crate::clock::Clock;
use crate::comms::tcm::udp::UdpConn;
use crate::game::requests::{Request, Requests};
use crate::world::gamecontroller::BoxNews;

/// How often robots say how they are, per second.
const STATUS_HZ: f32 = 2.0;

pub(super) struct BoxSocket {
    conn: UdpConn,
    log: BoxLog,
    numbers_are_given: bool,
    /// How long a match without a box waits for one.
    patience: Option<Duration>,
    observers: Observers,
}

impl BoxSocket {
    /// # Errors
    /// If the address cannot be bound.
    pub fn open(
        address: SocketAddr,
        numbers_are_given: bool,
        patience: Option<Duration>,
    ) -> Result<BoxSocket, NetworkError> {
        Ok(BoxSocket {
            conn: UdpConn::bind(address)?,
            log: BoxLog::default(),
            numbers_are_given,
            patience,
            observers: Observers::default(),
        })
    }

    /// Passes on the packets that have arrived, and tells the box how the robots are.
    pub fn exchange(&mut self, world: &mut World) {
        let mut requests = world.resource_mut::<Requests>();
        for _ in 0..DATAGRAMS_A_TICK {
            let Ok(Some((from, bytes))) = self.conn.receive() else { break };
            requests.ask(Request::RefereeBox { from, bytes: bytes.into() });
        }
        self.look(world);
        self.observers.look(world);
        let is_due = world.resource::<Clock>().is_due(STATUS_HZ);
        let news = world.resource::<BoxNews>();
        if let (true, Some((to, _)), Some(teams)) = (is_due, news.sender(), news.team_numbers()) {
            self.observers.tell(world, &mut self.conn, to, teams);
        }
    }

    fn look(&mut self, world: &World) {
        let (clock, news) = (world.resource::<Clock>(), world.resource::<BoxNews>());
        self.log.look(news, clock, self.conn.address(), self.numbers_are_given);
    }

    /// # Errors
    /// If nobody has been heard for as long as the match waits.
    pub fn check_patience(&self, world: &World) -> Result<(), NetworkError> {
        let heard = world.resource::<BoxNews>().sender();
        let (None, Some(patience)) = (heard, self.patience) else { return Ok(()) };
        let address = self.conn.address();
        if world.resource::<Clock>().now() < patience.as_secs_f64() {
            Ok(())
        } else {
            Err(NetworkError::NoBox { address, patience })
        }
    }

    /// Says what is new, and how many packets were ignored.
    pub fn finish(&mut self, world: &World) {
        self.look(world);
        if let Some(line) = ignored_line(&world.resource::<BoxNews>().heard()) {
            bevy::log::warn!("{line}");
        }
    }
}
