//! The parts of the inspector's panel, one file each. Each draws what it is given and may ask for changes.

mod activity;
mod beliefs;
mod calibration;
mod identity;
mod joystick;
mod motor;
mod movement;
mod panel_actions;
mod percepts;
mod teleoperation;

pub use activity::transition_in_words;
use bevy_egui::egui;
pub use panel_actions::PanelActions;
pub use teleoperation::TeleoperatedBody;

use super::numbers::{self, RunningTexts};
use super::subject::SelectedRobot;

/// Draws who the robot is, which stays in sight.
pub fn draw_head(ui: &mut egui::Ui, robot: &SelectedRobot, actions: &mut PanelActions) {
    identity::draw(ui, robot, actions);
}

/// Draws what is inside a robot, from top to bottom.
pub fn draw(ui: &mut egui::Ui, robot: &SelectedRobot, actions: &mut PanelActions) {
    section(ui, "Teleoperation", false, |ui| teleoperation::draw(ui, robot, actions));
    section(ui, "Activity", true, |ui| activity::draw(ui, robot));
    section(ui, "Motor", true, |ui| motor::draw(ui, robot, actions));
    section(ui, "Beliefs beside the truth", true, |ui| beliefs::draw(ui, robot));
    section(ui, "Percepts", true, |ui| percepts::draw(ui, robot));
    section(ui, "Every number of the strategy", false, |ui| draw_numbers(ui, robot, actions));
    section(ui, "Calibration", false, |ui| calibration::draw(ui, robot, actions));
}

fn draw_numbers(ui: &mut egui::Ui, robot: &SelectedRobot, actions: &mut PanelActions) {
    let team = robot.id.team;
    let Some(plan) = actions.plan else { return };
    let texts = RunningTexts { team, running: &actions.sources.0[team.index()], plan };
    numbers::draw(ui, texts, actions.numbers, actions.requests);
}

fn section(ui: &mut egui::Ui, title: &str, open: bool, contents: impl FnOnce(&mut egui::Ui)) {
    ui.add_space(3.0);
    egui::CollapsingHeader::new(egui::RichText::new(title).strong())
        .id_salt(title)
        .default_open(open)
        .show_unindented(ui, contents);
}
