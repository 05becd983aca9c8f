//! Who the robot is: its number in its team's colour, its role, what it is built as, and who drives it.

use bevy_egui::egui::{self, RichText};

use super::movement::Movement;
use super::panel_actions::{PanelActions, close_button};
use crate::app::inspector::subject::SelectedRobot;
use crate::app::inspector::table;
use crate::app::view::picture::labels::off_text;
use crate::app::view::picture::status_icons::StatusIcon;
use crate::app::view::state::Action;
use crate::app::view::{colours, format};
use crate::ids::RobotId;
use crate::protocol::role_swap::Lock;

pub(super) fn draw(ui: &mut egui::Ui, robot: &SelectedRobot, actions: &mut PanelActions) {
    let strategy = robot.strategy;
    let role_name = |index: usize| strategy.roles.get(index).map_or(format::UNKNOWN, |role| &role.name);
    ui.horizontal(|ui| {
        shirt(ui, robot.id);
        ui.label(RichText::new(role_name(robot.of.role.0)).size(18.0));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            close_button(ui, actions);
            hand_over(ui, robot.id, actions);
        });
    });
    if robot.of.activity.acting_as != robot.of.role.0 {
        table::line(ui, "acts as", role_name(robot.of.activity.acting_as));
    }
    let kind = &robot.of.robot.kind;
    let driver = if robot.of.piloted { "you" } else { strategy.name.as_str() };
    table::line(ui, "robot", format!("{}, driven by {driver}", kind.name)).on_hover_text(format!(
        "{} at most. {}: {}",
        format::speed(kind.max_speed()),
        strategy.name,
        strategy.description
    ));
    if robot.of.off_pitch {
        table::line(ui, "penalty", RichText::new(off_text(robot.state, robot.id)).strong());
    }
    table::line(ui, "moves", Movement::of(robot).in_words())
        .on_hover_text("How fast it is, or what keeps it where it is");
    let lock = robot.of.swapping.map(|swapping| swapping.machine.lock());
    let signs = StatusIcon::of(robot.of.robot.health, false, robot.cut_off, false);
    let signs: Vec<&str> = signs.into_iter().map(StatusIcon::words).collect();
    let health =
        if signs.is_empty() { RichText::new("well") } else { RichText::new(signs.join(", ")).strong() };
    table::line(ui, "health", health);
    if let Some(lock) = lock {
        table::line(ui, "lock", lock_in_words(lock, robot.id)).on_hover_text(
            "Who gives its lock to a team mate takes part in that one's attempt to swap roles, and in no other",
        );
    }
}

fn lock_in_words(lock: Option<Lock>, robot: RobotId) -> RichText {
    match lock {
        Some(Lock { by, sequence }) => {
            let words = format!("held by {} {by}, for swap {sequence}", robot.team);
            RichText::new(words).color(colours::egui(colours::LOCK))
        }
        None => RichText::new("free"),
    }
}

/// The robot's number on its team's colour.
fn shirt(ui: &mut egui::Ui, id: RobotId) {
    let size = egui::vec2(26.0, 26.0);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    ui.painter().rect_filled(rect, 5.0, colours::egui(colours::team(id.team)));
    let font = egui::FontId::proportional(17.0);
    let ink = egui::Color32::from_gray(16);
    ui.painter().text(rect.center(), egui::Align2::CENTER_CENTER, id.number, font, ink);
    response.on_hover_text(id.to_string());
}

pub(super) fn hand_over(ui: &mut egui::Ui, id: RobotId, actions: &mut PanelActions) {
    let piloted = actions.piloted.0 == Some(id);
    let (words, tip) = if piloted {
        ("Hand back", "Let the strategy drive it again".to_owned())
    } else {
        ("Take over", format!("Drive this robot yourself, with {}", actions.keyboard.driving_keys()))
    };
    let tip = actions.keyboard.tip_that_says(&tip, Action::HandOver);
    if !ui.button(words).on_hover_text(tip).clicked() {
        return;
    }
    if piloted {
        actions.piloted.change(None, actions.requests);
        return;
    }
    actions.piloted.change(Some(id), actions.requests);
    // A person who takes a robot over in the inspector wants to go on seeing it.
    actions.playing.inspector = true;
}
