//! The whole world, entity by entity and each by its name, in a floating window behind key F12, with bevy-inspector-egui's view of
//! their components. What of the match cannot be looked at field by field is told as text.
//!
//! It is there to look. What is edited there happens outside any tick, so it is no part of what makes a match repeatable.

use bevy::prelude::*;
use bevy_egui::{EguiContext, EguiPrimaryContextPass, PrimaryEguiContext, egui};
use bevy_inspector_egui::{DefaultInspectorConfigPlugin, bevy_inspector};

use super::entity_names::{NamedEntity, named_entities};
use crate::app::view::state::{Inspector, PanelSystems};
use crate::state::{StateKind, StateRegister};

pub(super) fn plugin(app: &mut App) {
    app.add_plugins(DefaultInspectorConfigPlugin).init_resource::<WorldSearch>().add_systems(
        EguiPrimaryContextPass,
        show_world.in_set(PanelSystems::Floating).run_if(|inspector: Res<Inspector>| inspector.world),
    );
}

/// At first it takes this share of the window's height, and no less than so many points; its width.
const SHARE: f32 = 0.7;
const LEAST: f32 = 200.0;
const WIDTH: f32 = 420.0;

/// What a person looks for among the entities.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
struct WorldSearch(String);

fn show_world(world: &mut World) -> Result {
    let mut contexts = world.query_filtered::<&EguiContext, With<PrimaryEguiContext>>();
    let Ok(mut context) = contexts.single(world).cloned() else { return Ok(()) };
    let mut open = true;
    let context = context.get_mut();
    let height = (SHARE * context.content_rect().height()).max(LEAST);
    egui::Window::new("World (F12)").default_size([WIDTH, height]).open(&mut open).show(context, |ui| {
        ui.weak("To look at. A match with values changed here cannot be repeated.");
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
    let kinds = world.resource::<StateRegister>().kinds().to_vec();
    let found = |named: &NamedEntity| named.name.to_lowercase().contains(&search.trim().to_lowercase());
    let all: Vec<NamedEntity> = named_entities(world).into_iter().filter(found).collect();
    for (title, of_match) in [("Match", true), ("Window", false)] {
        let entities: Vec<&NamedEntity> = all.iter().filter(|named| named.of_match == of_match).collect();
        let header =
            egui::CollapsingHeader::new(format!("{title}: {} entities", entities.len())).id_salt(title);
        header.default_open(of_match).show(ui, |ui| {
            for named in entities {
                let header = egui::CollapsingHeader::new(&named.name).id_salt(named.entity);
                header.show(ui, |ui| {
                    bevy_inspector::ui_for_entity_with_children(world, named.entity, ui);
                    if of_match {
                        show_told(&kinds, world, Some(named.entity), ui);
                    }
                });
            }
        });
    }
    ui.collapsing("Resources of the match", |ui| show_told(&kinds, world, None, ui));
    ui.collapsing("Resources", |ui| bevy_inspector::ui_for_resources(world, ui));
    ui.collapsing("Assets", |ui| bevy_inspector::ui_for_all_assets(world, ui));
}

/// What an entity or the world has of the registered state of the match, as text: first what cannot be looked at field by field.
fn show_told(kinds: &[StateKind], world: &World, entity: Option<Entity>, ui: &mut egui::Ui) {
    let types = world.resource::<AppTypeRegistry>().read();
    let is_reflected = |kind: &StateKind| {
        let id = world.components().get_info(kind.id).and_then(|info| info.type_id());
        id.is_some_and(|id| types.get(id).is_some())
    };
    let (by_fields, as_text): (Vec<&StateKind>, Vec<_>) = kinds.iter().partition(|kind| is_reflected(kind));
    let tell = |ui: &mut egui::Ui, kind: &StateKind| {
        if let Some(text) = kind.tell(world, entity) {
            ui.collapsing(kind.name, |ui| ui.monospace(text));
        }
    };
    as_text.into_iter().for_each(|kind| tell(ui, kind));
    if by_fields.iter().any(|kind| kind.tell(world, entity).is_some()) {
        // Fields leave out what is shared between robots and what is of no use to people.
        ui.collapsing("The others as text, whole", |ui| {
            by_fields.into_iter().for_each(|kind| tell(ui, kind))
        });
    }
}
