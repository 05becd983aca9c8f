//! The robot's noise, limits and senses, each with a slider and the way back to the file's value. Of this robot alone.

use bevy_egui::egui::{self, RichText};

use super::PanelActions;
use crate::app::inspector::calibration::{KNOBS, Knob, RobotValues};
use crate::app::inspector::subject::SelectedRobot;
use crate::app::view::colours;
use crate::game::requests::{Calibration, Request, Treatment};

/// Widths of what stands to the right of a value's name, in points.
const SLIDER: f32 = 118.0;
const VALUE: f32 = 88.0;
const RESET: f32 = 20.0;
const ROW: f32 = 19.0;

pub(super) fn draw(ui: &mut egui::Ui, robot: &SelectedRobot, desk: &mut PanelActions) {
    let (kind, sensing) = (&robot.of.robot.kind, &robot.of.robot.sensing);
    let mut values = match asked(desk, robot) {
        Some(asked) => RobotValues::of(&asked.kind, &asked.sensing),
        None => RobotValues::of(kind, sensing),
    };
    let file = desk.file.map(|team| RobotValues::of(&team.kind, &team.sensing));
    let mut file = file.unwrap_or_else(|| values.clone());
    let before = values.clone();
    ui.horizontal(|ui| {
        ui.weak("Of this robot alone, from the next tick on");
        let differs = KNOBS.iter().any(|knob| is_changed(knob, &mut values, &mut file));
        let reset = ui.add_enabled(differs, egui::Button::new("Reset all"));
        if reset.on_hover_text("Puts every value back to that of its file").clicked() {
            for knob in &KNOBS {
                set(knob, &mut values, &mut file);
            }
        }
    });
    let mut group = "";
    for knob in &KNOBS {
        if (knob.at)(&mut values).is_none() {
            continue;
        }
        if std::mem::replace(&mut group, knob.group) != knob.group {
            ui.label(RichText::new(knob.group).weak());
        }
        show(ui, knob, &mut values, &mut file);
    }
    if values != before {
        let treatment = Treatment::Recalibrate(values.calibration());
        desk.requests.ask(Request::Robot(robot.id, treatment));
    }
}

/// What was asked for this robot and waits for the next tick.
fn asked<'a>(desk: &'a PanelActions, robot: &SelectedRobot) -> Option<&'a Calibration> {
    let waiting = desk.requests.iter().filter_map(|request| match request {
        Request::Robot(id, Treatment::Recalibrate(calibration)) if *id == robot.id => Some(calibration),
        _ => None,
    });
    waiting.last()
}

/// RobotValues nearer than this share of a slider are the same.
const SAME: f32 = 1e-4;

fn is_changed(knob: &Knob, values: &mut RobotValues, file: &mut RobotValues) -> bool {
    let pair = (knob.at)(values).zip((knob.at)(file));
    pair.is_some_and(|(value, filed)| (*value - *filed).abs() > SAME * (knob.range.1 - knob.range.0))
}

/// Puts a value back to that of the file.
fn set(knob: &Knob, values: &mut RobotValues, file: &mut RobotValues) {
    if let Some((value, filed)) = (knob.at)(values).zip((knob.at)(file)) {
        *value = *filed;
    }
}

fn show(ui: &mut egui::Ui, knob: &Knob, values: &mut RobotValues, file: &mut RobotValues) {
    let differs = is_changed(knob, values, file);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let room = (ui.available_width() - SLIDER - VALUE - RESET - 3.0 * 4.0).max(60.0);
        let (name, _) = ui.allocate_exact_size(egui::vec2(room, ROW), egui::Sense::hover());
        let colour = ui.visuals().text_color();
        let font = egui::TextStyle::Body.resolve(ui.style());
        let at = name.left_center() + egui::vec2(8.0, 0.0);
        ui.painter().text(at, egui::Align2::LEFT_CENTER, knob.name, font, colour);
        let (least, most) = knob.range;
        let Some(value) = (knob.at)(values) else { return };
        ui.spacing_mut().slider_width = SLIDER;
        let slider =
            egui::Slider::new(value, least..=most).show_value(false).clamping(egui::SliderClamping::Edits);
        let slider = ui.add(slider);
        if slider.drag_stopped() {
            // Otherwise it would keep the keyboard to itself.
            slider.surrender_focus();
        }
        if !slider.dragged() {
            slider.on_hover_text(knob.tip);
        }
        let unit = match knob.unit {
            "" => String::new(),
            degrees if degrees.starts_with('°') => degrees.into(),
            unit => format!(" {unit}"),
        };
        let number = egui::DragValue::new(value)
            .range(least..=most)
            .speed((most - least) / 400.0)
            .fixed_decimals(knob.decimals)
            .suffix(unit)
            .clamp_existing_to_range(false)
            .update_while_editing(false);
        ui.scope(|ui| {
            if differs {
                ui.visuals_mut().override_text_color = Some(colours::egui(colours::CHANGED));
            }
            ui.add_sized([VALUE, ROW], number).on_hover_text("Drag, or click to type");
        });
        if differs {
            let filed = (knob.at)(file).map_or(0.0, |filed| *filed);
            let tip = format!("Reset to the file's {filed:.*}", knob.decimals);
            let reset = egui::Button::new("⟲").frame(false);
            if ui.add_sized([RESET, ROW], reset).on_hover_text(tip).clicked() {
                set(knob, values, file);
            }
        }
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
        let mut file = RobotValues::of(&team.kind, &team.sensing);
        let mut values = file.clone();
        let knob = KNOBS.iter().find(|knob| knob.name == "top speed").expect("wheels have one");
        if let Some(value) = (knob.at)(&mut values) {
            *value = 0.2;
        }
        assert!(is_changed(knob, &mut values, &mut file));
        set(knob, &mut values, &mut file);
        assert_eq!(values, file);
    }
}
