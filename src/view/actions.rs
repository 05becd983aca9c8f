//! What a person can do with one key or one button. The table of keys here is the only one: the keyboard, the tooltips and
//! the help page all read it.

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
    Help,
    Escape,
    Leave,
    Switch(Overlay),
}

/// A key, what it is called and what it does.
pub struct Binding {
    /// As people call it.
    pub keys: &'static str,
    pub does: &'static str,
    pub action: Action,
}

const fn bind(keys: &'static str, does: &'static str, action: Action) -> Binding {
    Binding { keys, does, action }
}

/// All keys but those that drive.
pub const BINDINGS: [Binding; 20] = [
    bind("Space or P", "Pause, or play on", Action::PlayOrPause),
    bind(".", "One tick", Action::OneTick),
    bind("+", "Faster", Action::Faster),
    bind("-", "Slower", Action::Slower),
    bind("R", "Restart the match", Action::Restart),
    bind("Tab", "Next robot", Action::NextRobot),
    bind("Shift+Tab", "Previous robot", Action::PreviousRobot),
    bind("H", "Take the selected robot over, or hand it back", Action::HandOver),
    bind("F or Home", "Fit the pitch into the window", Action::Fit),
    bind("1", "Motor-schema vectors", Action::Switch(Overlay::Vectors)),
    bind("2", "Field of view", Action::Switch(Overlay::FieldOfView)),
    bind("3", "Sensed and believed", Action::Switch(Overlay::Beliefs)),
    bind("4", "Danger zone and homebase", Action::Switch(Overlay::Zones)),
    bind("5", "Roles and activities", Action::Switch(Overlay::Labels)),
    bind("6", "Teamwork: claims, supports, locks and messages", Action::Switch(Overlay::Teamwork)),
    bind("M", "The radio: messages, bookings, interference", Action::Switch(Overlay::Radio)),
    bind("N", "Team communication, and the referee box", Action::Switch(Overlay::Communication)),
    bind("F1 or ?", "These keys", Action::Help),
    bind("Escape", "Close what is open, or leave the match", Action::Escape),
    bind("Escape", "Back to the menu", Action::Leave),
];

impl Action {
    /// What a control says about itself: what it does, and its key.
    pub fn tooltip(self) -> String {
        let binding = BINDINGS.iter().find(|binding| binding.action == self);
        binding.map_or_else(String::new, |binding| format!("{} ({})", binding.does, binding.keys))
    }

    /// The action of a key, and whether holding it repeats the action.
    fn of(key: &Key, shift: bool) -> Option<(Action, bool)> {
        let once = |action| Some((action, false));
        match key {
            Key::Space => once(Action::PlayOrPause),
            Key::Tab => once(if shift { Action::PreviousRobot } else { Action::NextRobot }),
            Key::Home => once(Action::Fit),
            Key::F1 => once(Action::Help),
            Key::Escape => once(Action::Escape),
            Key::Character(typed) => match typed.to_lowercase().as_str() {
                "p" => once(Action::PlayOrPause),
                "." => Some((Action::OneTick, true)),
                "+" | "=" => Some((Action::Faster, true)),
                "-" => Some((Action::Slower, true)),
                "r" => once(Action::Restart),
                "h" => once(Action::HandOver),
                "f" => once(Action::Fit),
                "?" => once(Action::Help),
                "1" => once(Action::Switch(Overlay::Vectors)),
                "2" => once(Action::Switch(Overlay::FieldOfView)),
                "3" => once(Action::Switch(Overlay::Beliefs)),
                "4" => once(Action::Switch(Overlay::Zones)),
                "5" => once(Action::Switch(Overlay::Labels)),
                "6" => once(Action::Switch(Overlay::Teamwork)),
                "m" => once(Action::Switch(Overlay::Radio)),
                "n" => once(Action::Switch(Overlay::Communication)),
                _ => None,
            },
            _ => None,
        }
    }
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
        let Some((action, repeats)) = Action::of(&key.logical_key, shift) else { continue };
        let answers = matches!(action, Action::Escape | Action::Help);
        if (repeats || !key.repeat) && (answers || open.question.is_none()) {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn action(typed: &str) -> Option<Action> {
        Action::of(&Key::Character(typed.into()), false).map(|(action, _)| action)
    }

    #[test]
    fn letters_work_with_caps_lock_and_plus_without_shift() {
        assert_eq!(action("R"), Some(Action::Restart));
        assert_eq!(action("="), Some(Action::Faster));
        assert_eq!(action("q"), None);
    }

    #[test]
    fn shift_turns_tab_round() {
        assert_eq!(Action::of(&Key::Tab, true), Some((Action::PreviousRobot, false)));
        assert_eq!(Action::of(&Key::Tab, false), Some((Action::NextRobot, false)));
    }

    #[test]
    fn a_tooltip_names_its_key() {
        assert_eq!(Action::PlayOrPause.tooltip(), "Pause, or play on (Space or P)");
        assert_eq!(Action::Switch(Overlay::Beliefs).tooltip(), "Sensed and believed (3)");
        assert!(BINDINGS.iter().all(|binding| binding.action.tooltip().contains(binding.keys)));
    }
}
