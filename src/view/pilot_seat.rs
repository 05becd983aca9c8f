//! A person's hands: the keys that drive become requests, and a robot is taken over or handed back.

use bevy::prelude::*;
use bevy_egui::EguiContexts;

use super::FrameSystems;
use super::actions::Action;
use super::dialogues::Open;
use super::state::{Piloted, Selected};
use crate::ids::RobotId;
use crate::pilot::Pilot;
use crate::script::{Request, Requests};

pub(super) fn plugin(app: &mut App) {
    app.add_systems(Update, (change_seat, steer).chain().in_set(FrameSystems::Input));
}

/// What the driving keys are called.
pub const DRIVING_KEYS: [(&str, &str); 2] =
    [("W S or Up Down", "Drive ahead or back"), ("A D or Left Right", "Turn left or right")];

/// What the controls say while these keys are down.
fn controls(down: impl Fn([KeyCode; 2]) -> bool) -> Pilot {
    use KeyCode::{ArrowDown, ArrowLeft, ArrowRight, ArrowUp, KeyA, KeyD, KeyS, KeyW};
    let lever = |plus, minus| f32::from(u8::from(down(plus))) - f32::from(u8::from(down(minus)));
    Pilot {
        throttle: lever([KeyW, ArrowUp], [KeyS, ArrowDown]),
        turn: lever([KeyA, ArrowLeft], [KeyD, ArrowRight]),
    }
}

fn change_seat(
    mut actions: MessageReader<Action>,
    mut piloted: ResMut<Piloted>,
    selected: Res<Selected>,
    mut requests: ResMut<Requests>,
) {
    for _ in actions.read().filter(|action| **action == Action::HandOver) {
        match (piloted.0.take(), selected.0) {
            (Some(seat), _) => requests.ask(Request::HandBack(seat)),
            (None, Some(robot)) => {
                requests.ask(Request::TakeOver(robot));
                piloted.0 = Some(robot);
            }
            (None, None) => {}
        }
    }
}

fn steer(
    mut contexts: EguiContexts,
    held: Res<ButtonInput<KeyCode>>,
    (piloted, open): (Res<Piloted>, Res<Open>),
    mut requests: ResMut<Requests>,
    mut last: Local<Option<(RobotId, Pilot)>>,
) -> Result {
    let elsewhere = contexts.ctx_mut()?.egui_wants_keyboard_input() || open.question.is_some();
    let now = piloted.0.map(|robot| (robot, controls(|keys| !elsewhere && held.any_pressed(keys))));
    if let Some((robot, pilot)) = now.filter(|now| piloted.is_changed() || Some(*now) != *last) {
        requests.ask(Request::Steer { robot, pilot });
    }
    *last = now;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pressed(keys: &[KeyCode]) -> Pilot {
        controls(|wanted| wanted.iter().any(|key| keys.contains(key)))
    }

    #[test]
    fn letters_and_arrows_drive_alike() {
        assert_eq!(pressed(&[KeyCode::KeyW, KeyCode::KeyA]), Pilot { throttle: 1.0, turn: 1.0 });
        assert_eq!(pressed(&[KeyCode::ArrowDown, KeyCode::ArrowRight]), Pilot { throttle: -1.0, turn: -1.0 });
    }

    #[test]
    fn opposite_keys_cancel() {
        assert_eq!(pressed(&[KeyCode::KeyW, KeyCode::KeyS]), Pilot::default());
        assert_eq!(pressed(&[]), Pilot::default());
    }
}
