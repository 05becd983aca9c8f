//! The radio: the Deliver stage, which brings messages that are due to their robots, and the Transmit stage, which puts what
//! robots want to say on air. A message in flight is an entity, and it flies as bytes.

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
use crate::geometry::Pose;
use crate::ids::{MatchEntity, RobotId};
use crate::messages::{Bytes, Message, MessageKind};
use crate::protocol::role_swap::Number;
use crate::robot::Robot;
use crate::schedule::{Tick, TickSystems};

pub(super) fn plugin(app: &mut App) {
    app.add_systems(Tick, deliver_messages.in_set(TickSystems::Deliver))
        .add_systems(Tick, transmit_messages.in_set(TickSystems::Transmit));
}

/// What a robot wants to say; filled by the Teamwork stage, emptied by the Transmit stage.
#[derive(Component, Clone, Debug, Default)]
pub struct Outbox(SmallVec<[Outgoing; 4]>);

#[derive(Clone, Debug)]
struct Outgoing {
    to: Recipient,
    message: Message,
}

/// Whom a message is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Recipient {
    Team,
    Mate(Number),
}

impl Outbox {
    /// To every team mate.
    pub fn broadcast(&mut self, message: Message) {
        self.0.push(Outgoing { to: Recipient::Team, message });
    }

    /// To one team mate.
    pub fn send(&mut self, to: Number, message: Message) {
        self.0.push(Outgoing { to: Recipient::Mate(to), message });
    }

    pub fn clear(&mut self) {
        self.0.clear();
    }
}

/// What a robot has heard since its last decision, in the order of arrival; written by the Deliver stage.
#[derive(Component, Clone, Debug, Default)]
pub struct Inbox(pub Vec<Received>);

/// A message that arrived.
#[derive(Clone, Debug, PartialEq)]
pub struct Received {
    pub from: Number,
    pub message: Message,
}

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

/// On a message in flight: what it says.
#[derive(Component, Clone, Debug, PartialEq)]
#[component(immutable)]
pub struct Payload(pub Bytes);

/// The state of the air in a match: what becomes of messages, and what became of them.
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
    fn send(
        &mut self,
        packet: &Packet,
        message: &Message,
        bytes: &Bytes,
        clock: &Clock,
        commands: &mut Commands,
    ) {
        let fate = self.channel.send(packet, &self.conditions, &mut self.faults, clock);
        self.traffic.send(packet, &fate);
        self.counts.count_sent(packet.kind, packet.from, packet.to);
        let id = self.log.sent(packet, message.sequence(), &fate, clock.tick);
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
                Payload(bytes.clone()),
                MatchEntity,
            ));
        }
    }

    /// A mute robot's packet.
    fn stifle(&mut self, packet: &Packet, message: &Message, clock: &Clock) {
        let fate = Fate::lost(Loss::Mute);
        self.traffic.send(packet, &fate);
        self.log.sent(packet, message.sequence(), &fate, clock.tick);
    }
}

fn deliver_messages(
    clock: Res<Clock>,
    mut commands: Commands,
    (mut traffic, mut counts, mut log): (ResMut<Traffic>, ResMut<MessageCounts>, ResMut<RadioLog>),
    in_flight: Query<(Entity, &Envelope, &Payload)>,
    mut robots: Query<(&RobotId, &Robot, &mut Inbox)>,
) {
    for (_, robot, mut inbox) in &mut robots {
        let was_read = clock.tick > 0 && robot.is_due(clock.tick - 1);
        if (was_read || !robot.condition.hears()) && !inbox.0.is_empty() {
            inbox.0.clear();
        }
    }
    let due = in_flight.iter().filter(|(_, envelope, _)| envelope.due <= clock.tick);
    let mut due: SmallVec<[_; 8]> = due.collect();
    due.sort_unstable_by_key(|(_, envelope, _)| (envelope.due, envelope.id));
    for (entity, envelope, payload) in due {
        commands.entity(entity).despawn();
        let to = robots.iter_mut().find(|(id, ..)| **id == envelope.to);
        let Some((_, _, mut inbox)) = to.filter(|(_, robot, _)| robot.condition.hears()) else {
            traffic.lose(envelope.from, envelope.to, Loss::Deaf);
            log.lost(envelope.id, Loss::Deaf);
            continue;
        };
        traffic.deliver(envelope.from, envelope.to);
        counts.count_delivered(envelope.kind, envelope.from, envelope.to);
        log.arrived(envelope.id, clock.tick);
        if let Ok(message) = Message::decode(&payload.0) {
            inbox.0.push(Received { from: envelope.from.number, message });
        }
    }
}

type Speaking<'a> = (&'a RobotId, &'a Robot, &'a Pose, &'a mut Outbox);

fn transmit_messages(clock: Res<Clock>, mut air: Air, mut commands: Commands, mut robots: Query<Speaking>) {
    air.log.forget(&clock);
    if robots.iter().all(|(.., outbox)| outbox.0.is_empty()) {
        return;
    }
    let mut places: SmallVec<[(RobotId, Vec2); 16]> =
        robots.iter().map(|(id, _, pose, _)| (*id, pose.position)).collect();
    places.sort_unstable_by_key(|(id, _)| *id);
    for (id, robot, pose, mut outbox) in robots.iter_mut().sort::<&RobotId>() {
        for Outgoing { to, message } in std::mem::take(&mut outbox.0) {
            let bytes = message.encode();
            for (mate, place) in places.iter().filter(|(mate, _)| reaches(*id, to, *mate)) {
                let packet = Packet {
                    kind: message.kind(),
                    from: *id,
                    to: *mate,
                    bytes: bytes.len(),
                    distance: pose.position.distance(*place),
                };
                if robot.condition.mute {
                    air.stifle(&packet, &message, &clock);
                } else {
                    air.send(&packet, &message, &bytes, &clock, &mut commands);
                }
            }
        }
    }
}

fn reaches(from: RobotId, to: Recipient, mate: RobotId) -> bool {
    let is_meant = match to {
        Recipient::Team => true,
        Recipient::Mate(number) => number == mate.number,
    };
    is_meant && mate.team == from.team && mate != from
}
