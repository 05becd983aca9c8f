//! Where things go in the window: panels dock to its edges one after another, and what they leave is the pitch's.
//!
//! Every system that draws interface runs in `EguiPrimaryContextPass`, in one of the [`PanelSystems`].

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<FreeArea>()
        .configure_sets(
            EguiPrimaryContextPass,
            (
                PanelSystems::Clear,
                PanelSystems::Top,
                PanelSystems::Bottom,
                PanelSystems::Low,
                PanelSystems::Side,
                PanelSystems::Pitch,
                PanelSystems::Notes,
                PanelSystems::Floating,
            )
                .chain(),
        )
        .add_systems(EguiPrimaryContextPass, clear_area.in_set(PanelSystems::Clear));
}

/// The order in which the interface is drawn. Each panel docks to what the ones before it have left.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PanelSystems {
    /// Nothing is docked yet.
    Clear,
    /// Across the top: score, clock, what went wrong.
    Top,
    /// Across the bottom: time and overlays.
    Bottom,
    /// Above the bar at the bottom: the radio.
    Low,
    /// At the sides: the inspector, the scenario.
    Side,
    /// Text on the pitch, in the area that is free now.
    Pitch,
    /// Text on the pitch that finds its place among what is there.
    Notes,
    /// Dialogues and floating windows.
    Floating,
}

/// The part of the window that no panel covers, in egui points. Complete from [`PanelSystems::Pitch`] on, and in the
/// `Update` of the next frame.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct FreeArea(pub egui::Rect);

impl Default for FreeArea {
    fn default() -> FreeArea {
        FreeArea(egui::Rect::NOTHING)
    }
}

impl FreeArea {
    /// Shows a panel at an edge of the free area and takes its space from it.
    pub fn dock<R>(
        &mut self,
        ctx: &egui::Context,
        id: &str,
        panel: egui::Panel,
        contents: impl FnOnce(&mut egui::Ui) -> R,
    ) -> R {
        let place = egui::UiBuilder::new().layer_id(egui::LayerId::background()).max_rect(self.0);
        let mut root = egui::Ui::new(ctx.clone(), egui::Id::new(("dock", id)), place);
        root.set_clip_rect(self.0);
        let shown = panel.show_inside(&mut root, contents).inner;
        self.0 = root.available_rect_before_wrap();
        shown
    }
}

fn clear_area(mut contexts: EguiContexts, mut area: ResMut<FreeArea>) -> Result {
    area.0 = contexts.ctx_mut()?.content_rect();
    Ok(())
}
