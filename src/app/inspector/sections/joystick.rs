//! A square to drive on: dragging the knob up walks ahead, to the left steps or turns left; it springs back when let go.

use bevy::prelude::Vec2;
use bevy_egui::egui::{self, Pos2, Rect, Sense, pos2, vec2};

use crate::app::view::colours;

/// Side of the square and radius of the knob, in points.
pub const SIZE: f32 = 112.0;
const KNOB: f32 = 9.0;
/// Nearer to an axis than this share of the way to the edge, the knob is on it.
const STILL: f32 = 0.1;

/// Shows the square. Changes the shares ahead and to the left, each from -1 to 1, while it is dragged, and sets them to 0 when
/// it is let go.
pub fn show(ui: &mut egui::Ui, walk: &mut Vec2, side: &str) {
    let sense = if ui.is_enabled() { Sense::drag() } else { Sense::hover() };
    let (rect, response) = ui.allocate_exact_size(vec2(SIZE, SIZE), sense);
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        *walk = walk_at(rect, pointer);
    }
    if response.drag_stopped() {
        *walk = Vec2::ZERO;
    }
    let held = response.dragged();
    let quiet = colours::egui(colours::QUIET).gamma_multiply(0.5);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 4.0, colours::egui(colours::SUNKEN));
    painter.hline(rect.x_range(), rect.center().y, (1.0, quiet));
    painter.vline(rect.center().x, rect.y_range(), (1.0, quiet));
    let knob = knob_at(rect, *walk);
    painter.line_segment([rect.center(), knob], (2.0, colours::egui(colours::PILOT).gamma_multiply(0.6)));
    let colour = if !ui.is_enabled() {
        quiet
    } else if held {
        colours::egui(colours::PILOT)
    } else {
        colours::egui(colours::TEXT)
    };
    painter.circle_filled(knob, KNOB, colour);
    if !held {
        response.on_hover_text(format!(
            "Drag: up is ahead, down is back, {side}. Let go to stand still. The driving keys go before it"
        ));
    }
}

/// The knob's way from the middle to the edge.
fn reach(rect: Rect) -> f32 {
    rect.width() / 2.0 - KNOB
}

/// The shares ahead and to the left with the knob under the pointer.
fn walk_at(rect: Rect, pointer: Pos2) -> Vec2 {
    let offset = (rect.center() - pointer) / reach(rect);
    let share = |way: f32| if way.abs() < STILL { 0.0 } else { way.clamp(-1.0, 1.0) };
    Vec2::new(share(offset.y), share(offset.x))
}

fn knob_at(rect: Rect, walk: Vec2) -> Pos2 {
    pos2(rect.center().x - walk.y * reach(rect), rect.center().y - walk.x * reach(rect))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rect() -> Rect {
        Rect::from_min_size(pos2(100.0, 50.0), vec2(SIZE, SIZE))
    }

    #[test]
    fn up_is_ahead_and_left_is_left() {
        let middle = rect().center();
        assert_eq!(walk_at(rect(), middle - vec2(0.0, 500.0)), Vec2::X);
        assert_eq!(walk_at(rect(), middle - vec2(500.0, 0.0)), Vec2::Y);
        assert_eq!(walk_at(rect(), middle + vec2(3.0, 3.0)), Vec2::ZERO, "almost still is still");
    }

    #[test]
    fn the_knob_is_where_it_was_put() {
        let at = rect().center() + vec2(-20.0, 30.0);
        assert!(knob_at(rect(), walk_at(rect(), at)).distance(at) < 1e-3);
    }
}
