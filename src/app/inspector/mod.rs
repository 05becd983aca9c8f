//! The inspector: what goes on inside one robot, in a panel beside the pitch and drawn on it.
//!
//! It reads the simulation and changes it by requests only. Files without `bevy::ecs` are pure: matching,
//! outlines, calibration.

pub(in crate::app) mod breakpoints;
mod calibration;
mod chart;
mod communication;
mod entity_names;
mod fields;
mod low_panel;
mod matching;
mod numbers;
mod outlines;
mod overlays;
mod panel;
mod pending;
mod radio;
pub(in crate::app) mod sections;
mod subject;
pub(in crate::app) mod table;
mod tuner;
pub(in crate::app) mod vision;
mod world_view;

pub(in crate::app) use panel::set_close;
#[cfg(test)]
pub(in crate::app) use radio::RadioView;

use bevy::prelude::*;

/// Adds the panels, the overlays and the view of the world to a window.
pub fn plugin(app: &mut App) {
    app.add_plugins((panel::plugin, overlays::plugin, radio::plugin, communication::plugin, vision::plugin))
        .add_plugins((breakpoints::plugin, chart::plugin, world_view::plugin));
}
