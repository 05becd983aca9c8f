//! What the robot is doing, since when, and how it came to that.

use bevy_egui::egui::{self, RichText};

use crate::app::inspector::subject::SelectedRobot;
use crate::app::inspector::table;
use crate::app::view::format;
use crate::strategy::TransitionTaken;

/// Transitions that are shown, newest first.
const SHOWN: usize = 5;

pub(super) fn draw(ui: &mut egui::Ui, robot: &SelectedRobot) {
    let activity = robot.of.activity;
    let machine = robot.strategy.machines.get(activity.machine(robot.strategy));
    let state = machine.zip(robot.activity()).map(|(machine, state)| machine.path(state));
    let since = format::seconds(robot.since(activity.since));
    ui.horizontal(|ui| {
        ui.label(RichText::new(state.as_deref().unwrap_or(format::UNKNOWN)).strong().size(15.0));
        ui.label(format!("for {since}"));
        if let Some(machine) = machine {
            ui.weak(format!("of the machine {}", machine.name));
        }
    });
    if activity.history.is_empty() {
        ui.weak("no transition yet");
    }
    for taken in activity.history.iter().rev().take(SHOWN) {
        let ago = format::seconds(robot.since(taken.tick));
        table::line(ui, &format!("{ago} ago"), transition_in_words(ui, taken));
    }
}

/// A transition in words. A change of sub-role that keeps the state says so by its end alone.
pub fn transition_in_words(ui: &egui::Ui, taken: &TransitionTaken) -> egui::text::LayoutJob {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let mut text = egui::text::LayoutJob::default();
    let mut say = |words: &str, colour| {
        text.append(words, 0.0, egui::TextFormat::simple(font.clone(), colour));
    };
    let (plain, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
    let sub_role = taken.because == "sub-role";
    if !(sub_role && taken.to.starts_with(&taken.from)) {
        say(&taken.from, weak);
        say(" › ", weak);
    }
    say(&taken.to, plain);
    if !sub_role {
        say(", because ", weak);
        say(&taken.because, plain);
    }
    text
}
