//! The pointer on the pitch, and which robot is selected: by a click, or by going round with Tab.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, egui};

use super::FrameSystems;
use super::actions::Action;
use super::camera::Sight;
use super::layout::FreeArea;
use super::robots::reach;
use super::shown::Shown;
use super::state::{Piloted, Selected};
use crate::game::requests::{Request, Requests};
use crate::ids::RobotId;
use crate::robot::Robot;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Pointer>()
        .add_systems(Update, follow_pointer.in_set(FrameSystems::Keys))
        .add_systems(Update, (select_by_click, select_next).chain().in_set(FrameSystems::Input));
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
/// A click this near to a robot means it, in points; robots that are larger are hit where they are.
const NEAR: f32 = 24.0;

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

fn follow_pointer(
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

fn select_by_click(
    pointer: Res<Pointer>,
    sight: Res<Sight>,
    shown: Query<&Shown>,
    robots: Query<&Robot>,
    mut selected: ResMut<Selected>,
) {
    let Some(at) = pointer.clicked else { return };
    let point = sight.to_pitch(at);
    let nearest = (shown.iter())
        .filter_map(|shown| {
            let reach = reach(&robots.get(shown.body).ok()?.kind).max(NEAR / sight.scale);
            Some((shown.pose.position.distance(point), reach, shown.robot?))
        })
        .filter(|(distance, reach, _)| distance < reach)
        .map(|(distance, _, id)| (distance, id))
        .min_by(|(a, _), (b, _)| a.total_cmp(b));
    selected.0 = nearest.map(|(_, id)| id);
}

/// The robot after one, or before it, going round; the first or last one if there was none.
pub fn next(of: &[RobotId], present: Option<RobotId>, forward: bool) -> Option<RobotId> {
    let place = present.and_then(|present| of.iter().position(|robot| *robot == present));
    let index = match (place, forward) {
        (Some(place), true) => (place + 1) % of.len(),
        (Some(place), false) => (place + of.len() - 1) % of.len(),
        (None, true) => 0,
        (None, false) => of.len().checked_sub(1)?,
    };
    of.get(index).copied()
}

fn select_next(
    mut actions: MessageReader<Action>,
    (mut selected, mut piloted): (ResMut<Selected>, ResMut<Piloted>),
    mut requests: ResMut<Requests>,
    robots: Query<&RobotId>,
) {
    for action in actions.read() {
        let forward = match action {
            Action::NextRobot => true,
            Action::PreviousRobot => false,
            _ => continue,
        };
        let mut all: Vec<RobotId> = robots.iter().copied().collect();
        all.sort_unstable();
        match piloted.0 {
            None => selected.0 = next(&all, selected.0, forward),
            Some(seat) => {
                all.retain(|robot| robot.team == seat.team);
                let Some(new) = next(&all, Some(seat), forward) else { continue };
                requests.ask(Request::HandBack(seat));
                requests.ask(Request::TakeOver(new));
                (selected.0, piloted.0) = (Some(new), Some(new));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    #[test]
    fn going_round_comes_back_to_the_first_robot() {
        let all = [0, 1, 2].map(|number| RobotId::new(Team::Home, number));
        assert_eq!(next(&all, None, true), Some(all[0]));
        assert_eq!(next(&all, Some(all[2]), true), Some(all[0]));
        assert_eq!(next(&all, Some(all[0]), false), Some(all[2]));
        assert_eq!(next(&all, None, false), Some(all[2]));
        assert_eq!(next(&[], None, false), None);
    }

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
