//! The panel at the right edge: the selected robot, section by section. Key I opens and closes it; its edge can be dragged.
//! Without a selection there is only a strip, and the pitch has the room.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};

use super::Inspector;
use super::sections::{self, Desk};
use super::subject::{Looked, Scene};
use super::weights::Weights;
use crate::script::Requests;
use crate::view::layout::{FreeArea, PanelSystems};
use crate::view::levers::Levers;
use crate::view::session::Session;
use crate::view::state::{Piloted, Screen};

pub(super) fn plugin(app: &mut App) {
    app.add_systems(EguiPrimaryContextPass, dock.in_set(PanelSystems::Side).run_if(in_state(Screen::Match)));
}

/// Widths of the panel in points: at first, least and most; and of the strip that is left when it is closed.
const WIDTH: (f32, f32, f32) = (400.0, 384.0, 620.0);
const STRIP: f32 = 26.0;

const MARGIN: egui::Margin = egui::Margin { left: 10, right: 6, top: 7, bottom: 4 };

/// What the panel changes.
#[derive(SystemParam)]
struct Changes<'w> {
    inspector: ResMut<'w, Inspector>,
    requests: ResMut<'w, Requests>,
    weights: ResMut<'w, Weights>,
    piloted: ResMut<'w, Piloted>,
    levers: ResMut<'w, Levers>,
    session: Res<'w, Session>,
}

fn dock(
    mut contexts: EguiContexts,
    mut area: ResMut<FreeArea>,
    scene: Scene,
    mut changes: Changes,
) -> Result {
    let ctx = contexts.ctx_mut()?;
    let robot = scene.looked();
    if let Some(robot) = robot.filter(|_| changes.inspector.open) {
        let panel = egui::Panel::right("inspector")
            .resizable(true)
            .default_size(WIDTH.0)
            .size_range(WIDTH.1..=WIDTH.2)
            .frame(egui::Frame::side_top_panel(&ctx.global_style()).inner_margin(MARGIN));
        area.dock(ctx, "inspector", panel, |ui| {
            fill(ui, &robot, &mut changes);
        });
    } else {
        let strip = egui::Panel::right("inspector_strip").resizable(false).exact_size(STRIP);
        area.dock(ctx, "inspector_strip", strip, |ui| {
            let open = ui.add(egui::Button::new("⏴").frame(false));
            let hint = "The inspector (I): click a robot, or press Tab, to look inside it";
            if open.on_hover_text(hint).clicked() {
                changes.inspector.open = true;
            }
        });
    }
    Ok(())
}

fn fill(ui: &mut egui::Ui, robot: &Looked, changes: &mut Changes) {
    set_close(ui);
    let mut desk = Desk {
        requests: &mut changes.requests,
        weights: &mut changes.weights,
        piloted: &mut changes.piloted,
        levers: &mut changes.levers,
        file: changes.session.plan.as_ref().map(|plan| plan.team(robot.id.team)),
        open: &mut changes.inspector.open,
    };
    sections::draw_head(ui, robot, &mut desk);
    ui.separator();
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| sections::draw(ui, robot, &mut desk));
}

/// Much is to be seen at once here, so type and rows are as small as they may be anywhere.
pub(super) fn set_close(ui: &mut egui::Ui) {
    use egui::TextStyle::{Body, Button};
    let style = ui.style_mut();
    for name in [Body, Button] {
        style.text_styles.insert(name, egui::FontId::proportional(13.0));
    }
    style.spacing.item_spacing.y = 2.0;
    style.spacing.button_padding = egui::vec2(7.0, 1.0);
    style.spacing.interact_size.y = 18.0;
    // Beside the figures, not upon them.
    style.spacing.scroll.floating_allocated_width = 8.0;
}
