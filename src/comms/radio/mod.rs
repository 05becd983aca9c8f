//! The simulated radio, a carrier of the TCM's datagrams: in the Deliver stage it brings those that are due to their robots, in
//! the Transmit stage it puts others on air. A datagram in flight is an entity.

mod channel;
mod conditions;
mod counters;
mod counts;
mod faults;
mod log;
mod packet;
mod preset;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use smallvec::SmallVec;

pub use channel::{Channel, Fate, Loss};
pub use conditions::{Conditions, Partition};
pub use counters::{LinkCounters, Traffic};
pub use counts::MessageCounts;
pub use faults::{FaultRule, FaultRules};
pub use log::{Outcome, RadioLog, Transmission};
pub use packet::Packet;
pub use preset::Radio;

use crate::clock::Clock;
use crate::comms::messages::MessageKind;
use crate::comms::tcm::{Datagram, Incoming, OnAir, TcmSystems, as_robot};
use crate::geometry::Pose;
use crate::ids::{MatchEntity, RobotId};
use crate::robot::Robot;
use crate::schedule::{Tick, TickSystems};

pub(super) fn plugin(app: &mut App) {
    let receives = deliver_datagrams.in_set(TickSystems::Deliver).before(TcmSystems::Receive);
    let sends = transmit_datagrams.in_set(TickSystems::Transmit).after(TcmSystems::Send);
    app.add_systems(Tick, (receives.in_set(RadioSystems), sends.in_set(RadioSystems)));
}

/// The simulated radio, which stands by where datagrams cross a real network.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct RadioSystems;

/// On a message in flight: all that the radio knows of it.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
#[component(immutable)]
pub struct Envelope {
    /// Counts the messages of a match, per recipient. A copy has its original's.
    pub id: u64,
    pub kind: MessageKind,
    pub from: RobotId,
    pub to: RobotId,
    /// The tick in which it was sent.
    pub sent: u64,
    /// The tick in which it arrives.
    pub due: u64,
    /// It takes longer than the radio's ordinary delay.
    pub late: bool,
}

/// On a message in flight: the datagram.
#[derive(Component, Clone, Debug, PartialEq)]
#[component(immutable)]
pub struct Payload(pub Arc<[u8]>);

/// The state of the radio in a match: what is under way, and the counts.
#[derive(SystemParam)]
pub struct Air<'w> {
    channel: ResMut<'w, Channel>,
    conditions: Res<'w, Conditions>,
    faults: ResMut<'w, FaultRules>,
    traffic: ResMut<'w, Traffic>,
    counts: ResMut<'w, MessageCounts>,
    log: ResMut<'w, RadioLog>,
}

impl Air<'_> {
    /// Puts one packet on air: what the channel lets through becomes messages in flight.
    fn send(&mut self, packet: &Packet, datagram: &Datagram, clock: &Clock, commands: &mut Commands) {
        let fate = self.channel.send(packet, &self.conditions, &mut self.faults, clock);
        self.traffic.send(packet, &fate);
        self.counts.count_sent(packet.kind, packet.from, packet.to);
        let id = self.log.sent(packet, datagram.sequence, &fate, clock.tick);
        for copy in &fate.copies {
            commands.spawn((
                Envelope {
                    id,
                    kind: packet.kind,
                    from: packet.from,
                    to: packet.to,
                    sent: clock.tick,
                    due: copy.due,
                    late: copy.late,
                },
                Payload(datagram.bytes.clone()),
                MatchEntity,
            ));
        }
    }

    /// A mute robot's packet.
    fn stifle(&mut self, packet: &Packet, datagram: &Datagram, clock: &Clock) {
        let fate = Fate::lost(Loss::Mute);
        self.traffic.send(packet, &fate);
        self.log.sent(packet, datagram.sequence, &fate, clock.tick);
    }
}

pub(crate) fn deliver_datagrams(
    clock: Res<Clock>,
    mut commands: Commands,
    (mut traffic, mut counts, mut log): (ResMut<Traffic>, ResMut<MessageCounts>, ResMut<RadioLog>),
    mut incoming: ResMut<Incoming>,
    in_flight: Query<(Entity, &Envelope, &Payload)>,
    robots: Query<(&RobotId, &Robot)>,
) {
    let due = in_flight.iter().filter(|(_, envelope, _)| envelope.due <= clock.tick);
    let mut due: SmallVec<[_; 8]> = due.collect();
    due.sort_unstable_by_key(|(_, envelope, _)| (envelope.due, envelope.id));
    for (entity, envelope, payload) in due {
        commands.entity(entity).despawn();
        let to = robots.iter().find(|(id, _)| **id == envelope.to);
        if !to.is_some_and(|(_, robot)| robot.condition.hears()) {
            traffic.lose(envelope.from, envelope.to, Loss::Deaf);
            log.lost(envelope.id, Loss::Deaf);
            continue;
        }
        traffic.deliver(envelope.from, envelope.to);
        counts.count_delivered(envelope.kind, envelope.from, envelope.to);
        log.arrived(envelope.id, clock.tick);
        incoming.0.push((envelope.to, payload.0.clone()));
    }
}

pub(crate) fn transmit_datagrams(
    clock: Res<Clock>,
    mut on_air: ResMut<OnAir>,
    mut air: Air,
    mut commands: Commands,
    robots: Query<(&RobotId, &Robot, &Pose)>,
) {
    air.log.forget(&clock);
    for datagram in on_air.0.drain(..) {
        let robot = |wanted: RobotId| robots.iter().find(|(id, ..)| **id == wanted);
        // Computers have no antenna in a simulated match.
        let Some((to, _, place)) = as_robot(datagram.to).and_then(robot) else { continue };
        let Some((from, sender, pose)) = robot(datagram.from) else { continue };
        let packet = Packet {
            kind: datagram.kind,
            from: *from,
            to: *to,
            bytes: datagram.bytes.len(),
            distance: pose.position.distance(place.position),
        };
        if sender.condition.mute {
            air.stifle(&packet, &datagram, &clock);
        } else {
            air.send(&packet, &datagram, &clock, &mut commands);
        }
    }
}
