//! What a robot believes, agrees with its team mates and wants. It knows only what it sensed and heard.

pub mod behaviour;
pub mod motor;
pub mod perception;
pub mod positioning;
pub mod schemas;
pub mod teamwork;
pub mod world_model;

use bevy::prelude::*;

pub(crate) fn plugin(app: &mut App) {
    app.add_plugins((world_model::plugin, teamwork::plugin, behaviour::plugin, motor::plugin));
}
