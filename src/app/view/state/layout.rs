//! What of the window is the pitch's: panels dock to its edges one after another, and what they leave is free.
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
                PanelSystems::Left,
                PanelSystems::Right,
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
    /// At the left: the scenario.
    Left,
    /// At the right: the inspector.
    Right,
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
    /// How large a panel may be, so that the pitch keeps its least size.
    pub fn room(&self, edge: Edge) -> f32 {
        match edge {
            Edge::Right => self.0.width() - PITCH.x,
            Edge::Bottom => self.0.height() - PITCH.y,
        }
    }
}

/// The least of the window that is left to the pitch, in points; panels are smaller or away where there is not more.
pub const PITCH: egui::Vec2 = egui::vec2(160.0, 100.0);

/// Where a panel that can be dragged docks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// The right edge.
    Right,
    /// The lower edge.
    Bottom,
}

/// The point of a rectangle that is nearest to another; its middle if it has no extent.
pub fn nearest_within(rect: egui::Rect, at: egui::Pos2) -> egui::Pos2 {
    let nearest = |range: egui::Rangef, at: f32| {
        if range.min <= range.max { at.clamp(range.min, range.max) } else { range.center() }
    };
    egui::pos2(nearest(rect.x_range(), at.x), nearest(rect.y_range(), at.y))
}

fn clear_area(mut contexts: EguiContexts, mut area: ResMut<FreeArea>) -> Result {
    area.0 = contexts.ctx_mut()?.content_rect();
    Ok(())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn the_nearest_point_is_within_or_in_the_middle(
            (left, top, width, height) in (-50.0f32..50.0, -50.0f32..50.0, -100.0f32..100.0, -100.0f32..100.0),
            (x, y) in (-200.0f32..200.0, -200.0f32..200.0),
        ) {
            let rect = egui::Rect::from_min_size(egui::pos2(left, top), egui::vec2(width, height));
            let at = nearest_within(rect, egui::pos2(x, y));
            if width >= 0.0 {
                prop_assert!((rect.left()..=rect.right()).contains(&at.x));
            } else {
                prop_assert_eq!(at.x, rect.center().x);
            }
            if height >= 0.0 && rect.y_range().contains(y) {
                prop_assert_eq!(at.y, y);
            }
        }
    }
}
