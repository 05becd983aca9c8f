//! The bar across the bottom: time, the robot in hand, the overlays, and the events of the match on a line. Each control is an
//! [`Action`], and its tooltip names its key.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};
use egui::containers::menu::{MenuButton, MenuConfig};

use super::past_menu::show_past_menu;
use super::time_line::show_time_line;
use super::time_scale::{PlayedSoFar, TimeScale};
use crate::app::view::colours::{self, egui as paint};
use crate::app::view::format;
use crate::app::view::input::driving::DrivenRobot;
use crate::app::view::input::keyboard::Keyboard;
use crate::app::view::input::keys::{Deed, DriveKey};
use crate::app::view::state::{
    Action, Beside, Edge, FreeArea, Overlay, Overlays, PanelSystems, Piloted, Playback, Screen, Selected,
};
use crate::app::view::style::panel_frame;
use crate::app::view::time::expectations::Expectations;
use crate::clock::Clock;
use crate::ids::RobotId;
use crate::lab::rewind::{MatchEventKind, Rewind};
use crate::world::referee::{Decision, RuleBook};

pub(super) fn plugin(app: &mut App) {
    app.add_systems(
        EguiPrimaryContextPass,
        (show_bottom_bar, show_first_minute)
            .chain()
            .in_set(PanelSystems::Bottom)
            .run_if(in_state(Screen::Match)),
    );
}

/// A bar that is narrower than this folds the overlays into a menu, in points.
const WIDE: f32 = 1250.0;
const MARGIN: egui::Margin = egui::Margin { left: 12, right: 12, top: 7, bottom: 6 };
/// Height of a button, in points.
const BUTTON: f32 = 26.0;
/// Room beside the names of overlays, in points.
const NARROW: f32 = 3.0;

/// What the bar shows besides the time line.
#[derive(SystemParam)]
struct Controls<'w> {
    playback: Res<'w, Playback>,
    overlays: ResMut<'w, Overlays>,
    selected: Res<'w, Selected>,
    piloted: Res<'w, Piloted>,
    keyboard: Res<'w, Keyboard>,
    actions: MessageWriter<'w, Action>,
}

impl Controls<'_> {
    fn button(&mut self, ui: &mut egui::Ui, text: &str, width: f32, action: Action) {
        let button = egui::Button::new(text).min_size(egui::vec2(width, BUTTON));
        if ui.add(button).on_hover_text(self.keyboard.tip(action)).clicked() {
            self.actions.write(action);
        }
    }

    fn show_time(&mut self, ui: &mut egui::Ui) {
        self.button(ui, if self.playback.paused { "▶ Play" } else { "⏸ Pause" }, 76.0, Action::PlayOrPause);
        self.button(ui, "Tick", 44.0, Action::OneTick);
        self.button(ui, "−", 28.0, Action::Slower);
        let speed = egui::Label::new(egui::RichText::new(format::times(self.playback.factor())).strong());
        let keys = [Action::Faster, Action::Slower].map(|action| self.keyboard.key(Deed::Act(action)));
        let [faster, slower] = keys;
        ui.add_sized([40.0, BUTTON], speed).on_hover_text(format!("Times real time ({faster} and {slower})"));
        self.button(ui, "+", 28.0, Action::Faster);
    }

    fn show_seat(&mut self, ui: &mut egui::Ui, width: f32) {
        let (words, action) = match (self.piloted.0, self.selected.0) {
            (Some(driven), _) => (format!("Hand {driven} back"), Action::HandOver),
            (None, Some(robot)) => (format!("Drive {robot}"), Action::HandOver),
            (None, None) => ("Select a robot".into(), Action::NextRobot),
        };
        self.button(ui, &words, width, action);
    }

    fn show_overlay(&mut self, ui: &mut egui::Ui, overlay: Overlay) {
        let action = Action::Switch(overlay);
        let name = format!("{} {}", self.keyboard.key(Deed::Act(action)), overlay.title());
        if ui
            .selectable_label(self.overlays.shows(overlay), name)
            .on_hover_text(self.keyboard.tip(action))
            .clicked()
        {
            self.overlays.toggle(overlay);
        }
    }

    /// Everything in one row.
    fn show_wide(&mut self, ui: &mut egui::Ui) {
        ui.horizontal(|ui| {
            self.show_time(ui);
            self.button(ui, "Restart", 64.0, Action::Restart);
            ui.separator();
            self.show_seat(ui, 140.0);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                self.button(ui, "Menu", 52.0, Action::Leave);
                self.button(ui, "?", 28.0, Action::Help);
                ui.separator();
                ui.spacing_mut().button_padding.x = NARROW;
                for overlay in Overlay::ALL.into_iter().rev() {
                    self.show_overlay(ui, overlay);
                }
            });
        });
    }

    /// What is seldom needed in a menu, and the rest in as many rows as it takes.
    fn show_folded(&mut self, ui: &mut egui::Ui) {
        ui.horizontal_wrapped(|ui| {
            self.show_time(ui);
            self.show_seat(ui, 96.0);
            let stays = MenuConfig::new().close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
            let more = egui::Button::new("More ⏶").min_size(egui::vec2(64.0, BUTTON));
            MenuButton::from_button(more).config(stays).ui(ui, |ui| {
                egui::ScrollArea::vertical().show(ui, |ui| {
                    for overlay in Overlay::ALL {
                        self.show_overlay(ui, overlay);
                    }
                    ui.separator();
                    self.button(ui, "Restart", 64.0, Action::Restart);
                });
            });
            self.button(ui, "?", 28.0, Action::Help);
            self.button(ui, "Menu", 52.0, Action::Leave);
        });
    }
}

