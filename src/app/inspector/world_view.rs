//! The whole world, entity by entity and each by its name, in a floating window behind key F12: the state of the match field by field,
//! and everything, also what the engine keeps, in bevy-inspector-egui's view by reflection.
//!
//! It is there to look. What is edited by reflection happens outside any tick, so it is no part of what makes a match repeatable.

use bevy::prelude::*;
use bevy_egui::{EguiContext, EguiPrimaryContextPass, PrimaryEguiContext, egui};
use bevy_inspector_egui::{DefaultInspectorConfigPlugin, bevy_inspector};

use super::entity_names::{NamedEntity, named_entities};
use super::fields::ToldField;
use crate::app::view::state::{FreeArea, Inspector, PanelSystems};
use crate::state::{StateKind, StateRegister};

pub(super) fn plugin(app: &mut App) {
    app.add_plugins(DefaultInspectorConfigPlugin).init_resource::<WorldSearch>().add_systems(
        EguiPrimaryContextPass,
        show_world.in_set(PanelSystems::Floating).run_if(|inspector: Res<Inspector>| inspector.world),
    );
}

/// At first it takes this share of the pitch's height, and no less than so many points; its width, and how far it is from the edges.
const SHARE: f32 = 0.9;
const LEAST: f32 = 200.0;
const WIDTH: f32 = 420.0;
const GAP: f32 = 12.0;

/// What a person looks for among the entities.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
struct WorldSearch(String);

fn show_world(world: &mut World) -> Result {
    let mut contexts = world.query_filtered::<&EguiContext, With<PrimaryEguiContext>>();
    let Ok(mut context) = contexts.single(world).cloned() else { return Ok(()) };
    let mut open = true;
    let context = context.get_mut();
    let area = world.resource::<FreeArea>().0;
    let height = (SHARE * area.height()).max(LEAST);
    let window = egui::Window::new("World (F12)").default_size([WIDTH, height]).constrain_to(area);
    // The answer to why is at the left.
    let at = area.right_top() + egui::vec2(-GAP, GAP);
    window.pivot(egui::Align2::RIGHT_TOP).default_pos(at).open(&mut open).show(context, |ui| {
        let mut search = world.resource::<WorldSearch>().0.clone();
        ui.horizontal(|ui| {
            ui.label("Find");
            ui.text_edit_singleline(&mut search).on_hover_text("A part of a name, such as LOCK or home 1");
        });
        ui.separator();
        egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| show_all(world, &search, ui));
        world.resource_mut::<WorldSearch>().0 = search;
    });
    if let Some(mut inspector) = world.get_resource_mut::<Inspector>().filter(|_| !open) {
        inspector.world = false;
    }
    Ok(())
}

/// The entities of the match and of the window, then resources and assets.
fn show_all(world: &mut World, search: &str, ui: &mut egui::Ui) {
    let mut kinds = world.resource::<StateRegister>().kinds().to_vec();
    kinds.sort_by_key(|kind| kind.name);
    let found = |named: &NamedEntity| named.name.to_lowercase().contains(&search.trim().to_lowercase());
    let all: Vec<NamedEntity> = named_entities(world).into_iter().filter(found).collect();
    for (title, of_match) in [("Match", true), ("Window", false)] {
        let entities: Vec<&NamedEntity> = all.iter().filter(|named| named.of_match == of_match).collect();
        let header =
            egui::CollapsingHeader::new(format!("{title}: {} entities", entities.len())).id_salt(title);
        header.default_open(of_match).show(ui, |ui| {
            for named in entities {
                let header = egui::CollapsingHeader::new(&named.name).id_salt(named.entity);
                header.show(ui, |ui| show_entity(&kinds, world, named, ui));
            }
        });
    }
    ui.collapsing("Resources of the match", |ui| show_state(&kinds, world, None, ui));
    ui.collapsing("Resources by reflection", |ui| bevy_inspector::ui_for_resources(world, ui));
    ui.collapsing("Assets by reflection", |ui| bevy_inspector::ui_for_all_assets(world, ui));
}

/// The state of an entity of the match, and its components by reflection.
fn show_entity(kinds: &[StateKind], world: &mut World, named: &NamedEntity, ui: &mut egui::Ui) {
    if !named.of_match {
        return bevy_inspector::ui_for_entity_with_children(world, named.entity, ui);
    }
    show_state(kinds, world, Some(named.entity), ui);
    ui.collapsing("All components by reflection", |ui| {
        ui.weak("A match with values changed here cannot be repeated.");
        bevy_inspector::ui_for_entity_with_children(world, named.entity, ui);
    });
}

/// What an entity or the world has of the registered state of the match, field by field.
fn show_state(kinds: &[StateKind], world: &World, entity: Option<Entity>, ui: &mut egui::Ui) {
    for kind in kinds.iter().filter(|kind| kind.is_there(world, entity)) {
        ui.collapsing(kind.name, |ui| {
            let text = kind.tell(world, entity).unwrap_or_default();
            ToldField::of(&text).show(ui);
        });
    }
}
