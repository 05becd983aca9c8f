//! What a person does: keys and pointer become actions, and actions become requests and changes of the shared state.

mod actions;
mod carrying;
pub mod driving;
pub mod keyboard;
pub mod keys;
pub mod manual_control;
mod pointer;
mod selection;
mod zoom;

use bevy::prelude::*;

pub(super) fn plugin(app: &mut App) {
    app.add_plugins((
        actions::plugin,
        carrying::plugin,
        driving::plugin,
        keyboard::plugin,
        pointer::plugin,
        selection::plugin,
        zoom::plugin,
    ));
}
