//! What robots say to each other: messages, the communication module that cuts them into datagrams, and the radio that they
//! cross.

pub mod messages;
pub mod radio;
pub mod tcm;

use bevy::prelude::*;

pub(crate) fn plugin(app: &mut App) {
    app.add_plugins((modules, radio::plugin));
}

/// The communication modules of robots, whatever carries their datagrams.
pub(crate) fn modules(app: &mut App) {
    app.add_plugins((tcm::plugin, messages::plugin, radio::record_plugin));
}
