//! Between a robot's modules and its TCM: the client that they put data into.

use bevy::prelude::*;

use super::client::{QueueRule, Queues};
use super::data::Data;
use super::external_message::{DataType, Entity as Party, Module};
use super::kind::MessageKind;
use crate::ids::{PlayerNumber, RobotId};
use crate::protocol::role_swap::Sequence;

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
    pub to: Party,
    pub module: Module,
    pub data_type: DataType,
    pub kind: MessageKind,
    pub sequence: Option<Sequence>,
    pub bytes: Vec<u8>,
}

impl TcmClient {
    pub fn new(robot: RobotId, rule: QueueRule) -> TcmClient {
        TcmClient { team: robot.team as u8, queues: Queues::new(rule), dropped: Vec::new() }
    }

    /// To every team mate, and to the computers that listen.
    pub fn broadcast<T: Data>(&mut self, data: &T) {
        self.post(Party::Team(self.team), data);
    }

    /// To one team mate.
    pub fn send<T: Data>(&mut self, to: PlayerNumber, data: &T) {
        self.post(Party::Robot { team: self.team, number: to }, data);
    }

    /// To anybody.
    pub fn post<T: Data>(&mut self, to: Party, data: &T) {
        let outgoing = Outgoing {
            to,
            module: T::MODULE,
            data_type: T::TYPE,
            kind: data.kind(),
            sequence: data.sequence(),
            bytes: data.serialise(),
        };
        let dropped = self.queues.push(T::MODULE, outgoing);
        self.dropped.extend(dropped.map(|outgoing| (outgoing.module, outgoing.data_type)));
    }

    /// Forgets what waits, as when the robot is switched off.
    pub fn clear(&mut self) {
        self.queues.take(usize::MAX);
    }

    /// The queue of each module: items that wait, and its counters.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = (Module, usize, super::client::QueueCounters)> {
        self.queues.rows()
    }
}