/// The past and the length of the match.
#[derive(SystemParam)]
struct MatchTime<'w> {
    rewind: ResMut<'w, Rewind>,
    beside: ResMut<'w, Beside>,
    clock: Res<'w, Clock>,
    book: Res<'w, RuleBook>,
    expectations: Res<'w, Expectations>,
}

impl MatchTime<'_> {
    fn scale(&self) -> TimeScale {
        let rewind = &self.rewind;
        let (present, dt) = (rewind.present(), self.clock.dt);
        let is_half_time =
            |what: &MatchEventKind| matches!(what, MatchEventKind::Call(Decision::HalfEnded { half: 1 }));
        let played = PlayedSoFar {
            ticks: rewind.end(),
            seconds: rewind.ghost(present, rewind.end()).map_or(0.0, |ghost| f64::from(ghost.played)),
            half_time: rewind.events(present).find(|event| is_half_time(&event.what)).map(|event| event.tick),
        };
        match self.expectations.end() {
            Some(end) => TimeScale::of_scenario(played, end, dt),
            None => TimeScale::of_match(rewind.start(), played, self.book.half_seconds(), dt),
        }
    }

    /// The row with the line of the match.
    fn show(&mut self, ui: &mut egui::Ui, controls: &mut Controls) {
        let scale = self.scale();
        ui.horizontal(|ui| {
            for action in
                show_past_menu(ui, &mut self.rewind, &mut self.beside, &self.clock, &controls.keyboard)
            {
                controls.actions.write(action);
            }
            if let Some(tick) = show_time_line(ui, &self.rewind, self.beside.0, self.clock.tick, &scale) {
                controls.actions.write(Action::GoTo(tick));
            }
        });
    }
}

fn show_bottom_bar(
    mut contexts: EguiContexts,
    mut area: ResMut<FreeArea>,
    mut controls: Controls,
    mut time: MatchTime,
) -> Result {
    let panel = egui::Panel::bottom("bottom bar").resizable(false).frame(panel_frame(colours::PANEL, MARGIN));
    let room = (area.0.height() - MARGIN.sum().y).max(1.0);
    area.dock(contexts.ctx_mut()?, "bottom bar", panel, |ui| {
        // As high as it needs to be, while there is room.
        let rows = egui::ScrollArea::vertical().min_scrolled_height(room).max_height(room);
        rows.show(ui, |ui| {
            if ui.available_width() >= WIDE {
                controls.show_wide(ui)
            } else {
                controls.show_folded(ui)
            }
            time.show(ui, &mut controls);
        });
    });
    Ok(())
}

/// How long a new pilot is told how to drive, s.
const FIRST_MINUTE: f32 = 60.0;
/// It is not told where there is less room than this above the least pitch, in points.
const FIRST_MINUTE_HEIGHT: f32 = 50.0;

fn show_first_minute(
    mut contexts: EguiContexts,
    mut area: ResMut<FreeArea>,
    time: Res<Time<Real>>,
    (driven, keyboard): (DrivenRobot, Res<Keyboard>),
    mut told: Local<f32>,
) -> Result {
    let Some(robot) = driven.id().filter(|_| *told < FIRST_MINUTE) else { return Ok(()) };
    *told += time.delta_secs();
    let panel = egui::Panel::bottom("first minute")
        .resizable(false)
        .frame(panel_frame(colours::RAISED, egui::Margin::symmetric(12, 5)));
    let text = first_minute(robot, driven.kicks(), &keyboard);
    if area.room(Edge::Bottom) < FIRST_MINUTE_HEIGHT {
        return Ok(());
    }
    area.dock(contexts.ctx_mut()?, "first minute", panel, |ui| {
        ui.vertical_centered(|ui| {
            ui.label(egui::RichText::new(text).color(paint(colours::PILOT)).size(15.0));
        });
    });
    Ok(())
}

/// How to drive, in one line.
fn first_minute(robot: RobotId, kicks: bool, keyboard: &Keyboard) -> String {
    let key = |drive| keyboard.key(Deed::Drive(drive));
    let legs = if kicks {
        let [left, right] = [DriveKey::StepLeft, DriveKey::StepRight].map(key);
        format!(
            ", {left} {right} to the side; {} kicks, {} holds the ball",
            key(DriveKey::KickAhead),
            key(DriveKey::Hold)
        )
    } else {
        String::new()
    };
    let act = |action| keyboard.key(Deed::Act(action));
    format!(
        "You drive {}, the one in the white ring: {}{legs}. {}: next robot. {}: hand it back. {}: all keys.",
        format::capitalised(robot),
        keyboard.driving_keys(),
        act(Action::NextRobot),
        act(Action::HandOver),
        act(Action::Help),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    #[test]
    fn a_new_driver_is_told_the_keys_of_this_keyboard() {
        let told = first_minute(RobotId::new(Team::Home, 0), true, &Keyboard::default());
        assert!(
            told.contains("W A S D or the arrow keys, Q E to the side; Space kicks, C holds the ball."),
            "{told}"
        );
        assert!(told.ends_with("Tab: next robot. H: hand it back. F1: all keys."), "{told}");
    }
}
