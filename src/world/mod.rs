//! The truth of a match: bodies, ball, wheels and legs, eyes, and the referee. No mind names anything of it.

pub mod ball;
mod body_events;
pub mod drive;
pub mod gamecontroller;
pub mod handling;
mod impulses;
pub mod physics;
pub mod referee;
pub mod sense;

use bevy::prelude::*;

pub use body_events::{BodyEvent, BodyEvents};
pub use impulses::ContactImpulses;

pub(crate) fn plugin(app: &mut App) {
    app.add_plugins((
        physics::plugin,
        sense::plugin,
        (drive::plugin, handling::plugin),
        (ball::plugin, impulses::plugin),
        referee::plugin,
    ));
}
