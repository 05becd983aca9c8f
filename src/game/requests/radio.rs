//! Requests that concern the radio.

use bevy::prelude::*;

use super::queue::Requests;
use super::request::{RadioChange, Request};
use crate::comms::radio::{Channel, FaultRules, Interference, deliver_packet, drop_packet};
use crate::data::{Bound, Validate};

pub(super) fn change_radio(
    requests: Res<Requests>,
    mut channel: ResMut<Channel>,
    mut interference: ResMut<Interference>,
    mut faults: ResMut<FaultRules>,
    mut commands: Commands,
) {
    for request in requests.due() {
        let Request::Radio(change) = request else { continue };
        match change {
            RadioChange::Change(radio) if radio.validate().is_err() => {}
            RadioChange::Change(radio) => channel.set_radio(radio.clone()),
            RadioChange::ExtraLoss(share) => interference.extra_loss = Bound::SHARE.clamp(*share),
            RadioChange::ExtraDelay(seconds) => interference.extra_delay = Bound::DELAY.clamp(*seconds),
            RadioChange::Jam(jammed) => interference.jammed = *jammed,
            RadioChange::CutOff(robot) => {
                interference.cut_off.insert(*robot);
            }
            RadioChange::Reconnect(robot) => {
                interference.cut_off.remove(robot);
            }
            RadioChange::Part(partition) => interference.partitions.push(partition.clone()),
            RadioChange::Heal => interference.partitions.clear(),
            RadioChange::Fault(rule) if rule.validate().is_err() => {}
            RadioChange::Fault(rule) => faults.add(rule.clone()),
            RadioChange::Drop(id) => {
                let id = *id;
                commands.queue(move |world: &mut World| drop_packet(world, id));
            }
            RadioChange::Deliver(id) => {
                let id = *id;
                commands.queue(move |world: &mut World| deliver_packet(world, id));
            }
        }
    }
}
