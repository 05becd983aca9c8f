//! A hand on single packets: one under way is dropped or arrives at once, and one that was lost arrives after all.

use bevy::prelude::*;

use super::channel::Loss;
use super::packet::InFlight;
use super::record::RadioRecord;
use crate::clock::Clock;
use crate::ids::MatchEntity;

/// Drops a packet with all its copies that are under way, by the number of its transmission; as a fault would.
pub(crate) fn drop_packet(world: &mut World, id: u64) {
    for (copy, in_flight) in copies(world, id) {
        world.despawn(copy);
        world.resource_mut::<RadioRecord>().lost(id, &in_flight.packet, Loss::Fault);
    }
}

/// Brings a packet to its receiver in this tick, by the number of its transmission: the copy that would come first, or if it
/// was lost, one more. What was lost more than a minute ago nobody remembers.
pub(crate) fn deliver_packet(world: &mut World, id: u64) {
    let due = world.resource::<Clock>().tick;
    let copies = copies(world, id);
    let first = copies.into_iter().min_by_key(|(_, in_flight)| in_flight.due);
    if let Some((copy, in_flight)) = first {
        world.entity_mut(copy).insert(InFlight { due, ..in_flight });
    } else if let Some(packet) = world.resource_mut::<RadioRecord>().send_again(id, due) {
        world.spawn((InFlight { id, packet, due, late: true }, MatchEntity));
    }
}

fn copies(world: &mut World, id: u64) -> Vec<(Entity, InFlight)> {
    let mut in_flight = world.query::<(Entity, &InFlight)>();
    let copies = in_flight.iter(world).filter(|(_, copy)| copy.id == id);
    copies.map(|(entity, copy)| (entity, copy.clone())).collect()
}
