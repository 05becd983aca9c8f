//! The numbers of a team's strategy in the inspector.

use std::sync::Arc;

use bevy::prelude::*;
use bevy_egui::egui::{self, RichText};

use super::rows::{FoundNumbers, NumberRow, changed};
use super::save::save;
use crate::app::inspector::tuner::{RESET, ROW};
use crate::app::view::colours;
use crate::game::MatchPlan;
use crate::game::requests::{Request, Requests};
use crate::ids::Team;
use crate::strategy::StrategyTexts;

/// What a person looks for among the numbers, what they have changed, and what came of it.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct NumberDesk {
    /// Part of a path.
    pub filter: String,
    /// Only those that differ from their files.
    pub only_changed: bool,
    found: FoundNumbers,
    /// What ran before each change, oldest first.
    undo: Vec<(Team, Arc<StrategyTexts>)>,
    /// What came of the last change, and whether it is bad.
    told: Option<(String, bool)>,
    /// A number under a person's hand: its place among the rows, and its value.
    held: Option<(usize, f64)>,
}

/// The texts of a team's strategy.
#[derive(Clone, Copy, Debug)]
pub struct RunningTexts<'a> {
    /// Whose it is.
    pub team: Team,
    /// As they run.
    pub running: &'a Arc<StrategyTexts>,
    /// The match that they run in.
    pub plan: &'a MatchPlan,
}

/// What the rows ask for.
enum Wish {
    Set(NumberRow, f64),
    Undo,
    Save,
}

/// Rows that are shown at once, in points of height.
const HEIGHT: f32 = 300.0;
/// Width of a number, in points.
const NUMBER: f32 = 76.0;
/// The fraction of one that a number shows.
const DECIMALS: f64 = 1e4;

/// Draws all numbers of a team's strategy, and asks for what is changed.
pub fn draw(ui: &mut egui::Ui, texts: RunningTexts, desk: &mut NumberDesk, requests: &mut Requests) {
    let running = asked(&texts, requests).unwrap_or_else(|| texts.running.clone());
    let filed = &texts.plan.team(texts.team).strategy_texts;
    let all = desk.found.of(&running, filed);
    let mut wish = draw_toolbar(ui, &all, texts.team, desk);
    if let Some((line, is_bad)) = &desk.told {
        let colour = if *is_bad { ui.visuals().error_fg_color } else { ui.visuals().weak_text_color() };
        ui.colored_label(colour, line);
    }
    let wanted = desk.filter.to_lowercase();
    let shown: Vec<usize> = (0..all.len())
        .filter(|place| !desk.only_changed || all[*place].differs())
        .filter(|place| wanted.is_empty() || all[*place].path.to_lowercase().contains(&wanted))
        .collect();
    egui::ScrollArea::vertical().max_height(HEIGHT).auto_shrink([false, true]).show_rows(
        ui,
        ROW,
        shown.len(),
        |ui, range| {
            for place in &shown[range] {
                let value = draw_row(ui, *place, &all[*place], desk);
                wish = value.map(|value| Wish::Set(all[*place].clone(), value)).or(wish.take());
            }
        },
    );
    match wish {
        Some(Wish::Set(row, value)) => set(&texts, &running, changed(&running, &row, value), desk, requests),
        Some(Wish::Undo) => undo(&texts, desk, requests),
        Some(Wish::Save) => {
            desk.told = Some(match save(&running, filed) {
                Ok(files) => (format!("Saved in {}", files.join(", ")), false),
                Err(error) => (error, true),
            });
        }
        None => {}
    }
}

/// The newest texts that wait for the next tick.
fn asked(texts: &RunningTexts, requests: &Requests) -> Option<Arc<StrategyTexts>> {
    let of_team = |request: &Request| match request {
        Request::ChangeStrategy { team, texts: asked, .. } if *team == texts.team => Some(asked.clone()),
        _ => None,
    };
    requests.iter().filter_map(of_team).last()
}

