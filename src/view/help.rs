//! The page with all keys.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};

use super::actions::{Action, BINDINGS};
use super::colours::{self, egui as paint};
use super::dialogues::{Open, middle_window};
use super::layout::{FreeArea, PanelSystems};
use super::pilot_seat::DRIVING_KEYS;
use super::state::Screen;

pub(super) fn plugin(app: &mut App) {
    app.add_systems(
        EguiPrimaryContextPass,
        show_help.in_set(PanelSystems::Floating).run_if(in_state(Screen::Match)),
    );
}

/// The keys of the inspector, which reads them itself.
const INSPECTOR: [(&str, &str); 2] =
    [("I", "Open or close the inspector"), ("F12", "The whole world, entity by entity")];
/// What the mouse does.
const MOUSE: [(&str, &str); 3] =
    [("Click", "Select a robot"), ("Drag", "Move the pitch"), ("Wheel", "Zoom at the pointer")];

fn show_help(mut contexts: EguiContexts, area: Res<FreeArea>, mut open: ResMut<Open>) -> Result {
    if !open.help {
        return Ok(());
    }
    let shown = middle_window("Keys", &area).show(contexts.ctx_mut()?, |ui| {
        ui.heading("Keys");
        ui.add_space(4.0);
        let keys = BINDINGS.iter().filter(|binding| binding.action != Action::Leave);
        let keys = keys.map(|binding| (binding.keys, binding.does));
        let all: Vec<_> = DRIVING_KEYS.into_iter().chain(keys).chain(INSPECTOR).chain(MOUSE).collect();
        let (first, second) = all.split_at(all.len().div_ceil(2));
        ui.horizontal_top(|ui| {
            table(ui, "first", first);
            ui.add_space(28.0);
            table(ui, "second", second);
        });
        ui.add_space(8.0);
        ui.label(egui::RichText::new("Signs beside robots").strong());
        ui.scope(|ui| {
            ui.set_max_width(820.0);
            super::signs::show_legend(ui);
        });
        ui.add_space(8.0);
        ui.button("Close").on_hover_text("Escape").clicked()
    });
    if shown.and_then(|shown| shown.inner).unwrap_or(false) {
        open.help = false;
    }
    Ok(())
}

fn table(ui: &mut egui::Ui, name: &str, rows: &[(&str, &str)]) {
    egui::Grid::new(name).num_columns(2).spacing([16.0, 7.0]).show(ui, |ui| {
        for (keys, does) in rows {
            ui.label(egui::RichText::new(*keys).color(paint(colours::CALL)));
            ui.label(*does);
            ui.end_row();
        }
    });
}
