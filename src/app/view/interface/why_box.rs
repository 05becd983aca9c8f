//! The answer to why things stand as they do: what would have changed it, the weightiest first. A click plays on from there with it
//! changed.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};

use crate::app::view::colours::{self, egui as paint};
use crate::app::view::format;
use crate::app::view::state::{Action, FreeArea, PanelSystems, Screen};
use crate::app::view::time::asking::{AskedWhy, WhyQuestion};
use crate::lab::why::WhyReport;

pub(super) fn plugin(app: &mut App) {
    app.add_systems(
        EguiPrimaryContextPass,
        show.in_set(PanelSystems::Floating).run_if(in_state(Screen::Match)).run_if(is_asked),
    );
}

fn is_asked(asked: Res<AskedWhy>) -> bool {
    asked.is_open()
}

/// Size of the box in points.
const SIZE: egui::Vec2 = egui::vec2(520.0, 260.0);
/// Findings that are shown at most.
const SHOWN: usize = 40;

fn show(
    mut contexts: EguiContexts,
    area: Res<FreeArea>,
    mut asked: ResMut<AskedWhy>,
    mut actions: MessageWriter<Action>,
) -> Result {
    let ctx = contexts.ctx_mut()?;
    let mut open = true;
    let at = area.0.left_top() + egui::vec2(12.0, 12.0);
    egui::Window::new("Why?")
        .open(&mut open)
        .collapsible(false)
        .default_pos(at)
        .default_size(SIZE)
        .constrain_to(area.0)
        .show(ctx, |ui| {
            if let Some(question) = &asked.question {
                show_progress(ui, question);
            }
            if let Some(report) = &asked.report
                && let Some(place) = show_report(ui, report)
            {
                actions.write(Action::TakeReason(place));
            }
        });
    if !open {
        asked.close();
    }
    Ok(())
}

fn show_progress(ui: &mut egui::Ui, question: &WhyQuestion) {
    let (tried, all) = question.progress();
    let share = if all == 0 { 0.0 } else { tried as f32 / all as f32 };
    let text = if all == 0 {
        "The match is played again…".into()
    } else {
        format!("{tried} of {all} changes tried")
    };
    ui.add(egui::ProgressBar::new(share).text(text));
    ui.ctx().request_repaint();
}

/// The place of the finding that a person wants to see.
fn show_report(ui: &mut egui::Ui, report: &WhyReport) -> Option<usize> {
    let [home, away] = report.outcome.score;
    let moment = format::moment(report.outcome.tick, report.dt);
    ui.label(format!("After {moment} it is {home} : {away}. This would have changed it:"));
    if report.findings.is_empty() {
        let tried = report.tried;
        ui.weak(format!(
            "Nothing of {tried} messages, swaps, claims, bookings and crashes of the seconds before."
        ));
    }
    let mut wanted = None;
    egui::ScrollArea::vertical().auto_shrink([false, true]).show(ui, |ui| {
        for (place, finding) in report.findings.iter().take(SHOWN).enumerate() {
            let when = format::moment(finding.candidate.tick, report.dt);
            let text = format!("{when}  If {}", finding.candidate.meddling);
            let response = ui.add(egui::Button::new(text).wrap().frame(false));
            if response.on_hover_text("Play on from there in a branch of its own").clicked() {
                wanted = Some(place);
            }
            ui.horizontal(|ui| {
                ui.add_space(16.0);
                ui.colored_label(paint(colours::PILOT), finding.difference.to_string());
                ui.weak(format!("{} of {} other dice agree", finding.agree, report.seeds));
            });
        }
    });
    wanted
}
