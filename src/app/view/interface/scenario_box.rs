//! The box at the left while a scenario is played: what it shows, how far it has come, and how its expectations stand.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};
use egui::{Color32, RichText, vec2};

use crate::app::view::colours::{self, egui as paint};
use crate::app::view::state::{FreeArea, PanelSystems, Screen, Session};
use crate::app::view::style::{SMALL, panel_frame};
use crate::app::view::time::expectations::{ExpectationStatus, Expectations};
use crate::clock::Clock;

pub(super) fn plugin(app: &mut App) {
    app.add_systems(
        EguiPrimaryContextPass,
        show_box.in_set(PanelSystems::Left).run_if(in_state(Screen::Match)),
    );
}

/// Width of the box in points.
const WIDTH: f32 = 250.0;
/// It is left out where it would be narrower than this, in points.
const LEAST: f32 = 100.0;
/// Of the sign before an expectation, in points.
const SIGN: f32 = 16.0;

fn show_box(
    mut contexts: EguiContexts,
    mut area: ResMut<FreeArea>,
    (session, expectations, clock): (Res<Session>, Res<Expectations>, Res<Clock>),
) -> Result {
    let Some(plan) = &session.scenario else { return Ok(()) };
    let scenario = &plan.scenario;
    let width = WIDTH.min(area.0.width() / 3.0);
    if width < LEAST {
        return Ok(());
    }
    let panel = egui::Panel::left("scenario")
        .resizable(false)
        .exact_size(width)
        .frame(panel_frame(colours::PANEL, egui::Margin::same(10)));
    area.dock(contexts.ctx_mut()?, "scenario", panel, |ui| {
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let name = RichText::new(&scenario.name).size(15.0).color(paint(colours::PILOT));
            let told = ui.add(egui::Label::new(name).wrap());
            if !scenario.description.is_empty() {
                told.on_hover_text(&scenario.description);
            }
            quiet(ui, &scenario.source);
            let seed = session.plan.as_ref().map_or(0, |plan| plan.seed);
            let passed = (clock.now() as f32).min(scenario.seconds);
            quiet(ui, &format!("Seed {seed}, {passed:.1} of {} s", scenario.seconds));
            let progress = egui::ProgressBar::new(passed / scenario.seconds.max(0.1));
            ui.add(progress.desired_height(4.0).fill(paint(colours::ACCENT)));
            ui.add_space(6.0);
            let (words, colour) = match expectations.whole() {
                ExpectationStatus::Pending => ("Expected", colours::TEXT),
                ExpectationStatus::Met => ("Expected, and all met", colours::GOOD),
                ExpectationStatus::Failed => ("Expected, but failed", colours::PENALTY),
            };
            ui.label(RichText::new(words).strong().color(paint(colour)));
            let reasons = expectations.reasons();
            for (words, standing) in expectations.standings() {
                let reason = reasons.iter().find(|(failed, _)| failed == words).map(|(_, why)| why.as_str());
                show_expectation(ui, words, standing, reason);
            }
        });
    });
    Ok(())
}

fn quiet(ui: &mut egui::Ui, text: &str) {
    ui.add(egui::Label::new(RichText::new(text).size(SMALL).color(paint(colours::QUIET))).wrap());
}

fn show_expectation(ui: &mut egui::Ui, words: &str, standing: ExpectationStatus, reason: Option<&str>) {
    ui.horizontal_top(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(SIGN, SIGN + 2.0), egui::Sense::hover());
        let tells = match standing {
            ExpectationStatus::Pending => "Still open",
            ExpectationStatus::Met => "Met",
            ExpectationStatus::Failed => "Failed",
        };
        sign(ui.painter(), rect.center(), standing);
        let text = egui::Label::new(RichText::new(words).size(SMALL + 0.5)).wrap();
        ui.add(text).on_hover_text(reason.map_or(tells.to_owned(), |why| format!("{tells} {why}")));
    });
    if let Some(reason) = reason {
        ui.indent(words, |ui| {
            let text = RichText::new(reason).size(SMALL).color(paint(colours::PENALTY));
            ui.add(egui::Label::new(text).wrap());
        });
    }
}

/// An open circle, a tick or a cross.
fn sign(painter: &egui::Painter, at: egui::Pos2, standing: ExpectationStatus) {
    let stroke = |colour: Color| egui::Stroke::new(2.5, paint(colour));
    let line = |points: [egui::Vec2; 2], colour| {
        painter.line_segment(points.map(|point| at + point), stroke(colour));
    };
    match standing {
        ExpectationStatus::Pending => {
            painter.circle(at, 5.0, Color32::TRANSPARENT, (1.5, paint(colours::QUIET)));
        }
        ExpectationStatus::Met => {
            line([vec2(-5.0, 0.5), vec2(-1.5, 4.5)], colours::GOOD);
            line([vec2(-1.5, 4.5), vec2(5.0, -4.5)], colours::GOOD);
        }
        ExpectationStatus::Failed => {
            line([vec2(-4.5, -4.5), vec2(4.5, 4.5)], colours::PENALTY);
            line([vec2(-4.5, 4.5), vec2(4.5, -4.5)], colours::PENALTY);
        }
    }
}
