//! Waiting for robots that are processes of their own: the window shows which have not answered, and a person can give one up.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};
use egui::{Color32, RichText};

use super::dock::show_in_the_middle;
use crate::app::view::state::{Action, Edge, FreeArea, OpenDialogues, PanelSystems, Screen};
use crate::app::view::style::panel_frame;
use crate::app::view::time::remote_robots::Missing;
use crate::app::view::{colours, format};
use crate::clock::Clock;
use crate::game::net::Awaited;
use crate::ids::RobotId;

/// What a person sees of it.
pub(super) fn plugin(app: &mut App) {
    app.add_systems(
        EguiPrimaryContextPass,
        (show_silent.in_set(PanelSystems::Top), show_waiting.in_set(PanelSystems::Floating))
            .run_if(in_state(Screen::Match).and_then(|missing: Res<Missing>| !missing.robots.is_empty())),
    );
}

/// A robot with a button that gives it up; whether that was clicked.
fn show_robot(ui: &mut egui::Ui, missing: &Awaited, words: &str) -> bool {
    ui.horizontal_wrapped(|ui| {
        let told = format!("{} {words} {}", format::capitalised(missing.robot), missing.address);
        ui.label(RichText::new(told).color(Color32::WHITE)).on_hover_text(started_with(missing.robot));
        let tip = "Do not wait for it: its strategy plays it in this process";
        let clicked = ui.button("Play it here").on_hover_text(tip).clicked();
        if let Some(refusal) = &missing.refusal {
            ui.label(RichText::new(refusal).color(colours::egui(colours::PENALTY)));
        }
        clicked
    })
    .inner
}

/// How a person starts a robot.
fn started_with(robot: RobotId) -> String {
    format!("It is started with: touchline robot --team {} --number {}", robot.team, robot.number)
}

/// Before the match: in its middle.
fn show_waiting(
    mut contexts: EguiContexts,
    (open, clock): (Res<OpenDialogues>, Res<Clock>),
    mut missing: ResMut<Missing>,
    mut actions: MessageWriter<Action>,
) -> Result {
    if clock.tick > 0 || open.question.is_some() || open.help {
        return Ok(());
    }
    let missing = missing.bypass_change_detection();
    let mut given_up = Vec::new();
    show_in_the_middle(contexts.ctx_mut()?, "Waiting", |ui| {
        ui.label(RichText::new("The match begins when these robots have answered").size(16.0));
        ui.add_space(6.0);
        for robot in &missing.robots {
            if show_robot(ui, robot, "at") {
                given_up.push(robot.robot);
            }
        }
        ui.add_space(6.0);
        if ui.button("Back to the menu").clicked() {
            actions.write(Action::Leave);
        }
    });
    missing.given_up.extend(given_up);
    Ok(())
}

/// During the match, which goes on without them: on a line.
fn show_silent(
    mut contexts: EguiContexts,
    (mut area, clock): (ResMut<FreeArea>, Res<Clock>),
    mut missing: ResMut<Missing>,
) -> Result {
    if clock.tick == 0 || area.room(Edge::Bottom) < 40.0 {
        return Ok(());
    }
    let missing = missing.bypass_change_detection();
    let panel = egui::Panel::top("silent robots")
        .resizable(false)
        .frame(panel_frame(colours::TROUBLE, egui::Margin::symmetric(12, 6)));
    let mut given_up = Vec::new();
    area.dock(contexts.ctx_mut()?, "silent robots", panel, |ui| {
        for robot in &missing.robots {
            if show_robot(ui, robot, "stands still: nobody answers at") {
                given_up.push(robot.robot);
            }
        }
    });
    missing.given_up.extend(given_up);
    Ok(())
}
