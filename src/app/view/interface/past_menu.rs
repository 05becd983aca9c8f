//! The menu at the left of the match's line: bookmarks, branches, and what else can be done with the past.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};
use egui::containers::menu::{MenuButton, MenuConfig};

use crate::app::view::format;
use crate::app::view::input::keyboard::Keyboard;
use crate::app::view::state::{Action, Beside, PanelSystems, Screen};
use crate::clock::Clock;
use crate::lab::rewind::{BranchId, Rewind};

pub(super) fn plugin(app: &mut App) {
    app.add_systems(
        EguiPrimaryContextPass,
        read_undo.in_set(PanelSystems::Floating).run_if(in_state(Screen::Match)),
    );
}

/// Panels have looked for it before, and texts have their own.
fn read_undo(mut contexts: EguiContexts, mut actions: MessageWriter<Action>) -> Result {
    const UNDO: egui::KeyboardShortcut = egui::KeyboardShortcut::new(egui::Modifiers::COMMAND, egui::Key::Z);
    let ctx = contexts.ctx_mut()?;
    if !ctx.egui_wants_keyboard_input() && ctx.input_mut(|input| input.consume_shortcut(&UNDO)) {
        actions.write(Action::Undo);
    }
    Ok(())
}

/// Width of the menu's lists, in points.
const WIDTH: f32 = 420.0;

/// Shows the button and its menu; what a person wants.
pub fn show_past_menu(
    ui: &mut egui::Ui,
    rewind: &mut Rewind,
    beside: &mut Beside,
    clock: &Clock,
    keyboard: &Keyboard,
) -> Vec<Action> {
    let mut wanted = Vec::new();
    let stays = MenuConfig::new().close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
    let button = egui::Button::new("Past ⏶").min_size(egui::vec2(56.0, 24.0));
    let (response, _) = MenuButton::from_button(button).config(stays).ui(ui, |ui| {
        ui.set_width(WIDTH);
        let mut button = |ui: &mut egui::Ui, text: &str, action| {
            if ui.button(text).on_hover_text(keyboard.tip(action)).clicked() {
                wanted.push(action);
            }
        };
        ui.horizontal(|ui| {
            button(ui, "Bookmark", Action::Bookmark);
            button(ui, "Undo", Action::Undo);
            button(ui, "Why?", Action::Why);
            button(ui, "Save as scenario", Action::SaveScenario);
        });
        ui.separator();
        egui::ScrollArea::vertical().show(ui, |ui| {
            show_bookmarks(ui, rewind, clock, &mut wanted);
            show_branches(ui, rewind, beside, &mut wanted);
        });
    });
    response.on_hover_text("Bookmarks, and the branches that the match has taken");
    wanted
}

fn show_bookmarks(ui: &mut egui::Ui, rewind: &mut Rewind, clock: &Clock, wanted: &mut Vec<Action>) {
    let mut notes: Vec<(u64, String)> =
        rewind.bookmarks(rewind.present()).map(|(tick, note)| (tick, note.to_owned())).collect();
    notes.sort_unstable();
    if notes.is_empty() {
        ui.weak("No bookmarks.");
    }
    for (tick, note) in notes {
        ui.horizontal(|ui| {
            let time = format::moment(tick, clock.dt);
            if ui.button(time).on_hover_text("Go there").clicked() {
                wanted.push(Action::GoTo(tick));
            }
            let mut text = note;
            let field = egui::TextEdit::singleline(&mut text).desired_width(180.0);
            if ui.add(field).changed() && !text.is_empty() {
                rewind.set_bookmark(tick, text);
            }
            if ui.button("×").on_hover_text("Take the bookmark away").clicked() {
                rewind.set_bookmark(tick, String::new());
            }
        });
    }
    ui.separator();
}

fn show_branches(ui: &mut egui::Ui, rewind: &Rewind, beside: &mut Beside, wanted: &mut Vec<Action>) {
    if rewind.branches().len() == 1 {
        ui.weak("One branch. Go back and do something else, and there are two.");
        return;
    }
    for (id, branch) in rewind.branches() {
        let is_present = id == rewind.present();
        let score = rewind.ghost(id, branch.end).map_or([0, 0], |ghost| ghost.score);
        let text = format!("{}  {} : {}  {}", id.0 + 1, score[0], score[1], branch.name);
        let place = rewind.ghost(id, branch.from).map_or(0.0, |ghost| f64::from(ghost.played));
        let tip =
            format!("From {} on: {}. Play on in this branch", format::clock(place.floor()), branch.name);
        let is_wanted = in_row(ui, |ui| {
            if !is_present {
                show_beside(ui, id, beside);
            }
            // What is left of the row is its name's.
            ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                let label = egui::Button::selectable(is_present, text).truncate();
                ui.add(label).on_hover_text(tip).clicked()
            })
            .inner
        });
        if is_wanted && !is_present {
            wanted.push(Action::TakeBranch(id));
        }
    }
}

/// A row that is filled from its right end.
fn in_row<R>(ui: &mut egui::Ui, fill: impl FnOnce(&mut egui::Ui) -> R) -> R {
    ui.horizontal(|ui| ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), fill).inner).inner
}

fn show_beside(ui: &mut egui::Ui, id: BranchId, beside: &mut Beside) {
    let mut is_shown = beside.0 == Some(id);
    if ui.checkbox(&mut is_shown, "beside").on_hover_text("Show it as ghosts beside this one").changed() {
        beside.0 = is_shown.then_some(id);
    }
}