fn draw_toolbar(ui: &mut egui::Ui, all: &[NumberRow], team: Team, desk: &mut NumberDesk) -> Option<Wish> {
    let differ = all.iter().filter(|row| row.differs()).count();
    let mut wish = None;
    ui.horizontal(|ui| {
        let hint = format!("find among {} numbers", all.len());
        ui.add(egui::TextEdit::singleline(&mut desk.filter).hint_text(hint).desired_width(174.0));
        let changed = ui.checkbox(&mut desk.only_changed, format!("changed ({differ})"));
        changed.on_hover_text("Only the numbers that differ from their files");
        let can_undo = desk.undo.iter().any(|(of, _)| *of == team);
        if ui.add_enabled(can_undo, egui::Button::new("Undo")).clicked() {
            wish = Some(Wish::Undo);
        }
        let save = ui.add_enabled(differ > 0, egui::Button::new("Save"));
        let tip = "Writes the changed numbers into their files; comments and layout stay as they are";
        if save.on_hover_text(tip).clicked() {
            wish = Some(Wish::Save);
        }
    });
    wish
}

/// Draws a number; its new value when a person lets it go.
fn draw_row(ui: &mut egui::Ui, place: usize, row: &NumberRow, desk: &mut NumberDesk) -> Option<f64> {
    let mut set = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let room = (ui.available_width() - NUMBER - RESET - 2.0 * 4.0).max(60.0);
        let path = RichText::new(&row.path);
        let path = if row.differs() { path.color(colours::egui(colours::CHANGED)) } else { path };
        let file = row.file.display();
        let label = egui::Label::new(path).truncate().selectable(false);
        let (size, from_the_left) = (egui::vec2(room, ROW), egui::Layout::left_to_right(egui::Align::Center));
        let name = ui.allocate_ui_with_layout(size, from_the_left, |ui| {
            ui.set_min_size(size);
            ui.add(label)
        });
        name.inner.on_hover_text(format!("{}\n{file}", row.path));
        let held = desk.held.filter(|(held, _)| *held == place).map(|(_, value)| value);
        let mut value = held.unwrap_or(row.number.value);
        let number = egui::DragValue::new(&mut value)
            .speed(speed(row))
            .max_decimals(if row.number.is_whole { 0 } else { 4 })
            .custom_formatter(|value, _| as_written(value))
            .update_while_editing(false);
        let number = ui.add_sized([NUMBER, ROW], number);
        if number.dragged() {
            desk.held = Some((place, value));
        } else if held.is_some() || value != row.number.value {
            desk.held = None;
            set = Some(value).filter(|value| *value != row.number.value);
        }
        if let Some(filed) = row.filed.filter(|_| row.differs()) {
            let reset = ui.add_sized([RESET, ROW], egui::Button::new("⟲").frame(false));
            if reset.on_hover_text(format!("Back to the file's {filed}")).clicked() {
                set = Some(filed);
            }
        }
    });
    set
}

/// As short as a file would say it, with the minus sign of other figures.
fn as_written(value: f64) -> String {
    let rounded = (value * DECIMALS).round() / DECIMALS + 0.0;
    format!("{rounded}").replace('-', "−")
}

/// A hundredth of the number for a point that it is dragged.
fn speed(row: &NumberRow) -> f64 {
    if row.number.is_whole { 0.05 } else { (row.number.value.abs() / 100.0).max(0.001) }
}

/// The team plays on with other texts, unless they are no sound strategy.
fn set(
    texts: &RunningTexts,
    running: &Arc<StrategyTexts>,
    new: StrategyTexts,
    desk: &mut NumberDesk,
    requests: &mut Requests,
) {
    if ask(texts, new, desk, requests) {
        desk.undo.push((texts.team, running.clone()));
    }
}

fn undo(texts: &RunningTexts, desk: &mut NumberDesk, requests: &mut Requests) {
    let last = desk.undo.iter().rposition(|(team, _)| *team == texts.team);
    if let Some(last) = last {
        let (_, before) = desk.undo.remove(last);
        ask(texts, StrategyTexts::clone(&before), desk, requests);
    }
}

fn ask(texts: &RunningTexts, new: StrategyTexts, desk: &mut NumberDesk, requests: &mut Requests) -> bool {
    let reading = texts.plan.read_kept(texts.team, &new);
    match reading.strategy {
        Ok(strategy) => {
            desk.told = None;
            let (team, strategy) = (texts.team, Arc::new(strategy));
            requests.ask(Request::ChangeStrategy { team, strategy, texts: reading.texts });
            true
        }
        Err(error) => {
            desk.told = Some((error.to_string(), true));
            false
        }
    }
}
