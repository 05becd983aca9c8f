//! What a person sees of a match and does to it. The window runs the same [`crate::schedule::Tick`] as the headless runner, zero,
//! one or many times a frame, and changes a match by [`crate::game::requests::Requests`] only.
//!
//! Each folder names only those before it: [`state`] is what all share, [`picture`] draws the match, [`time`] lets it run, [`input`]
//! reads keys and pointer, [`interface`] draws bars, dialogues and the menu. The ground are `colours`, `style` and `format`.

pub mod colours;
pub mod format;
pub mod input;
pub mod interface;
pub mod picture;
pub mod state;
pub mod style;
pub mod time;

use bevy::prelude::*;

/// The whole of it, for an app that has a window and egui.
pub(super) fn plugin(app: &mut App) {
    app.insert_resource(ClearColor(colours::FLOOR)).add_plugins((
        played,
        state::interface,
        style::plugin,
        picture::framed,
        input::plugin,
        interface::plugin,
    ));
}

/// The match and its picture, without camera and interface: what can be tried without a window.
fn played(app: &mut App) {
    app.add_plugins((state::plugin, picture::plugin, time::plugin));
}

/// The same as an app of its own, which plays a match in frames of this length.
#[cfg(test)]
fn played_without_a_window(choice: &crate::game::Choice, frame: std::time::Duration) -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::state::app::StatesPlugin));
    app.init_asset::<Mesh>().init_asset::<ColorMaterial>().add_plugins((crate::game::simulation, played));
    app.insert_resource(bevy::time::TimeUpdateStrategy::ManualDuration(frame));
    let assets = concat!(env!("CARGO_MANIFEST_DIR"), "/assets");
    app.insert_resource(state::Folder(crate::data::AssetFolder::new(assets)));
    app.insert_resource(state::PendingMatch(Some(crate::app::match_request::MatchRequest::Match(
        choice.clone(),
    ))));
    app.finish();
    app.cleanup();
    app
}
