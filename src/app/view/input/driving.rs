//! A person's hands: the keys that drive and the levers of the inspector become requests, and a robot is taken over or handed
//! back.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_egui::EguiContexts;

use super::keys::DriveKey;
use super::manual_control::{ControlInput, ManualControl, aimed};
use crate::app::view::state::{Action, FrameSystems, OpenDialogues, Piloted, Selected};
use crate::clock::Clock;
use crate::game::requests::{Request, Requests};
use crate::ids::RobotId;
use crate::robot::handling::Handling;
use crate::robot::pilot::Pilot;
use crate::robot::{Kick, Robot};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<ManualControl>()
        .add_systems(Update, (change_seat, steer).chain().in_set(FrameSystems::Input));
}

/// The robot under a person's hands.
#[derive(SystemParam)]
pub struct DrivenRobot<'w, 's> {
    piloted: Res<'w, Piloted>,
    robots: Query<'w, 's, (&'static RobotId, &'static Robot, &'static Handling)>,
}

impl DrivenRobot<'_, '_> {
    /// The robot that the person drives.
    pub fn id(&self) -> Option<RobotId> {
        self.piloted.0
    }

    fn robot(&self) -> Option<(&Robot, &Handling)> {
        let found = self.robots.iter().find(|(id, ..)| Some(**id) == self.piloted.0);
        found.map(|(_, robot, handling)| (robot, handling))
    }

    /// Whether it is one that kicks.
    pub fn kicks(&self) -> bool {
        self.robot().is_some_and(|(robot, _)| !robot.kind.kicks.is_empty())
    }

    /// The kick that goes nearest to a direction, degrees to the left of straight ahead.
    fn kick_to(&self, direction: f32) -> Option<usize> {
        let (robot, handling) = self.robot()?;
        let kicks: Vec<Kick> = robot.kind.kicks.values().copied().collect();
        aimed(&kicks, direction, handling.holds())
    }
}

/// What the keys that are down say.
fn input(down: impl Fn(DriveKey) -> bool) -> ControlInput {
    let lever = |plus, minus| f32::from(u8::from(down(plus))) - f32::from(u8::from(down(minus)));
    ControlInput {
        walk: Vec2::new(
            lever(DriveKey::Ahead, DriveKey::Back),
            lever(DriveKey::StepLeft, DriveKey::StepRight),
        ),
        turn: lever(DriveKey::TurnLeft, DriveKey::TurnRight),
        hold: down(DriveKey::Hold),
    }
}

/// What kicks, and where to, degrees to the left of straight ahead.
const KICKS: [(DriveKey, f32); 3] =
    [(DriveKey::KickAhead, 0.0), (DriveKey::KickLeft, 75.0), (DriveKey::KickRight, -75.0)];

fn change_seat(
    mut actions: MessageReader<Action>,
    mut piloted: ResMut<Piloted>,
    selected: Res<Selected>,
    mut requests: ResMut<Requests>,
) {
    for _ in actions.read().filter(|action| **action == Action::HandOver) {
        let to = if piloted.0.is_some() { None } else { selected.0 };
        piloted.change(to, &mut requests);
    }
}

fn steer(
    mut contexts: EguiContexts,
    held: Res<ButtonInput<KeyCode>>,
    (driven, open, clock): (DrivenRobot, Res<OpenDialogues>, Res<Clock>),
    (mut requests, mut control): (ResMut<Requests>, ResMut<ManualControl>),
    mut last: Local<Option<(RobotId, Pilot)>>,
) -> Result {
    // Keys with Ctrl are for panels.
    let chord = held.any_pressed([KeyCode::ControlLeft, KeyCode::ControlRight]);
    let elsewhere = contexts.ctx_mut()?.egui_wants_keyboard_input() || open.question.is_some();
    let control = control.bypass_change_detection();
    if last.map(|(robot, _)| robot) != driven.id() {
        *control = ManualControl::default();
    }
    for (kick, direction) in KICKS {
        if !elsewhere
            && !chord
            && kick.is_held(&held)
            && let Some(kick) = driven.kick_to(direction)
        {
            control.kick(kick, &clock);
        }
    }
    control.let_kick_pass(&clock);
    let keys = input(|drive| !elsewhere && drive.is_held(&held));
    let now = driven.id().map(|robot| (robot, control.with(keys)));
    if let Some((robot, pilot)) = now.filter(|now| driven.piloted.is_changed() || Some(*now) != *last) {
        requests.ask(Request::Steer { robot, pilot });
    }
    *last = now;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn held(drives: &[DriveKey]) -> ControlInput {
        input(|wanted| drives.contains(&wanted))
    }

    #[test]
    fn keys_walk_and_turn_at_once() {
        let input = held(&[DriveKey::Ahead, DriveKey::TurnRight]);
        assert_eq!((input.walk, input.turn), (Vec2::X, -1.0));
    }

    #[test]
    fn opposite_keys_cancel() {
        assert_eq!(held(&[DriveKey::Ahead, DriveKey::Back]), ControlInput::default());
        assert_eq!(held(&[DriveKey::StepLeft, DriveKey::StepRight]), ControlInput::default());
        assert_eq!(held(&[]), ControlInput::default());
    }

    #[test]
    fn a_robot_steps_to_the_left_while_it_holds_the_ball() {
        let input = held(&[DriveKey::StepLeft, DriveKey::Hold]);
        assert_eq!((input.walk, input.hold), (Vec2::Y, true));
    }
}
