//! The packets of a referee box become what is known of it; the Referee stage does what it says.

use bevy::prelude::*;

use super::queue::Requests;
use super::request::Request;
use crate::clock::Clock;
use crate::world::gamecontroller::BoxNews;

pub(super) fn hear_referee_box(clock: Res<Clock>, requests: Res<Requests>, news: Option<ResMut<BoxNews>>) {
    let Some(mut news) = news else { return };
    for request in requests.due() {
        if let Request::RefereeBox { from, bytes } = request {
            news.hear(*from, bytes, &clock);
        }
    }
}
