//! The window: puts view and inspector together, opens them, and tells how it ended.

mod frame_rate;

use std::path::PathBuf;

use bevy::app::PluginGroupBuilder;
use bevy::log::{Level, LogPlugin};
use bevy::prelude::*;
use bevy::window::{PresentMode, WindowResolution};
use bevy_egui::EguiPlugin;

use crate::app::match_request::MatchRequest;
use crate::app::view::interface::{settings, window_size};
use crate::app::view::state::{Folder, PendingMatch};
use crate::app::view::time::{expectations, recording::Recording};
use crate::app::{inspector, logging, view};
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
/// What is played is recorded, if a file for it is given; the frame rate is told, if that is wanted.
pub fn open_window(
    assets: &AssetFolder,
    wanted: Option<MatchRequest>,
    record: Option<PathBuf>,
    tells_frame_rate: bool,
) -> WindowEnd {
    let mut app = App::new();
    app.add_plugins(default_plugins("Touchline"));
    if tells_frame_rate {
        app.add_plugins(frame_rate::plugin);
    }
    app.add_plugins((EguiPlugin::default(), crate::game::simulation, view::plugin, inspector::plugin));
    app.insert_resource(Folder(assets.clone()));
    app.insert_resource(PendingMatch(wanted));
    app.insert_resource(Recording::to(record));
    if let Some(file) = settings::SettingsFile::of_this_person() {
        app.insert_resource(file);
    }
    ended(app.run())
}

/// What any window of the program needs of Bevy.
pub(super) fn default_plugins(title: &str) -> PluginGroupBuilder {
    let log = LogPlugin {
        level: Level::ERROR,
        // What a referee box, ChaosManager and robots of other processes do is news to whoever has a terminal beside the window.
        filter: "touchline::game::net=info".into(),
        fmt_layer: logging::window_layer,
        ..default()
    };
    DefaultPlugins.set(WindowPlugin { primary_window: Some(window(title)), ..default() }).set(log)
}

/// What the end of a window's program means.
pub(super) fn ended(exit: AppExit) -> WindowEnd {
    match exit {
        AppExit::Success => WindowEnd::Closed,
        AppExit::Error(code) if code.get() == expectations::FAILED => WindowEnd::ScenarioFailed,
        AppExit::Error(code) if code.get() == INTERRUPTED => WindowEnd::Interrupted,
        AppExit::Error(_) => WindowEnd::Failed,
    }
}

/// What Bevy says after Ctrl-C.
const INTERRUPTED: u8 = 130;

fn window(title: &str) -> Window {
    Window {
        title: title.into(),
        name: Some("touchline".into()),
        resolution: WindowResolution::new(window_size::FIRST.x, window_size::FIRST.y),
        present_mode: PresentMode::AutoVsync,
        ..default()
    }
}

#[cfg(test)]
mod tests;
