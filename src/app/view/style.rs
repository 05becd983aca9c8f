//! How the interface looks: one family of type, 13 points and up, on quiet dark green panels.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};

use super::colours::{self, egui as paint};
use super::state::PanelSystems;

pub(in crate::app) fn plugin(app: &mut App) {
    app.add_systems(EguiPrimaryContextPass, set_style.in_set(PanelSystems::Clear).run_if(run_once));
}

/// The smallest type anywhere, in points.
pub const SMALL: f32 = 13.0;

/// The button that a card is about.
pub fn big_button(ui: &mut egui::Ui, text: &str) -> egui::Response {
    let text = egui::RichText::new(text).size(17.0).color(egui::Color32::WHITE);
    let text = (egui::Atom::grow(), text, egui::Atom::grow());
    ui.add(
        egui::Button::new(text)
            .fill(paint(colours::ACCENT).gamma_multiply(0.8))
            .min_size(egui::vec2(120.0, 36.0)),
    )
}

/// Type of a size in points.
pub fn font(size: f32) -> egui::FontId {
    egui::FontId::proportional(size.max(SMALL))
}

/// The ground of a docked panel.
pub fn panel_frame(colour: Color, margin: egui::Margin) -> egui::Frame {
    egui::Frame::new().fill(paint(colour)).inner_margin(margin)
}

fn set_style(mut contexts: EguiContexts) -> Result {
    let ctx = contexts.ctx_mut()?;
    ctx.set_theme(egui::Theme::Dark);
    ctx.all_styles_mut(|style| {
        use egui::TextStyle::{Body, Button, Heading, Monospace, Small};
        style.text_styles =
            [(Body, 14.0), (Button, 14.0), (Heading, 20.0), (Small, SMALL), (Monospace, SMALL)]
                .map(|(name, size)| (name, font(size)))
                .into();
        style.spacing.button_padding = egui::vec2(9.0, 4.0);
        style.spacing.item_spacing = egui::vec2(6.0, 5.0);
        style.spacing.window_margin = egui::Margin::same(18);
        style.interaction.selectable_labels = false;
        style.interaction.tooltip_delay = 0.3;
        set_colours(&mut style.visuals);
    });
    Ok(())
}

fn set_colours(visuals: &mut egui::Visuals) {
    visuals.panel_fill = paint(colours::PANEL);
    visuals.window_fill = paint(colours::PANEL);
    visuals.extreme_bg_color = paint(colours::SUNKEN);
    visuals.selection.bg_fill = paint(colours::ACCENT).gamma_multiply(0.7);
    visuals.selection.stroke.color = paint(colours::PILOT);
    visuals.window_shadow = egui::Shadow::NONE;
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.fg_stroke.color = paint(colours::TEXT);
    for (state, fill) in [
        (&mut widgets.inactive, paint(colours::RAISED)),
        (&mut widgets.hovered, paint(colours::RAISED).gamma_multiply(1.5)),
        (&mut widgets.active, paint(colours::ACCENT)),
        (&mut widgets.open, paint(colours::RAISED)),
    ] {
        (state.bg_fill, state.weak_bg_fill) = (fill, fill);
        state.fg_stroke.color = paint(colours::TEXT);
    }
    widgets.hovered.fg_stroke.color = paint(colours::PILOT);
}
