//! What a person can do with one key or one button. Which keys is said in [`super::keys`].

use bevy::input::ButtonState;
use bevy::input::keyboard::{Key, KeyboardInput};
use bevy::prelude::*;
use bevy_egui::{EguiContext, EguiContexts, EguiInput, EguiPreUpdateSet, PrimaryEguiContext, egui};

use super::FrameSystems;
use super::dialogues::Open;
use super::pilot_seat::Seat;
use super::state::{Overlay, Overlays, Pace, Screen};

pub(super) fn plugin(app: &mut App) {
    app.add_message::<Action>()
        .add_systems(
            PreUpdate,
            keep_tab_from_widgets
                .after(EguiPreUpdateSet::ProcessInput)
                .before(EguiPreUpdateSet::BeginPass)
                .run_if(in_state(Screen::Match)),
        )
        .add_systems(Update, (read_keys.in_set(FrameSystems::Keys), change_pace.in_set(FrameSystems::Input)));
}

/// What a person asks of the window.
#[derive(Message, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    PlayOrPause,
    OneTick,
    Faster,
    Slower,
    Restart,
    NextRobot,
    PreviousRobot,
    HandOver,
    Fit,
    /// Opens or closes the inspector.
    Inspector,
    /// Opens or closes the view of the whole world.
    World,
    Help,
    Escape,
    Leave,
    Switch(Overlay),
}

/// Tab goes to the next robot in a match, and not to the next button.
fn keep_tab_from_widgets(mut contexts: Query<(&mut EguiContext, &mut EguiInput), With<PrimaryEguiContext>>) {
    for (mut ctx, mut input) in &mut contexts {
        if !ctx.get_mut().egui_wants_keyboard_input() {
            input.0.events.retain(|event| !matches!(event, egui::Event::Key { key: egui::Key::Tab, .. }));
        }
    }
}

fn read_keys(
    mut contexts: EguiContexts,
    held: Res<ButtonInput<KeyCode>>,
    (open, seat): (Res<Open>, Seat),
    mut typed: MessageReader<KeyboardInput>,
    mut actions: MessageWriter<Action>,
) -> Result {
    use KeyCode::{AltLeft, ControlLeft, ControlRight, ShiftLeft, ShiftRight, SuperLeft, SuperRight};
    let elsewhere = contexts.ctx_mut()?.egui_wants_keyboard_input();
    let shift = held.any_pressed([ShiftLeft, ShiftRight]);
    let chord = held.any_pressed([ControlLeft, ControlRight, AltLeft, SuperLeft, SuperRight]);
    for key in typed.read().filter(|key| key.state == ButtonState::Pressed && !elsewhere && !chord) {
        if key.logical_key == Key::Space && seat.kicks() {
            // It kicks, and P pauses.
            continue;
        }
        let Some(action) = Action::of(key, shift) else { continue };
        let answers = matches!(action, Action::Escape | Action::Help);
        if (action.repeats() || !key.repeat) && (answers || open.question.is_none()) {
            actions.write(action);
        }
    }
    Ok(())
}

fn change_pace(mut actions: MessageReader<Action>, mut pace: ResMut<Pace>, mut overlays: ResMut<Overlays>) {
    for action in actions.read() {
        match *action {
            Action::PlayOrPause => pace.paused = !pace.paused,
            Action::OneTick => {
                pace.paused = true;
                pace.single_ticks += 1;
            }
            Action::Faster => pace.faster(),
            Action::Slower => pace.slower(),
            Action::Switch(overlay) => overlays.toggle(overlay),
            _ => {}
        }
    }
}
