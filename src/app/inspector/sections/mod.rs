//! The parts of the inspector's panel, one file each. Each draws what it is given and may ask for changes.

mod activity;
mod beliefs;
mod calibration;
mod identity;
mod joystick;
mod motor;
mod percepts;
mod teleoperation;

use bevy_egui::egui;

use super::subject::SelectedRobot;
use crate::app::view::input::keyboard::Keyboard;
use crate::app::view::input::manual_control::ManualControl;
use crate::app::view::state::{Action, OpenPanels, Piloted};
use crate::game::TeamPlan;
use crate::game::requests::Requests;

/// What the panel may ask for, and what it shows of that.
pub struct PanelActions<'a> {
    pub requests: &'a mut Requests,
    pub piloted: &'a mut Piloted,
    pub levers: &'a mut ManualControl,
    /// What the files say of the robot's values.
    pub file: Option<&'a TeamPlan>,
    /// Whether the panel is open.
    pub open: &'a mut bool,
    /// What is open while a person drives.
    pub playing: &'a mut OpenPanels,
    pub keyboard: &'a Keyboard,
}

/// Draws who the robot is, which stays in sight.
pub fn draw_head(ui: &mut egui::Ui, robot: &SelectedRobot, desk: &mut PanelActions) {
    identity::draw(ui, robot, desk);
}

/// Draws what is inside a robot, from top to bottom.
pub fn draw(ui: &mut egui::Ui, robot: &SelectedRobot, desk: &mut PanelActions) {
    section(ui, "Teleoperation", false, |ui| teleoperation::draw(ui, robot, desk));
    section(ui, "Activity", true, |ui| activity::draw(ui, robot));
    section(ui, "Motor", true, |ui| motor::draw(ui, robot, desk));
    section(ui, "Beliefs beside the truth", true, |ui| beliefs::draw(ui, robot));
    section(ui, "Percepts", true, |ui| percepts::draw(ui, robot));
    section(ui, "Calibration", false, |ui| calibration::draw(ui, robot, desk));
}

/// The button that closes the panel.
pub fn close_button(ui: &mut egui::Ui, desk: &mut PanelActions) {
    let close = ui.add(egui::Button::new("⏵").frame(false));
    let tip = desk.keyboard.tip_that_says("Close the inspector", Action::Inspector);
    if close.on_hover_text(tip).clicked() {
        *desk.open = false;
    }
}

fn section(ui: &mut egui::Ui, title: &str, open: bool, contents: impl FnOnce(&mut egui::Ui)) {
    ui.add_space(3.0);
    egui::CollapsingHeader::new(egui::RichText::new(title).strong())
        .id_salt(title)
        .default_open(open)
        .show_unindented(ui, contents);
}
