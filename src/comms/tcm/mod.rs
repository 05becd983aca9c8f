//! The Team Communication Module, TCM (TeamChaos, section 3): carries data of any type between modules of different robots.
//!
//! A module puts data into its robot's [`TcmClient`]. In the Transmit stage the TCM takes them, makes [`ExternalMessage`]s of
//! them and cuts these into datagrams for a carrier: the simulated radio, or UDP. In the Deliver stage it puts arriving
//! datagrams together again and triggers [`Arrived`] for the types that are registered. It keeps no connections and repeats
//! nothing.

mod budget;
mod client;
pub mod counters;
mod data;
pub mod directory;
pub mod external_message;
pub mod fragments;
pub mod queues;
mod settings;
#[cfg(test)]
mod tests;
pub mod udp;

use std::sync::Arc;

use bevy::prelude::*;
use smallvec::SmallVec;

pub use budget::{MessageBudgets, Spent};
pub use client::TcmClient;
pub(crate) use data::data;
pub use data::{Arrived, Data, Priority, RegisterData, Registry, TypeInfo, from_postcard, to_postcard};
pub use directory::Directory;
pub use external_message::{Address, DataType, ExternalMessage, HOST, Module, Peer};
pub use settings::TcmSettings;

use crate::clock::Clock;
use crate::ids::RobotId;
use crate::robot::{Robot, RobotStart, SwitchedOff};
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use client::Outgoing;
use counters::{Dropped, TypeCounters};
use fragments::{Assembly, cut};

pub(super) fn plugin(app: &mut App) {
    app.match_resource::<Incoming>().starts_empty();
    app.match_resource::<OnAir>().starts_empty();
    app.match_resource::<MessageBudgets>();
    app.match_resource::<Addresses>();
    app.match_resource::<TcmSettings>();
    app.match_component::<TcmClient>()
        .starts(TcmClient::at_start)
        .on(|client, _: &SwitchedOff, _| client.clear());
    app.match_component::<Tcm>()
        .starts(Tcm::at_start)
        .on(|tcm, CountFrom(counter), _| tcm.count_from(*counter));
    app.init_resource::<Registry>()
        .init_resource::<Addresses>()
        .init_resource::<TcmSettings>()
        .configure_sets(Tick, TcmSystems::Receive.in_set(TickSystems::Deliver))
        .configure_sets(Tick, TcmSystems::Send.in_set(TickSystems::Transmit))
        .add_systems(Tick, receive_messages.in_set(TcmSystems::Receive))
        .add_systems(Tick, send_messages.in_set(TcmSystems::Send));
}

/// Carriers bring datagrams before the one, and take them after the other.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TcmSystems {
    /// Datagrams become messages, and messages data.
    Receive,
    /// Data become messages, and messages datagrams.
    Send,
}

/// Datagrams that are to go on air in this tick; emptied by the carrier.
#[derive(Resource, Clone, Debug, Default)]
pub struct OnAir(pub Vec<Datagram>);

/// A datagram on its way to one receiver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Datagram {
    /// The sender.
    pub from: RobotId,
    /// The receiver, perhaps a group.
    pub to: Peer,
    /// What the message is about of which it brings a piece.
    pub kind: DataType,
    /// The datagram itself.
    pub bytes: Arc<[u8]>,
}

/// The entities of the match and their addresses (the paper's `TCM.ini`).
#[derive(Resource, Clone, Debug, Default)]
pub struct Addresses(pub Directory);

/// Datagrams that a carrier has brought in this tick, with their receivers, in order.
#[derive(Resource, Clone, Debug, Default)]
pub struct Incoming(pub Vec<(RobotId, Arc<[u8]>)>);

/// A program begins in the midst of a match to send what another has sent before: its messages are counted from elsewhere.
#[derive(Clone, Copy, Debug)]
pub struct CountFrom(pub u32);

/// The TCM of one robot.
#[derive(Component, Clone, Debug)]
pub struct Tcm {
    settings: TcmSettings,
    /// Of the messages that it sent.
    counter: u32,
    /// Messages that have arrived in part.
    pub assembly: Assembly,
    /// Counts of messages by module and type.
    pub counters: TypeCounters,
}

impl Tcm {
    /// A team communication module without messages.
    pub fn new(settings: TcmSettings, clock: &Clock) -> Tcm {
        Tcm {
            settings,
            counter: 0,
            assembly: Assembly::new(settings.limits(clock)),
            counters: TypeCounters::default(),
        }
    }

    fn at_start(start: &RobotStart, world: &World) -> Tcm {
        Tcm::new(*world.resource::<TcmSettings>(), &start.clock)
    }

