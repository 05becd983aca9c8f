//! Panels dock to the edges of what is free of the window, and dialogues lie in its middle.

use bevy::prelude::*;
use bevy_egui::egui;

use crate::app::view::state::{Edge, FreeArea};

/// A panel that cannot be larger than this is left out, in points.
const NOTHING: f32 = 40.0;

/// A panel whose edge can be dragged.
pub struct SizedPanel {
    /// The name that egui knows it by.
    pub id: &'static str,
    /// The edge of the window at which it stands.
    pub edge: Edge,
    /// From edge to edge, in points.
    pub least: f32,
    /// The largest share of the window that it takes.
    pub most: f32,
    /// Its frame.
    pub frame: egui::Frame,
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
        self.dock_response(ctx, id, panel, contents).inner
    }

    fn dock_response<R>(
        &mut self,
        ctx: &egui::Context,
        id: &str,
        panel: egui::Panel,
        contents: impl FnOnce(&mut egui::Ui) -> R,
    ) -> egui::InnerResponse<R> {
        let place = egui::UiBuilder::new().layer_id(egui::LayerId::background()).max_rect(self.0);
        let mut root = egui::Ui::new(ctx.clone(), egui::Id::new(("dock", id)), place);
        root.set_clip_rect(self.0);
        let shown = panel.show_inside(&mut root, contents);
        // Contents that do not fit reach beyond the panel, but the pitch does not.
        self.0 = root.available_rect_before_wrap().intersect(self.0);
        shown
    }

    /// Shows a panel as large as a person has made it, or as there is room for; none where there is almost no room.
    pub fn dock_sized<R>(
        &mut self,
        ctx: &egui::Context,
        panel: SizedPanel,
        size: &mut f32,
        contents: impl FnOnce(&mut egui::Ui) -> R,
    ) -> Option<R> {
        let room = self.room(panel.edge);
        let along = |size: egui::Vec2| if panel.edge == Edge::Right { size.x } else { size.y };
        let at = |id: &str| match panel.edge {
            Edge::Right => egui::Panel::right(egui::Id::new(id)),
            Edge::Bottom => egui::Panel::bottom(egui::Id::new(id)),
        };
        *size = size.clamp(panel.least, panel.most);
        if room < *size {
            // Its own size waits for a larger window.
            let id = format!("{}, squeezed", panel.id);
            let shape = at(&id).resizable(false).exact_size(room).frame(panel.frame);
            return (room >= NOTHING).then(|| self.dock(ctx, &id, shape, contents));
        }
        let shape = at(panel.id)
            .resizable(true)
            .default_size(*size)
            .size_range(panel.least..=panel.most.min(room))
            .frame(panel.frame);
        let shown = self.dock_response(ctx, panel.id, shape, contents);
        *size = along(shown.response.rect.size());
        Some(shown.inner)
    }
}

/// Shows something in the middle of the window that is not moved about and scrolls where it does not fit.
pub fn show_in_the_middle<R>(
    ctx: &egui::Context,
    title: &str,
    contents: impl FnOnce(&mut egui::Ui) -> R,
) -> Option<R> {
    let room = (ctx.content_rect().size() - egui::Vec2::splat(AROUND)).max(egui::Vec2::splat(1.0));
    let shown = egui::Window::new(title.to_owned())
        .pivot(egui::Align2::CENTER_CENTER)
        .fixed_pos(ctx.content_rect().center())
        .title_bar(false)
        .collapsible(false)
        .auto_sized()
        .constrain(true)
        .order(egui::Order::Foreground)
        .show(ctx, |ui| {
            ui.set_max_width(room.x.min(WIDEST));
            let scroll = egui::ScrollArea::both()
                .max_width(room.x)
                .max_height(room.y)
                .min_scrolled_width(room.x)
                .min_scrolled_height(room.y);
            scroll.show(ui, contents).inner
        });
    shown.and_then(|shown| shown.inner)
}

/// Room around what is shown in the middle, to the edges of the screen, in points.
const AROUND: f32 = 44.0;

/// The widest that it becomes, in points.
const WIDEST: f32 = 880.0;
