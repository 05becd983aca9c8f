//! Beside the chart: the ways out of the state that is looked at, in the order in which they are asked, and how the robot came to
//! its state.

use bevy_egui::egui::{self, RichText};

use super::canvas::ChartScene;
use super::heat::times;
use super::trail::age;
use crate::app::inspector::breakpoints::{Breakpoints, StopAt};
use crate::app::inspector::sections::transition_in_words;
use crate::app::inspector::subject::SelectedRobot;
use crate::app::inspector::table;
use crate::app::view::colours::{self, egui as paint};
use crate::app::view::format;
use crate::ids::RobotId;

/// Transitions that are shown, newest first.
const SHOWN: usize = 6;
/// How much weaker each is than the one after it, and the weakest.
const FADING: f32 = 0.12;

/// What a person clicks here: the state that they want to look at.
pub fn show(
    ui: &mut egui::Ui,
    robot: &SelectedRobot,
    scene: &ChartScene,
    breakpoints: &mut Breakpoints,
) -> Option<usize> {
    let mut clicked = None;
    egui::ScrollArea::vertical().id_salt("ways").auto_shrink(false).show(ui, |ui| {
        let name = |at: usize| scene.graph.boxes[at].name.as_str();
        ui.label(RichText::new(format!("Ways out of {}", name(scene.looked))).strong());
        for at in scene.graph.with_surroundings(scene.looked).collect::<Vec<_>>().into_iter().rev() {
            for (way, to) in scene.graph.ways_out(at) {
                ui.horizontal(|ui| {
                    let stop = StopAt::Transition {
                        machine: scene.graph.name.clone(),
                        from: name(at).to_owned(),
                        go: name(to).to_owned(),
                        when: Some(way.when.clone()),
                    };
                    show_dot(ui, robot.id, stop, breakpoints);
                    let place = if at == scene.looked {
                        way.place().to_string()
                    } else {
                        format!("{} {}", name(at), way.place())
                    };
                    ui.label(RichText::new(place).weak());
                    ui.label("›");
                    let link = ui.link(name(to)).on_hover_text("Look at this state");
                    if link.clicked() {
                        clicked = Some(to);
                    }
                    let counted =
                        scene.heat.as_ref().and_then(|heat| heat.boxes.get(at)?.ways.get(way.id.number));
                    if let Some(taken) = counted {
                        ui.label(RichText::new(times(*taken)).color(paint(colours::CALL)));
                    }
                    ui.add(egui::Label::new(RichText::new(&way.when).weak()).truncate())
                        .on_hover_text(&way.when);
                });
            }
        }
        ui.add_space(6.0);
        ui.label(RichText::new(format!("How {} came here", robot.id)).strong());
        show_history(ui, robot);
    });
    clicked
}

/// A dot that a click makes a breakpoint of this robot, or takes it away.
fn show_dot(ui: &mut egui::Ui, robot: RobotId, at: StopAt, breakpoints: &mut Breakpoints) {
    let mark = breakpoints.mark(robot, |known| *known == at);
    let (rect, response) = ui.allocate_exact_size(egui::vec2(12.0, 14.0), egui::Sense::click());
    let colour = match mark {
        Some(_) => colours::BREAKPOINT,
        None => colours::RAISED,
    };
    match mark {
        Some(false) => ui.painter().circle_stroke(rect.center(), 4.0, (1.3, paint(colour))),
        _ => ui.painter().circle_filled(rect.center(), 4.5, paint(colour)),
    };
    let response = response.on_hover_text(if mark.is_some() {
        "Remove the breakpoint".to_owned()
    } else {
        format!("Stop when {robot} {at}")
    });
    if response.clicked() {
        match mark {
            Some(_) => breakpoints.remove(robot, &at),
            None => breakpoints.set(Some(robot), at),
        }
    }
}

fn show_history(ui: &mut egui::Ui, robot: &SelectedRobot) {
    let history = &robot.of.activity.history;
    if history.is_empty() {
        ui.weak("no transition yet");
    }
    for (number, taken) in history.iter().rev().take(SHOWN).enumerate() {
        ui.scope(|ui| {
            let faded = 1.0 - FADING * number as f32;
            ui.visuals_mut().override_text_color = Some(paint(colours::TEXT).gamma_multiply(faded));
            let ago = format::seconds(age(taken, &robot.clock));
            table::line(ui, &format!("{ago} ago"), transition_in_words(ui, taken));
        });
    }
}
