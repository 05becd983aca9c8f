//! Requests that concern the radio.

use bevy::prelude::*;

use super::request::{Request, Requests, Weather};
use crate::comms::radio::{Channel, FaultRules, Interference};
use crate::data::Bound;

pub(super) fn change_weather(
    requests: Res<Requests>,
    mut channel: ResMut<Channel>,
    mut interference: ResMut<Interference>,
    mut faults: ResMut<FaultRules>,
) {
    for request in requests.iter() {
        let Request::Air(weather) = request else { continue };
        match weather {
            Weather::Change(radio) if radio.fault().is_some() => {}
            Weather::Change(radio) => channel.set_radio(radio.clone()),
            Weather::ExtraLoss(share) => interference.extra_loss = Bound::SHARE.clamp(*share),
            Weather::ExtraDelay(seconds) => interference.extra_delay = Bound::DELAY.clamp(*seconds),
            Weather::Jam(jammed) => interference.jammed = *jammed,
            Weather::CutOff(robot) => {
                interference.cut_off.insert(*robot);
            }
            Weather::Reconnect(robot) => {
                interference.cut_off.remove(robot);
            }
            Weather::Part(partition) => interference.partitions.push(partition.clone()),
            Weather::Heal => interference.partitions.clear(),
            Weather::Fault(rule) if rule.fault().is_some() => {}
            Weather::Fault(rule) => faults.add(rule.clone()),
        }
    }
}
