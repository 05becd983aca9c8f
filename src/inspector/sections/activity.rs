//! What the robot is doing, since when, and how it came to that.

use bevy_egui::egui::{self, RichText};

use crate::inspector::subject::Looked;
use crate::inspector::{figures, table};

pub(super) fn draw(ui: &mut egui::Ui, robot: &Looked) {
    let activity = robot.of.activity;
    let machine = robot.strategy.machines.get(activity.machine(robot.strategy));
    let state = robot.activity().map_or(figures::UNKNOWN, |state| &state.name);
    let since = figures::seconds(robot.since(activity.since));
    ui.horizontal(|ui| {
        ui.label(RichText::new(state).strong().size(16.0));
        ui.label(format!("for {since}"));
        if let Some(machine) = machine {
            ui.weak(format!("of the machine {}", machine.name));
        }
    });
    if activity.history.is_empty() {
        ui.weak("no transition yet");
    }
    for taken in activity.history.iter().rev() {
        let ago = figures::seconds(robot.since(taken.tick));
        let mut text = egui::text::LayoutJob::default();
        let font = egui::TextStyle::Body.resolve(ui.style());
        let mut say = |words: &str, colour| {
            text.append(words, 0.0, egui::TextFormat::simple(font.clone(), colour));
        };
        let (plain, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
        say(&taken.from, weak);
        say(" → ", weak);
        say(&taken.to, plain);
        say("  because ", weak);
        say(&taken.because, plain);
        table::line(ui, &format!("{ago} ago"), text);
    }
}
