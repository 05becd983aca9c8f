//! The panels across the window below the pitch, of which one is open: a row of controls, and a page below it.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_egui::{EguiContexts, egui};

use super::panel::set_close;
use crate::app::view::input::keyboard::Keyboard;
use crate::app::view::interface::dock::SizedPanel;
use crate::app::view::state::{Action, Edge, FreeArea, Overlay, Overlays, PanelSizes};

/// Where panels below the pitch dock.
#[derive(SystemParam)]
pub struct LowDock<'w, 's> {
    contexts: EguiContexts<'w, 's>,
    area: ResMut<'w, FreeArea>,
    overlays: ResMut<'w, Overlays>,
    sizes: ResMut<'w, PanelSizes>,
    keyboard: Res<'w, Keyboard>,
}

/// A panel, with the least and the most of its height in points, and what its button that closes it does.
#[derive(Clone, Copy, Debug)]
pub struct LowPanel {
    pub overlay: Overlay,
    pub id: &'static str,
    pub heights: (f32, f32),
    pub closes: &'static str,
}

impl LowDock<'_, '_> {
    /// Shows a panel; both its parts draw from and change the same data.
    pub fn show<T>(
        &mut self,
        panel: LowPanel,
        data: &mut T,
        toolbar: impl FnOnce(&mut egui::Ui, &mut T),
        page: impl FnOnce(&mut egui::Ui, &mut T),
    ) -> Result {
        let ctx = self.contexts.ctx_mut()?;
        let frame = egui::Frame::side_top_panel(&ctx.global_style());
        let sized = SizedPanel {
            id: panel.id,
            edge: Edge::Bottom,
            least: panel.heights.0,
            most: panel.heights.1,
            frame: frame.inner_margin(egui::Margin::symmetric(10, 5)),
        };
        let tip = self.keyboard.tip_that_says(panel.closes, Action::Switch(panel.overlay));
        let size = self.sizes.bypass_change_detection().below(panel.overlay);
        let closed = self.area.dock_sized(ctx, sized, size, |ui| {
            set_close(ui);
            let rows = egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                let closed = with_close_button(ui, &tip, |ui| toolbar(ui, data));
                ui.separator();
                page(ui, data);
                closed
            });
            rows.inner
        });
        if closed == Some(true) {
            self.overlays.set(panel.overlay, false);
        }
        Ok(())
    }
}

/// Room for the button that closes a panel, in points.
const CLOSE: f32 = 20.0;

/// Shows contents in as many rows as they take, with a button at the right that closes the panel; whether that was clicked.
fn with_close_button(ui: &mut egui::Ui, tip: &str, contents: impl FnOnce(&mut egui::Ui)) -> bool {
    let right = ui.max_rect().right();
    let rows = ui.scope(|ui| {
        ui.set_max_width((ui.available_width() - 1.5 * CLOSE).max(1.0));
        ui.horizontal_wrapped(contents);
    });
    let corner = egui::pos2(right - CLOSE, rows.response.rect.top());
    let place = egui::UiBuilder::new()
        .max_rect(egui::Rect::from_min_size(corner, egui::Vec2::splat(CLOSE)))
        .id_salt("close");
    let close = ui.new_child(place).add(egui::Button::new("⏷").frame(false));
    close.on_hover_text(tip).clicked()
}
