//! The robot's noise, limits and senses, each with a slider and the way back to the file's value. Of this robot alone.

use bevy_egui::egui::{self, RichText};

use super::panel_actions::PanelActions;
use crate::app::inspector::calibration::{KNOBS, Knob, RobotValues};
use crate::app::inspector::pending::Pending;
use crate::app::inspector::subject::SelectedRobot;
use crate::app::inspector::tuner::{RESET, ROW, Tuner};
use crate::game::requests::{Request, RobotChange};

/// Widths of a slider and of a number, in points.
const WIDTHS: (f32, f32) = (118.0, 88.0);

pub(super) fn draw(ui: &mut egui::Ui, robot: &SelectedRobot, actions: &mut PanelActions) {
    let in_force = RobotValues::of(&robot.of.robot.kind, &robot.of.robot.sensing);
    let pending = Pending::new(in_force, actions.requests, |request| match request {
        Request::Robot(id, RobotChange::Recalibrate(asked)) if *id == robot.id => {
            Some(RobotValues::of(&asked.kind, &asked.sensing))
        }
        _ => None,
    });
    let mut values = pending.shown();
    let file = actions
        .file(robot.id.team)
        .map(|team| RobotValues::of(&team.kind, &team.senses(robot.id.number).sensing));
    let mut file = file.unwrap_or_else(|| values.clone());
    let before = values.clone();
    ui.horizontal(|ui| {
        ui.weak("Of this robot alone, from the next tick on");
        let differs = KNOBS.iter().any(|knob| {
            let pair = (knob.at)(&mut values).zip((knob.at)(&mut file));
            pair.is_some_and(|(value, filed)| tuner(knob).differs(*value, *filed))
        });
        let reset = ui.add_enabled(differs, egui::Button::new("Reset all"));
        if reset.on_hover_text("Puts every value back to that of its file").clicked() {
            reset_all(&mut values, &mut file);
        }
    });
    let mut group = "";
    for knob in KNOBS {
        let Some((value, filed)) = (knob.at)(&mut values).zip((knob.at)(&mut file)) else { continue };
        if std::mem::replace(&mut group, knob.group) != knob.group {
            ui.label(RichText::new(knob.group).weak());
        }
        show(ui, knob, value, *filed);
    }
    if values != before {
        let change = RobotChange::Recalibrate(values.calibration());
        actions.requests.ask(Request::Robot(robot.id, change));
    }
}

fn tuner(knob: &Knob) -> Tuner<'static> {
    let Knob { range, decimals, unit, tip, .. } = *knob;
    Tuner { range, step: 0.0, decimals, unit, tip, widths: WIDTHS }
}

fn reset_all(values: &mut RobotValues, file: &mut RobotValues) {
    for knob in KNOBS {
        if let Some((value, filed)) = (knob.at)(values).zip((knob.at)(file)) {
            *value = *filed;
        }
    }
}

fn show(ui: &mut egui::Ui, knob: &Knob, value: &mut f32, filed: f32) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let room = (ui.available_width() - WIDTHS.0 - WIDTHS.1 - RESET - 3.0 * 4.0).max(60.0);
        let (name, _) = ui.allocate_exact_size(egui::vec2(room, ROW), egui::Sense::hover());
        let colour = ui.visuals().text_color();
        let font = egui::TextStyle::Body.resolve(ui.style());
        let at = name.left_center() + egui::vec2(8.0, 0.0);
        ui.painter().text(at, egui::Align2::LEFT_CENTER, knob.name, font, colour);
        tuner(knob).show(ui, value, filed);
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::AssetFolder;
    use crate::game::{Choice, MatchPlan};
    use crate::ids::Team;

    #[test]
    fn a_changed_value_goes_back_to_that_of_the_file() {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let plan = MatchPlan::read(&assets, &Choice::default()).expect("the default match");
        let team = plan.team(Team::Home);
        let mut file = RobotValues::of(&team.kind, &team.senses.sensing);
        let mut values = file.clone();
        let knob = KNOBS.iter().find(|knob| knob.name == "top speed").expect("wheels have one");
        if let Some(value) = (knob.at)(&mut values) {
            *value = 0.2;
        }
        assert_ne!(values, file);
        reset_all(&mut values, &mut file);
        assert_eq!(values, file);
    }
}
