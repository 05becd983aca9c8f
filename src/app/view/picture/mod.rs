//! The match as it is drawn: what lies and moves on the pitch, the camera, and the text beside robots. Units are metres of the
//! pitch frame. What is drawn are entities of their own, which follow the bodies of the simulation; see [`visuals`].

mod ball;
pub mod camera;
pub mod ghosts;
pub mod label_placement;
pub mod labels;
mod pitch;
mod rings;
pub mod robots;
mod shapes;
pub mod status_icons;
pub mod visuals;
pub mod walkers;

use bevy::prelude::*;

pub(super) fn plugin(app: &mut App) {
    app.add_plugins((
        visuals::plugin,
        pitch::plugin,
        robots::plugin,
        walkers::plugin,
        ball::plugin,
        ghosts::plugin,
        rings::plugin,
    ));
}

/// What needs a window: camera and text.
pub(super) fn framed(app: &mut App) {
    app.add_plugins((camera::plugin, labels::plugin));
}
