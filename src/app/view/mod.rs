//! The window: shows a match as it is and passes on what people want of it. It runs the same [`crate::schedule::Tick`] as the
//! headless runner, zero, one or many times a frame, and changes a match by [`crate::game::requests::Requests`] only.
//!
//! Units of the picture are metres of the pitch frame. What is drawn are entities of their own, which follow the bodies of
//! the simulation; see [`shown`].

pub mod actions;
mod ball;
mod bottom_bar;
mod calls;
pub mod camera;
pub mod colours;
mod custom;
mod dialogues;
mod display;
pub mod driver;
mod expectations;
mod greeting;
mod help;
#[cfg(test)]
mod interface_tests;
pub mod keys;
pub mod labels;
pub mod layout;
pub mod levers;
mod menu;
mod menu_art;
pub mod nudge;
pub mod opened;
mod pilot_seat;
mod pitch;
mod reload;
mod rings;
pub mod robots;
mod scenario_box;
mod scenario_list;
mod selection;
pub mod session;
pub mod settings;
mod shapes;
pub mod shown;
mod signs;
pub mod state;
mod style;
mod time_line;
mod top_bar;
pub mod walkers;
mod window_size;

use bevy::log::{Level, LogPlugin};
use bevy::prelude::*;
use bevy::window::{PresentMode, WindowResolution};
use bevy_egui::EguiPlugin;

pub use display::missing_for_a_window;
pub use session::Wanted;

use crate::data::AssetFolder;

/// How the window came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WindowEnd {
    /// By a person.
    Closed,
    /// By a person, while it showed a scenario that had failed.
    ScenarioFailed,
    /// By Ctrl-C in the terminal.
    Interrupted,
    /// By itself.
    Failed,
}

/// Opens the window and returns how it ended: begins at the menu, or in the match if one is wanted.
pub fn open_window(assets: &AssetFolder, wanted: Option<Wanted>) -> WindowEnd {
    let mut app = App::new();
    app.add_plugins(DefaultPlugins.set(WindowPlugin { primary_window: Some(window()), ..default() }).set(
        LogPlugin {
            level: Level::ERROR,
            filter: String::new(),
            fmt_layer: crate::app::logging::window_layer,
            ..default()
        },
    ));
    app.add_plugins((EguiPlugin::default(), crate::simulation, plugin, crate::app::inspector::plugin));
    app.insert_resource(session::Folder(assets.clone()));
    app.insert_resource(session::Wish(wanted));
    if let Some(file) = settings::SettingsFile::of_this_person() {
        app.insert_resource(file);
    }
    match app.run() {
        AppExit::Success => WindowEnd::Closed,
        AppExit::Error(code) if code.get() == expectations::FAILED => WindowEnd::ScenarioFailed,
        AppExit::Error(code) if code.get() == INTERRUPTED => WindowEnd::Interrupted,
        AppExit::Error(_) => WindowEnd::Failed,
    }
}

/// What Bevy says after Ctrl-C.
const INTERRUPTED: u8 = 130;

fn window() -> Window {
    Window {
        title: "Touchline".into(),
        name: Some("touchline".into()),
        resolution: WindowResolution::new(window_size::FIRST.x, window_size::FIRST.y),
        present_mode: PresentMode::AutoVsync,
        ..default()
    }
}

/// The order of a frame in `Update`.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum FrameSystems {
    /// Keys and pointer become actions.
    Keys,
    /// Actions become requests.
    Input,
    /// The ticks that are due.
    Time,
    /// The picture follows.
    Picture,
}

fn plugin(app: &mut App) {
    app.insert_resource(ClearColor(colours::FLOOR))
        .add_plugins((played, layout::plugin, style::plugin, camera::plugin, labels::plugin, reload::plugin))
        .add_plugins((actions::plugin, keys::plugin, selection::plugin, pilot_seat::plugin))
        .add_plugins((
            top_bar::plugin,
            bottom_bar::plugin,
            dialogues::plugin,
            greeting::plugin,
            help::plugin,
            menu::plugin,
        ))
        .add_plugins((scenario_box::plugin, opened::plugin, settings::plugin, window_size::plugin));
}

/// The match and its picture, without camera and interface: what can be tried without a window.
fn played(app: &mut App) {
    app.init_state::<state::Screen>()
        .init_resource::<state::Selected>()
        .init_resource::<state::Piloted>()
        .init_resource::<state::Overlays>()
        .init_resource::<state::Pace>()
        .init_resource::<dialogues::Open>()
        .configure_sets(
            Update,
            (FrameSystems::Keys, FrameSystems::Input, FrameSystems::Time, FrameSystems::Picture)
                .chain()
                .run_if(in_state(state::Screen::Match)),
        )
        .add_plugins((
            session::plugin,
            driver::plugin,
            expectations::plugin,
            shown::plugin,
            calls::plugin,
            greeting::waiting,
        ))
        .add_plugins((pitch::plugin, robots::plugin, walkers::plugin, ball::plugin, rings::plugin));
}