    /// Counts messages from here on: a program that restarts begins elsewhere.
    pub fn count_from(&mut self, counter: u32) {
        self.counter = counter;
    }
}

type Listening<'a> = (Entity, &'a RobotId, &'a mut Tcm);

/// Puts messages together and delivers those of registered types.
fn receive_messages(
    clock: Res<Clock>,
    registry: Res<Registry>,
    mut incoming: ResMut<Incoming>,
    mut commands: Commands,
    mut robots: Query<Listening>,
) {
    for (_, _, mut tcm) in &mut robots {
        let expired = tcm.assembly.expire(clock.tick);
        tcm.counters.expired += expired as u64;
    }
    for (to, datagram) in incoming.0.drain(..) {
        let robot = robots.iter_mut().find(|(_, id, ..)| **id == to);
        let Some((entity, id, mut tcm)) = robot else { continue };
        let Some(message) = tcm.take_in(&datagram, Peer::from(*id), clock.tick) else { continue };
        let (module, data_type) = (message.source.module, message.data_type);
        match registry.get(data_type) {
            None => tcm.counters.dropped(module, data_type, Dropped::UnknownType),
            Some(deliver)
                if deliver(&mut commands, entity, message.source.peer, data_type, &message.data) =>
            {
                tcm.counters.received(module, data_type, message.data.len());
            }
            Some(_) => tcm.counters.dropped(module, data_type, Dropped::NotUnserialisable),
        }
    }
}

type Speaking<'a> = (&'a RobotId, Option<&'a Robot>, &'a mut TcmClient, &'a mut Tcm);

/// Takes what the modules want to say and cuts it into datagrams, one for each receiver.
fn send_messages(
    directory: Res<Addresses>,
    mut budgets: Option<ResMut<MessageBudgets>>,
    mut on_air: ResMut<OnAir>,
    mut robots: Query<Speaking>,
) {
    on_air.0.clear();
    if robots.iter().all(|(_, _, client, _)| client.queues.is_empty()) {
        return;
    }
    let mut in_order: SmallVec<[_; 8]> = robots.iter_mut().collect();
    in_order.sort_unstable_by_key(|(id, ..)| **id);
    for (id, robot, mut client, mut tcm) in in_order {
        // What a mute robot says never goes on air, and costs nothing.
        let mute = robot.is_some_and(|robot| robot.health.mute);
        let mut budgets = budgets.as_deref_mut().filter(|_| !mute);
        for (module, data_type) in client.dropped.drain(..) {
            tcm.counters.dropped(module, data_type, Dropped::QueueFull);
        }
        for outgoing in client.queues.take(tcm.settings.messages_per_tick) {
            tcm.send(*id, outgoing, &directory.0, budgets.as_deref_mut(), &mut on_air);
        }
    }
}

impl Tcm {
    fn send(
        &mut self,
        from: RobotId,
        outgoing: Outgoing,
        directory: &Directory,
        budgets: Option<&mut MessageBudgets>,
        on_air: &mut OnAir,
    ) {
        let Outgoing { to, known, data } = outgoing;
        let (module, data_type) = (known.module, known.number);
        let source = Address { peer: from.into(), module };
        let destination = Address { peer: to, module };
        let message = ExternalMessage { source, destination, data_type, data };
        let Ok(pieces) = cut(&message, self.counter, self.settings.datagram) else {
            self.counters.dropped(module, data_type, Dropped::TooLarge);
            return;
        };
        if let Some(budgets) = budgets
            && directory.receivers(to, source.peer).next().is_some()
            && !budgets.spend(from, pieces.len(), known.priority)
        {
            self.counters.dropped(module, data_type, Dropped::OverBudget);
            return;
        }
        self.counter = self.counter.wrapping_add(1);
        let mut datagrams = 0;
        for piece in pieces {
            let bytes: Arc<[u8]> = piece.into();
            for to in directory.receivers(to, source.peer) {
                on_air.0.push(Datagram { from, to, kind: data_type, bytes: bytes.clone() });
                datagrams += 1;
            }
        }
        self.counters.sent(module, data_type, message.data.len(), datagrams);
    }

    fn take_in(&mut self, datagram: &[u8], to: Peer, tick: u64) -> Option<ExternalMessage> {
        let message = match self.assembly.accept(tick, datagram) {
            Ok(message) => message?,
            Err(_) => {
                self.counters.malformed += 1;
                return None;
            }
        };
        if message.destination.peer.includes(to) {
            return Some(message);
        }
        self.counters.foreign += 1;
        None
    }
}
