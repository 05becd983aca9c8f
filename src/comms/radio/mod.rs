//! The simulated radio, a carrier of the TCM's datagrams: in the Deliver stage it brings those that are due to their robots, in
//! the Transmit stage it puts others on air. A datagram in flight is an entity.

mod air;
mod channel;
mod faults;
mod hand;
mod interference;
mod loss_model;
mod packet;
mod preset;
mod record;
mod stalls;
#[cfg(test)]
mod tests;

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use smallvec::SmallVec;

pub use air::{Air, Airtime, OffAir};
pub use channel::{Channel, Delivery, Loss};
pub use faults::{Act, FaultRule, FaultRules, Which, just_before};
pub(crate) use hand::{deliver_packet, drop_packet};
pub use interference::{Interference, Partition};
pub use packet::{InFlight, Packet};
pub use preset::Radio;
pub use record::{LinkCounters, RadioRecord, Transmission, TransmissionState};

use crate::clock::Clock;
use crate::comms::tcm::{Incoming, OnAir, TcmSystems};
use crate::geometry::Pose;
use crate::ids::{MatchEntity, RobotId};
use crate::robot::Robot;
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;

/// What is written down of packets, whatever carries them.
pub(super) fn record_plugin(app: &mut App) {
    app.match_resource::<RadioRecord>().starts_empty();
}

pub(super) fn plugin(app: &mut App) {
    app.match_resource::<Channel>();
    app.match_resource::<Interference>().starts_empty();
    app.match_resource::<FaultRules>();
    app.match_component::<InFlight>().reflected();
    let receives = deliver_datagrams.in_set(TickSystems::Deliver).before(TcmSystems::Receive);
    let sends = transmit_datagrams.in_set(TickSystems::Transmit).after(TcmSystems::Send);
    app.add_systems(Tick, (receives.in_set(RadioSystems), sends.in_set(RadioSystems)));
}

/// The simulated radio, which stands by where datagrams cross a real network.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct RadioSystems;

/// The radio of a match: all that decides which packets arrive, and the record of them.
#[derive(SystemParam)]
pub(crate) struct RadioState<'w> {
    channel: ResMut<'w, Channel>,
    interference: Res<'w, Interference>,
    faults: ResMut<'w, FaultRules>,
    record: ResMut<'w, RadioRecord>,
}

impl RadioState<'_> {
    /// Puts a packet on air over so many metres: what the channel lets through is in flight then.
    fn send(&mut self, packet: Packet, distance: f32, clock: &Clock, commands: &mut Commands) {
        let delivery = self.channel.send(&packet, distance, &self.interference, &mut self.faults, clock);
        let id = self.record.sent(&packet, &delivery, clock.tick);
        for arrival in delivery.arrivals {
            let in_flight = InFlight { id, packet: packet.clone(), due: arrival.due, late: arrival.late };
            commands.spawn((in_flight, MatchEntity));
        }
    }
}

pub(crate) fn deliver_datagrams(
    clock: Res<Clock>,
    mut commands: Commands,
    mut record: ResMut<RadioRecord>,
    mut incoming: ResMut<Incoming>,
    in_flight: Query<(Entity, &InFlight)>,
    robots: Query<(&RobotId, &Robot)>,
) {
    let due = in_flight.iter().filter(|(_, in_flight)| in_flight.due <= clock.tick);
    let mut due: SmallVec<[_; 8]> = due.collect();
    due.sort_unstable_by_key(|(_, in_flight)| (in_flight.due, in_flight.id));
    for (entity, InFlight { id, packet, .. }) in due {
        commands.entity(entity).despawn();
        let to = robots.iter().find(|(id, _)| **id == packet.to);
        if to.is_some_and(|(_, robot)| robot.health.hears()) {
            record.delivered(*id, packet, clock.tick);
            incoming.0.push((packet.to, packet.bytes.clone()));
        } else {
            record.lost(*id, packet, Loss::Deaf);
        }
    }
}

pub(crate) fn transmit_datagrams(
    clock: Res<Clock>,
    mut on_air: ResMut<OnAir>,
    mut radio: RadioState,
    mut commands: Commands,
    robots: Query<(&RobotId, &Robot, &Pose)>,
) {
    radio.record.forget(&clock);
    let robot = |wanted: RobotId| robots.iter().find(|(id, ..)| **id == wanted);
    let mut said = std::mem::take(&mut on_air.0);
    said.retain(|datagram| {
        let is_mute = robot(datagram.from).is_some_and(|(_, sender, _)| sender.health.mute);
        if let Some(packet) = Packet::of(datagram).filter(|_| is_mute) {
            radio.record.drop_muted(&packet, clock.tick);
        }
        !is_mute
    });
    for off_air in radio.channel.off_air(said, &clock) {
        let (datagram, is_clear) = match off_air {
            OffAir::Clear(datagram) => (datagram, true),
            OffAir::Lost(datagram) => (datagram, false),
        };
        // Computers have no antenna in a simulated match.
        let Some(packet) = Packet::of(&datagram) else { continue };
        let (Some((.., from)), Some((.., to))) = (robot(packet.from), robot(packet.to)) else { continue };
        if is_clear {
            radio.send(packet, from.position.distance(to.position), &clock, &mut commands);
        } else {
            radio.record.sent(&packet, &Delivery::lost(Loss::Air), clock.tick);
        }
    }
}
