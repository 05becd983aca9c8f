//! The pointer, as far as it concerns the pitch.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, egui};

use crate::app::view::state::{FrameSystems, FreeArea};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Pointer>().add_systems(Update, follow_pointer.in_set(FrameSystems::Keys));
}

/// The pointer, as far as it concerns the pitch and no panel or window above it.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq)]
pub struct Pointer {
    /// Where it is over the pitch, in points.
    pub over_pitch: Option<egui::Pos2>,
    /// A click on the pitch that was no drag.
    pub clicked: Option<egui::Pos2>,
    /// How far the pitch was dragged in this frame, in points.
    pub dragged: Option<egui::Vec2>,
    pressed_at: Option<egui::Pos2>,
    last: Option<egui::Pos2>,
    moved: bool,
}

/// A press that moves less than this is a click, in points.
const CLICK: f32 = 4.0;

impl Pointer {
    fn step(&mut self, at: Option<egui::Pos2>, over_pitch: bool, pressed: bool, held: bool) {
        (self.clicked, self.dragged) = (None, None);
        self.over_pitch = at.filter(|_| over_pitch);
        if pressed {
            (self.pressed_at, self.moved) = (self.over_pitch, false);
        }
        if let (Some(start), Some(at)) = (self.pressed_at, at) {
            self.moved |= start.distance(at) > CLICK;
            if !held {
                self.clicked = (!self.moved).then_some(at);
            } else if let Some(last) = self.last.filter(|_| self.moved && !pressed) {
                self.dragged = Some(at - last).filter(|moved| *moved != egui::Vec2::ZERO);
            }
        }
        if !held {
            self.pressed_at = None;
        }
        self.last = at;
    }
}

pub(super) fn follow_pointer(
    mut contexts: EguiContexts,
    area: Res<FreeArea>,
    buttons: Res<ButtonInput<MouseButton>>,
    mut pointer: ResMut<Pointer>,
) -> Result {
    let ctx = contexts.ctx_mut()?;
    let at = ctx.input(|input| input.pointer.latest_pos());
    let over_pitch = at.is_some_and(|at| {
        let above = ctx.layer_id_at(at).is_some_and(|layer| layer.order != egui::Order::Background);
        area.0.contains(at) && !above && !ctx.egui_is_using_pointer()
    });
    let held = buttons.pressed(MouseButton::Left);
    pointer.step(at, over_pitch, buttons.just_pressed(MouseButton::Left), held);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_press_that_moves_is_a_drag_and_no_click() {
        let (start, end) = (egui::pos2(10.0, 10.0), egui::pos2(30.0, 10.0));
        let mut pointer = Pointer::default();
        pointer.step(Some(start), true, true, true);
        pointer.step(Some(end), true, false, true);
        assert_eq!(pointer.dragged, Some(egui::vec2(20.0, 0.0)));
        pointer.step(Some(end), true, false, false);
        assert_eq!((pointer.clicked, pointer.dragged), (None, None));
    }

    #[test]
    fn a_short_press_is_a_click_unless_it_began_on_a_panel() {
        let at = egui::pos2(10.0, 10.0);
        for (over_pitch, clicked) in [(true, Some(at)), (false, None)] {
            let mut pointer = Pointer::default();
            pointer.step(Some(at), over_pitch, true, true);
            pointer.step(Some(at), true, false, false);
            assert_eq!(pointer.clicked, clicked);
        }
    }
}
