//! The inspector: what goes on inside one robot, in a panel beside the pitch and drawn upon it.
//!
//! It reads the simulation and changes it by requests only. Files without `bevy::ecs` are pure: figures, matching, kinds of
//! schemas, outlines.

mod calibration;
mod communication;
mod figures;
mod kinds;
mod matching;
mod overlays;
mod panel;
mod radio;
mod sections;
mod strokes;
mod subject;
mod table;
mod tints;
mod weights;
mod world_view;

use bevy::input::keyboard::{Key, KeyboardInput};
use bevy::prelude::*;
use bevy_egui::input::egui_wants_any_keyboard_input;

use crate::view::state::Screen;

/// Adds the panel, the overlays and the view of the world to a window.
pub fn plugin(app: &mut App) {
    app.init_resource::<Inspector>()
        .add_plugins((
            panel::plugin,
            overlays::plugin,
            radio::plugin,
            communication::plugin,
            weights::plugin,
            world_view::plugin,
        ))
        .add_systems(
            Update,
            toggle.run_if(in_state(Screen::Match).and_then(not(egui_wants_any_keyboard_input))),
        );
}

/// What of the inspector is open.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inspector {
    /// The panel; key I.
    pub open: bool,
    /// The view of the whole world; key F12.
    pub world: bool,
}

impl Default for Inspector {
    fn default() -> Inspector {
        Inspector { open: true, world: false }
    }
}

fn toggle(mut typed: MessageReader<KeyboardInput>, mut inspector: ResMut<Inspector>) {
    for key in typed.read().filter(|key| key.state.is_pressed() && !key.repeat) {
        match &key.logical_key {
            Key::Character(text) if text.eq_ignore_ascii_case("i") => inspector.open = !inspector.open,
            Key::F12 => inspector.world = !inspector.world,
            _ => {}
        }
    }
}
