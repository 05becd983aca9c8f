//! The whole world, entity by entity, in a floating window behind key F12: bevy-inspector-egui's own view of it.
//!
//! It is there to look. What is edited there happens outside any tick, so it is no part of what makes a match repeatable.

use bevy::prelude::*;
use bevy_egui::{EguiContext, EguiPrimaryContextPass, PrimaryEguiContext, egui};
use bevy_inspector_egui::{DefaultInspectorConfigPlugin, bevy_inspector};

use crate::app::view::state::{Inspector, PanelSystems};
use crate::ids::MatchEntity;
use crate::state::StateRegister;

pub(super) fn plugin(app: &mut App) {
    app.add_plugins(DefaultInspectorConfigPlugin).add_systems(
        EguiPrimaryContextPass,
        show_world.in_set(PanelSystems::Floating).run_if(|inspector: Res<Inspector>| inspector.world),
    );
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
            egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
                show_match(world, ui);
                bevy_inspector::ui_for_world(world, ui);
            });
        },
    );
    if let Some(mut inspector) = world.get_resource_mut::<Inspector>().filter(|_| !open) {
        inspector.world = false;
    }
    Ok(())
}

/// Everything that is registered as state of the match, by its resources and bodies.
fn show_match(world: &mut World, ui: &mut egui::Ui) {
    let kinds = world.resource::<StateRegister>().kinds().to_vec();
    let mut bodies: Vec<(String, Entity)> = (world.query_filtered::<(Entity, &Name), With<MatchEntity>>())
        .iter(world)
        .map(|(entity, name)| (name.to_string(), entity))
        .collect();
    bodies.sort();
    let show_kinds = |entity: Option<Entity>, ui: &mut egui::Ui| {
        for (kind, text) in kinds.iter().filter_map(|kind| Some((kind, kind.tell(world, entity)?))) {
            ui.collapsing(kind.name, |ui| ui.monospace(text));
        }
    };
    ui.collapsing("Match", |ui| {
        ui.collapsing("resources", |ui| show_kinds(None, ui));
        for (name, entity) in &bodies {
            ui.collapsing(name, |ui| show_kinds(Some(*entity), ui));
        }
    });
}
