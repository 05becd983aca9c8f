//! Requests that change the light of the hall.

use bevy::prelude::*;

use super::queue::Requests;
use super::request::Request;
use crate::data::Validate;
use crate::world::sense::HallLight;

/// Light that makes no sense changes nothing.
pub(super) fn change_light(requests: Res<Requests>, mut light: ResMut<HallLight>) {
    for request in requests.due() {
        if let Request::Light(lighting) = request
            && lighting.validate().is_ok()
        {
            light.light.mean = *lighting;
        }
    }
}
