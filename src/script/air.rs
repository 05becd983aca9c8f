//! Requests that concern the radio.

use bevy::prelude::*;

use super::requests::{Request, Requests, Weather};
use crate::radio::{Channel, Conditions, FaultRules};

pub(super) fn change_weather(
    requests: Res<Requests>,
    mut channel: ResMut<Channel>,
    mut conditions: ResMut<Conditions>,
    mut faults: ResMut<FaultRules>,
) {
    for request in requests.iter() {
        let Request::Air(weather) = request else { continue };
        match weather {
            Weather::Change(radio) => channel.set_radio(radio.clone()),
            Weather::ExtraLoss(share) if share.is_finite() => conditions.extra_loss = share.clamp(0.0, 1.0),
            Weather::ExtraDelay(seconds) if seconds.is_finite() => conditions.extra_delay = seconds.max(0.0),
            Weather::ExtraLoss(_) | Weather::ExtraDelay(_) => {}
            Weather::Jam(jammed) => conditions.jammed = *jammed,
            Weather::CutOff(robot) => {
                conditions.cut_off.insert(*robot);
            }
            Weather::Reconnect(robot) => {
                conditions.cut_off.remove(robot);
            }
            Weather::Part(partition) => conditions.partitions.push(partition.clone()),
            Weather::Heal => conditions.partitions.clear(),
            Weather::Fault(rule) => faults.add(rule.clone()),
        }
    }
}
