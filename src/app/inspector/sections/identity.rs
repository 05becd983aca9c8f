//! Who the robot is: its number in its team's colour, its role, what it is built as, and who drives it.

use bevy_egui::egui::{self, RichText};

use super::{Desk, close_button};
use crate::app::inspector::subject::Looked;
use crate::app::inspector::{figures, table, tints};
use crate::app::view::actions::Action;
use crate::app::view::labels::off_text;
use crate::game::requests::Request;
use crate::ids::RobotId;

pub(super) fn draw(ui: &mut egui::Ui, robot: &Looked, desk: &mut Desk) {
    let strategy = robot.strategy;
    let role_name = |index: usize| strategy.roles.get(index).map_or(figures::UNKNOWN, |role| &role.name);
    ui.horizontal(|ui| {
        shirt(ui, robot.id);
        ui.label(RichText::new(role_name(robot.of.role.0)).size(18.0));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            close_button(ui, desk);
            hand_over(ui, robot.id, robot.of.piloted, desk);
        });
    });
    if robot.of.activity.acting_as != robot.of.role.0 {
        table::line(ui, "acts as", role_name(robot.of.activity.acting_as));
    }
    let kind = &robot.of.robot.kind;
    let driver = if robot.of.piloted { "you" } else { strategy.name.as_str() };
    table::line(ui, "robot", format!("{}, driven by {driver}", kind.name)).on_hover_text(format!(
        "{} at most. {}: {}",
        figures::speed(kind.max_speed()),
        strategy.name,
        strategy.description
    ));
    if robot.of.off_pitch {
        table::line(ui, "penalty", RichText::new(off_text(robot.state, robot.id)).strong());
    }
}

/// The robot's number on its team's colour.
fn shirt(ui: &mut egui::Ui, id: RobotId) {
    let size = egui::vec2(26.0, 26.0);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    ui.painter().rect_filled(rect, 5.0, tints::egui(tints::team(id.team)));
    let font = egui::FontId::proportional(17.0);
    let ink = egui::Color32::from_gray(16);
    ui.painter().text(rect.center(), egui::Align2::CENTER_CENTER, id.number, font, ink);
    response.on_hover_text(id.to_string());
}

pub(super) fn hand_over(ui: &mut egui::Ui, id: RobotId, piloted: bool, desk: &mut Desk) {
    let (words, tip) = if piloted {
        ("Hand back", "Let the strategy drive it again".to_owned())
    } else {
        ("Take over", format!("Drive this robot yourself, with {}", desk.keyboard.driving_keys()))
    };
    let tip = desk.keyboard.tip_that_says(&tip, Action::HandOver);
    if !ui.button(words).on_hover_text(tip).clicked() {
        return;
    }
    if piloted {
        desk.requests.ask(Request::HandBack(id));
        desk.piloted.0 = desk.piloted.0.filter(|other| *other != id);
        return;
    }
    if let Some(other) = desk.piloted.0.replace(id).filter(|other| *other != id) {
        desk.requests.ask(Request::HandBack(other));
    }
    desk.requests.ask(Request::TakeOver(id));
    // A person who takes a robot over in the inspector wants to go on seeing it.
    desk.playing.inspector = true;
}
