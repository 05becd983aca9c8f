//! The page of the radio's panel with a row for each robot: how much it said, how much arrived, and buttons for failures.

use bevy_egui::egui::{self, RichText};

use super::data::RadioData;
use crate::app::inspector::pending::Pending;
use crate::app::view::colours;
use crate::comms::radio::{LinkCounters, Loss};
use crate::game::requests::{RadioChange, Request, Requests, RobotChange};
use crate::ids::RobotId;
use crate::robot::{Health, Restart, RobotFailure};

/// Width of a column of figures, in points.
const COLUMN: f32 = 58.0;

/// The figures' names, with what they count.
const FIGURES: [(&str, &str); 6] = [
    ("sent", "Messages that it sent, one for each receiver"),
    ("arrived", "Of these, with second copies, those that arrived"),
    ("lost", "Of these, those that were lost"),
    ("late", "Of these, those that took longer than the radio's ordinary delay"),
    ("kB", "Kilobytes that it sent"),
    ("heard", "Messages that it heard"),
];

pub fn show(ui: &mut egui::Ui, robots: &[(RobotId, Health)], heard: &RadioData, requests: &mut Requests) {
    egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        egui::Grid::new("robots on the radio").num_columns(4).spacing([12.0, 5.0]).show(ui, |ui| {
            ui.weak("robot");
            ui.horizontal(|ui| {
                for (name, counts) in FIGURES {
                    figure(ui, RichText::new(name).weak()).on_hover_text(counts);
                }
            });
            ui.weak("befalls it");
            ui.weak("and ends");
            ui.end_row();
            for (robot, health) in robots {
                show_robot(ui, *robot, *health, heard, requests);
                ui.end_row();
            }
        });
    });
}

fn show_robot(ui: &mut egui::Ui, robot: RobotId, health: Health, heard: &RadioData, requests: &mut Requests) {
    let name = RichText::new(robot.to_string()).color(colours::egui(colours::team_text(robot.team)));
    ui.label(name);
    let sent = heard.radio.sent_by(robot);
    ui.horizontal(|ui| {
        figure(ui, sent.sent.to_string().into());
        figure(ui, sent.delivered.to_string().into());
        figure(ui, sent.lost_in_all().to_string().into()).on_hover_text(reasons(&sent));
        figure(ui, sent.late.to_string().into());
        figure(ui, format!("{:.1}", sent.bytes as f64 / 1000.0).into());
        figure(ui, heard.radio.sent_to(robot).delivered.to_string().into());
    });
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        show_failures(ui, robot, health, requests);
        show_cut_off(ui, robot, heard.interference.cut_off.contains(&robot), requests);
    });
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let asked = requests.iter().any(
            |request| matches!(request, Request::Robot(of, RobotChange::Revive(_)) if *of == robot),
        );
        for (restart, name, tip) in [
            (
                Restart::Kept,
                "Revive",
                "All is well again. If it had crashed, it is switched on and still knows its role and its counters",
            ),
            (Restart::Lost, "Revive as new", "All is well again. If it had crashed, it has forgotten everything"),
        ] {
            let button = ui.add_enabled(!health.is_well() && !asked, egui::Button::new(name));
            if button.on_hover_text(tip).clicked() {
                requests.ask(Request::Robot(robot, RobotChange::Revive(restart)));
            }
        }
    });
}

fn show_failures(ui: &mut egui::Ui, robot: RobotId, health: Health, requests: &mut Requests) {
    for (failure, name, tip) in [
        (RobotFailure::Crashed, "Crash", "Switches its computer off: it stands still, silent and deaf"),
        (RobotFailure::Frozen, "Freeze", "Switches its wheels off; it goes on thinking and talking"),
        (RobotFailure::Deaf, "Deaf", "It hears nothing any more"),
        (RobotFailure::Mute, "Mute", "Nothing that it says goes on air any more"),
    ] {
        let has = health.with(failure) == health;
        let asked = requests.iter().any(|request| {
            matches!(request, Request::Robot(of, RobotChange::Fail(one)) if *of == robot && *one == failure)
        });
        let button = ui.add(egui::Button::new(name).selected(has || asked));
        let tip = if has { format!("{tip}. It is so: revive it to end that") } else { tip.to_owned() };
        if button.on_hover_text(tip).clicked() && !has && !asked {
            requests.ask(Request::Robot(robot, RobotChange::Fail(failure)));
        }
    }
}

fn show_cut_off(ui: &mut egui::Ui, robot: RobotId, in_force: bool, requests: &mut Requests) {
    let cut_off = Pending::new(in_force, requests, |request| match request {
        Request::Radio(RadioChange::CutOff(of)) if *of == robot => Some(true),
        Request::Radio(RadioChange::Reconnect(of)) if *of == robot => Some(false),
        _ => None,
    })
    .shown();
    let (words, weather) = if cut_off {
        ("Reconnect", RadioChange::Reconnect(robot))
    } else {
        ("Cut off", RadioChange::CutOff(robot))
    };
    let tip = "A robot that is cut off hears nobody and is heard by nobody";
    if ui.add(egui::Button::new(words).selected(cut_off)).on_hover_text(tip).clicked() {
        requests.ask(Request::Radio(weather));
    }
}

/// A figure in a column, aligned to the right.
fn figure(ui: &mut egui::Ui, text: RichText) -> egui::Response {
    let size = egui::vec2(COLUMN, ui.spacing().interact_size.y);
    let layout = egui::Layout::right_to_left(egui::Align::Center);
    ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_width(COLUMN);
        ui.label(text)
    })
    .inner
}

/// What was lost for which reason.
fn reasons(counters: &LinkCounters) -> String {
    let lost: Vec<String> = Loss::ALL
        .into_iter()
        .filter(|loss| counters.lost_to(*loss) > 0)
        .map(|loss| format!("{loss}: {}", counters.lost_to(loss)))
        .collect();
    if lost.is_empty() { "Nothing was lost".into() } else { lost.join("\n") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn losses_are_told_by_reason() {
        let mut counters = LinkCounters::default();
        assert_eq!(reasons(&counters), "Nothing was lost");
        counters.lost[Loss::Jammed.index()] = 3;
        counters.lost[Loss::Deaf.index()] = 1;
        assert_eq!(reasons(&counters), "jammed: 3\ndeaf: 1");
    }
}
