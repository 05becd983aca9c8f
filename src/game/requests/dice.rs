//! Requests that concern chance.

use bevy::prelude::*;

use super::queue::Requests;
use super::request::Request;
use crate::comms::radio::Channel;
use crate::ids::MatchEntity;
use crate::rng::DiceStirred;
use crate::state::event;
use crate::world::sense::HallLight;

pub(super) fn stir_dice(
    requests: Res<Requests>,
    mut channel: ResMut<Channel>,
    mut light: ResMut<HallLight>,
    owners: Query<Entity, (With<MatchEntity>, With<Name>)>,
    mut commands: Commands,
) {
    for request in requests.due() {
        let Request::StirDice(salt) = request else { continue };
        let stirred = DiceStirred(*salt);
        channel.stir(stirred);
        light.stir(stirred);
        owners.iter().for_each(|owner| {
            commands.entity(owner).queue(event(stirred));
        });
    }
}
