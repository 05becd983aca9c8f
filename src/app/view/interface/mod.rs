//! What lies over and around the pitch: bars, dialogues, the scenario's box, and the menu. Each control is an
//! [`Action`](super::state::Action), and its tooltip names its keys.

mod bottom_bar;
mod custom_match;
mod dialogues;
pub mod dock;
mod help;
mod menu;
mod menu_art;
mod past_menu;
pub mod saving;
mod scenario_box;
mod scenario_list;
pub mod settings;
mod time_line;
mod time_scale;
mod top_bar;
mod waiting;
mod why_box;
pub mod window_size;

use bevy::prelude::*;

pub(super) fn plugin(app: &mut App) {
    app.add_plugins((
        top_bar::plugin,
        bottom_bar::plugin,
        past_menu::plugin,
        saving::plugin,
        dialogues::plugin,
        help::plugin,
        menu::plugin,
    ))
    .add_plugins((
        scenario_box::plugin,
        waiting::plugin,
        why_box::plugin,
        settings::plugin,
        window_size::plugin,
    ));
}
