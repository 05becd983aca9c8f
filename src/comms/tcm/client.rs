//! Between a robot's modules and its TCM: the client that they put data into.

use bevy::prelude::*;

use super::data::{Data, TypeInfo};
use super::external_message::{DataType, Module, Peer};
use super::queues::{QueueCounters, QueueRule, Queues};
use super::settings::TcmSettings;
use crate::ids::{PlayerNumber, RobotId};
use crate::robot::RobotStart;

/// A robot's proxy of the TCM: it keeps what modules want to say until the TCM is ready for it.
#[derive(Component, Clone, Debug)]
pub struct TcmClient {
    team: u8,
    pub(super) queues: Queues<Outgoing>,
    /// What found no room in its queue, until it is counted.
    pub(super) dropped: Vec<(Module, DataType)>,
}

/// Data that wait to be sent.
#[derive(Clone, Debug)]
pub(super) struct Outgoing {
    pub to: Peer,
    pub known: &'static TypeInfo,
    pub data: Vec<u8>,
}

impl TcmClient {
    /// A client without messages, whose queues all have this rule.
    pub fn new(robot: RobotId, rule: QueueRule) -> TcmClient {
        TcmClient { team: robot.team as u8, queues: Queues::new(rule), dropped: Vec::new() }
    }

    pub(super) fn at_start(start: &RobotStart, world: &World) -> TcmClient {
        TcmClient::new(start.id, world.resource::<TcmSettings>().queue)
    }

    /// To every team mate, and to the computers that listen.
    pub fn broadcast<T: Data>(&mut self, data: &T) {
        self.post(Peer::Team(self.team), data);
    }

    /// To one team mate.
    pub fn send<T: Data>(&mut self, to: PlayerNumber, data: &T) {
        self.post(Peer::Robot { team: self.team, number: to }, data);
    }

    /// To any peer.
    pub fn post<T: Data>(&mut self, to: Peer, data: &T) {
        let (known, data) = data.serialise();
        let dropped = self.queues.push(known.module, Outgoing { to, known, data });
        self.dropped.extend(dropped.map(|outgoing| (outgoing.known.module, outgoing.known.number)));
    }

    /// Forgets what waits, as when the robot is switched off.
    pub fn clear(&mut self) {
        self.queues.take(usize::MAX);
    }

    /// The queue of each module: items that wait, and its counters.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = (Module, usize, QueueCounters)> {
        self.queues.rows()
    }
}
