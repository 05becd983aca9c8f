//! The panel at the right edge: the selected robot, section by section. Its edge can be dragged.
//! Without a selection there is only a strip, and the pitch has the room.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};

use super::numbers::NumberDesk;
use super::sections::{self, PanelActions};
use super::subject::{InspectedMatch, SelectedRobot};
use crate::app::view::input::keyboard::Keyboard;
use crate::app::view::input::manual_control::ManualControl;
use crate::app::view::interface::dock::SizedPanel;
use crate::app::view::state::{
    Action, Edge, FreeArea, Inspector, PanelSizes, PanelSystems, Piloted, RememberedPanels, Screen, Session,
};
use crate::game::requests::Requests;
use crate::strategy::StrategySources;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<NumberDesk>();
    app.add_systems(EguiPrimaryContextPass, dock.in_set(PanelSystems::Right).run_if(in_state(Screen::Match)));
}

/// Widths of the panel in points: least and most; and of the strip that is left when it is closed.
const WIDTH: (f32, f32) = (384.0, 620.0);
const STRIP: f32 = 26.0;

const MARGIN: egui::Margin = egui::Margin { left: 10, right: 6, top: 7, bottom: 4 };

/// What the panel changes.
#[derive(SystemParam)]
struct Changes<'w> {
    inspector: ResMut<'w, Inspector>,
    requests: ResMut<'w, Requests>,
    piloted: ResMut<'w, Piloted>,
    control: ResMut<'w, ManualControl>,
    sizes: ResMut<'w, PanelSizes>,
    remembered: ResMut<'w, RememberedPanels>,
    keyboard: Res<'w, Keyboard>,
    session: Res<'w, Session>,
    numbers: ResMut<'w, NumberDesk>,
    sources: Res<'w, StrategySources>,
}

fn dock(
    mut contexts: EguiContexts,
    mut area: ResMut<FreeArea>,
    scene: InspectedMatch,
    mut changes: Changes,
) -> Result {
    let ctx = contexts.ctx_mut()?;
    let robot = scene.looked();
    let mut size = changes.sizes.inspector;
    let shown = robot.filter(|_| changes.inspector.open).and_then(|robot| {
        let panel = SizedPanel {
            id: "inspector",
            edge: Edge::Right,
            least: WIDTH.0,
            most: WIDTH.1,
            frame: egui::Frame::side_top_panel(&ctx.global_style()).inner_margin(MARGIN),
        };
        area.dock_sized(ctx, panel, &mut size, |ui| fill(ui, &robot, &mut changes))
    });
    if shown.is_some() {
        changes.sizes.inspector = size;
    } else if area.0.width() > 2.0 * STRIP {
        let strip = egui::Panel::right("inspector_strip").resizable(false).exact_size(STRIP);
        area.dock(ctx, "inspector_strip", strip, |ui| {
            let open = ui.add(egui::Button::new("⏴").frame(false));
            let hint = "The inspector: click a robot, or press Tab, to look inside it";
            if open.on_hover_text(changes.keyboard.tip_that_says(hint, Action::Inspector)).clicked() {
                changes.inspector.open = true;
            }
        });
    }
    Ok(())
}

fn fill(ui: &mut egui::Ui, robot: &SelectedRobot, changes: &mut Changes) {
    set_close(ui);
    // A copy, since a seat that seems to change is asked to steer.
    let mut piloted = *changes.piloted;
    let mut actions = PanelActions {
        requests: &mut changes.requests,
        piloted: &mut piloted,
        control: &mut changes.control,
        plan: changes.session.plan.as_ref(),
        numbers: &mut changes.numbers,
        sources: &changes.sources,
        open: &mut changes.inspector.open,
        playing: &mut changes.remembered.playing,
        keyboard: &changes.keyboard,
    };
    // In a small window it is no wider than there is room, and scrolls.
    egui::ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| {
        ui.set_min_width(WIDTH.0 - MARGIN.sum().x);
        sections::draw_head(ui, robot, &mut actions);
        ui.separator();
        egui::ScrollArea::vertical()
            .auto_shrink(false)
            .show(ui, |ui| sections::draw(ui, robot, &mut actions));
    });
    changes.piloted.set_if_neq(piloted);
}

/// Much is to be seen at once here, so type and rows are as small as they may be anywhere.
pub fn set_close(ui: &mut egui::Ui) {
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
