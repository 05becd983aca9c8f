//! The whole world, entity by entity, in a floating window behind key F12: bevy-inspector-egui's own view of it.
//!
//! It is there to look. What is edited there happens outside any tick, so it is no part of what makes a match repeatable.

use bevy::prelude::*;
use bevy_egui::{EguiContext, EguiPrimaryContextPass, PrimaryEguiContext, egui};
use bevy_inspector_egui::{DefaultInspectorConfigPlugin, bevy_inspector};

use crate::app::view::state::{Inspector, PanelSystems};
use crate::clock::Clock;
use crate::geometry::{Pose, Twist};
use crate::robot::pilot::Pilot;
use crate::strategy::Role;

pub(super) fn plugin(app: &mut App) {
    register_what_can_be_looked_at(app);
    app.add_plugins(DefaultInspectorConfigPlugin).add_systems(
        EguiPrimaryContextPass,
        show_world.in_set(PanelSystems::Floating).run_if(|inspector: Res<Inspector>| inspector.world),
    );
}

/// The simulation's own types that can be reflected; without this the view only names them.
fn register_what_can_be_looked_at(app: &mut App) {
    app.register_type::<Pose>()
        .register_type::<Twist>()
        .register_type::<Role>()
        .register_type::<Pilot>()
        .register_type::<Clock>()
        .register_type_data::<Pose, ReflectComponent>()
        .register_type_data::<Twist, ReflectComponent>()
        .register_type_data::<Role, ReflectComponent>()
        .register_type_data::<Pilot, ReflectComponent>()
        .register_type_data::<Clock, ReflectResource>();
}

fn show_world(world: &mut World) -> Result {
    let mut contexts = world.query_filtered::<&EguiContext, With<PrimaryEguiContext>>();
    let Ok(mut context) = contexts.single(world).cloned() else { return Ok(()) };
    let mut open = true;
    egui::Window::new("World (F12)").default_size([420.0, 520.0]).open(&mut open).show(
        context.get_mut(),
        |ui| {
            ui.weak("To look at. A match with values changed here cannot be repeated.");
            ui.separator();
            egui::ScrollArea::both()
                .auto_shrink(false)
                .show(ui, |ui| bevy_inspector::ui_for_world(world, ui));
        },
    );
    if let Some(mut inspector) = world.get_resource_mut::<Inspector>().filter(|_| !open) {
        inspector.world = false;
    }
    Ok(())
}
