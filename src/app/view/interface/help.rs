//! The page with all keys.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};

use super::dock::show_in_the_middle;
use crate::app::view::colours::{self, egui as paint};
use crate::app::view::input::keyboard::Keyboard;
use crate::app::view::input::keys::{Deed, MOUSE, bindings};
use crate::app::view::state::{Action, OpenDialogues, PanelSystems, Screen};

pub(super) fn plugin(app: &mut App) {
    app.add_systems(
        EguiPrimaryContextPass,
        show_help.in_set(PanelSystems::Floating).run_if(in_state(Screen::Match)),
    );
}

/// A narrower window has the keys in one column, in points.
const TWO_COLUMNS: f32 = 860.0;

fn show_help(mut contexts: EguiContexts, keyboard: Res<Keyboard>, mut open: ResMut<OpenDialogues>) -> Result {
    if !open.help {
        return Ok(());
    }
    let shown = show_in_the_middle(contexts.ctx_mut()?, "Keys", |ui| {
        ui.heading("Keys");
        ui.add_space(4.0);
        let keys = bindings().map(|binding| (keyboard.keys(binding.deed), binding.does));
        let keys = keys.filter(|(keys, _)| !keys.is_empty());
        let mouse = MOUSE.into_iter().map(|(keys, does)| (keys.to_owned(), does));
        let all: Vec<_> = keys.chain(mouse).collect();
        let columns = if ui.max_rect().width() < TWO_COLUMNS { 1 } else { 2 };
        ui.horizontal_top(|ui| {
            for (column, rows) in all.chunks(all.len().div_ceil(columns)).enumerate() {
                table(ui, column, rows);
                ui.add_space(28.0);
            }
        });
        ui.add_space(8.0);
        ui.label(egui::RichText::new("Signs beside robots").strong());
        crate::app::view::picture::status_icons::show_legend(ui);
        ui.add_space(8.0);
        ui.button("Close").on_hover_text(keyboard.keys(Deed::Act(Action::Escape))).clicked()
    });
    if shown.unwrap_or(false) {
        open.help = false;
    }
    Ok(())
}

fn table(ui: &mut egui::Ui, column: usize, rows: &[(String, &str)]) {
    egui::Grid::new(("keys", column)).num_columns(2).spacing([16.0, 5.0]).show(ui, |ui| {
        for (keys, does) in rows {
            ui.label(egui::RichText::new(keys).color(paint(colours::CALL)));
            ui.label(*does);
            ui.end_row();
        }
    });
}
