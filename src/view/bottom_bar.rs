//! The bar across the bottom: time, the robot in hand, the overlays, and the events of the match on a line. Each control is an
//! [`Action`], and its tooltip names its key.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};

use super::actions::Action;
use super::calls::{Events, played};
use super::colours::{self, egui as paint};
use super::layout::{FreeArea, PanelSystems};
use super::pilot_seat::Seat;
use super::state::{Overlay, Overlays, Pace, Piloted, Screen, Selected};
use super::style::panel_frame;
use super::time_line::show_time_line;
use crate::ids::RobotId;
use crate::referee::{MatchState, RuleBook};

pub(super) fn plugin(app: &mut App) {
    app.add_systems(
        EguiPrimaryContextPass,
        (show_bottom_bar, show_first_minute)
            .chain()
            .in_set(PanelSystems::Bottom)
            .run_if(in_state(Screen::Match)),
    );
}

/// The overlays as they are called on their buttons.
const OVERLAYS: [(Overlay, &str); 8] = [
    (Overlay::Vectors, "1 Vectors"),
    (Overlay::FieldOfView, "2 View"),
    (Overlay::Beliefs, "3 Beliefs"),
    (Overlay::Zones, "4 Zones"),
    (Overlay::Labels, "5 Labels"),
    (Overlay::Teamwork, "6 Teamwork"),
    (Overlay::Radio, "M Radio"),
    (Overlay::Communication, "N Comms"),
];

/// A speed as people write it.
pub fn speed_text(factor: f32) -> String {
    if factor < 1.0 { format!("1/{}×", (1.0 / factor).round()) } else { format!("{factor}×") }
}

/// A robot at the beginning of a sentence.
pub fn robot_text(robot: RobotId) -> String {
    let text = robot.to_string();
    text[..1].to_uppercase() + &text[1..]
}

fn show_bottom_bar(
    mut contexts: EguiContexts,
    mut area: ResMut<FreeArea>,
    (pace, mut overlays): (Res<Pace>, ResMut<Overlays>),
    (selected, piloted): (Res<Selected>, Res<Piloted>),
    (state, book, events): (Res<MatchState>, Res<RuleBook>, Res<Events>),
    mut actions: MessageWriter<Action>,
) -> Result {
    let panel = egui::Panel::bottom("bottom bar")
        .resizable(false)
        .frame(panel_frame(colours::PANEL, egui::Margin { left: 12, right: 12, top: 7, bottom: 6 }));
    area.dock(contexts.ctx_mut()?, "bottom bar", panel, |ui| {
        ui.horizontal(|ui| {
            let mut button = |ui: &mut egui::Ui, text: &str, width: f32, action: Action| {
                let button = egui::Button::new(text).min_size(egui::vec2(width, 26.0));
                if ui.add(button).on_hover_text(action.tooltip()).clicked() {
                    actions.write(action);
                }
            };
            button(ui, if pace.paused { "▶ Play" } else { "⏸ Pause" }, 76.0, Action::PlayOrPause);
            button(ui, "Tick", 44.0, Action::OneTick);
            button(ui, "−", 28.0, Action::Slower);
            let speed = egui::Label::new(egui::RichText::new(speed_text(pace.factor())).strong());
            ui.add_sized([40.0, 26.0], speed).on_hover_text("Times real time (+ and -)");
            button(ui, "+", 28.0, Action::Faster);
            button(ui, "Restart", 64.0, Action::Restart);
            ui.separator();
            match (piloted.0, selected.0) {
                (Some(seat), _) => {
                    button(ui, &format!("Hand {seat} back"), 140.0, Action::HandOver);
                }
                (None, Some(robot)) => {
                    button(ui, &format!("Drive {robot}"), 140.0, Action::HandOver);
                }
                (None, None) => button(ui, "Select a robot", 140.0, Action::NextRobot),
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                button(ui, "Menu", 52.0, Action::Leave);
                button(ui, "? Keys", 60.0, Action::Help);
                ui.separator();
                for (overlay, name) in OVERLAYS.into_iter().rev() {
                    let on = *overlays.bypass_change_detection().switch(overlay);
                    let tooltip = Action::Switch(overlay).tooltip();
                    if ui.selectable_label(on, name).on_hover_text(tooltip).clicked() {
                        overlays.toggle(overlay);
                    }
                }
            });
        });
        show_time_line(ui, &events.0, played(&state, &book), &book);
    });
    Ok(())
}

/// How long a new pilot is told how to drive, s.
const FIRST_MINUTE: f32 = 60.0;

fn show_first_minute(
    mut contexts: EguiContexts,
    mut area: ResMut<FreeArea>,
    time: Res<Time<Real>>,
    seat: Seat,
    mut told: Local<f32>,
) -> Result {
    let Some(robot) = seat.id().filter(|_| *told < FIRST_MINUTE) else { return Ok(()) };
    *told += time.delta_secs();
    let panel = egui::Panel::bottom("first minute")
        .resizable(false)
        .frame(panel_frame(colours::RAISED, egui::Margin::symmetric(12, 5)));
    area.dock(contexts.ctx_mut()?, "first minute", panel, |ui| {
        ui.vertical_centered(|ui| {
            let legs = if seat.kicks() { ", Q E to the side; Space kicks, C holds the ball" } else { "" };
            let text = format!(
                "You drive {}, the one in the white ring: W A S D or the arrow keys{legs}. Tab: next robot. H: hand it back. F1: all keys.",
                robot_text(robot)
            );
            ui.label(egui::RichText::new(text).color(paint(colours::PILOT)).size(15.0));
        });
    });
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    #[test]
    fn speeds_read_as_people_write_them() {
        let all: Vec<String> = Pace::SPEEDS.into_iter().map(speed_text).collect();
        assert_eq!(all, ["1/8×", "1/4×", "1/2×", "1×", "2×", "4×", "8×", "16×", "32×", "64×"]);
    }

    #[test]
    fn a_sentence_begins_with_a_capital() {
        assert_eq!(robot_text(RobotId::new(Team::Home, 3)), "Home 3");
    }
}
