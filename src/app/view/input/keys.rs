//! The keys: which place on the keyboard does what. The table here, with that of the overlays, is the only one: the keyboard, the
//! driven robot, the tooltips and the help page all read it.

use bevy::input::keyboard::{Key, KeyboardInput};
use bevy::prelude::*;

use KeyCode::{
    ArrowDown, ArrowLeft, ArrowRight, ArrowUp, Comma, Escape, F1, F12, Home, KeyA, KeyB, KeyC, KeyD, KeyE,
    KeyF, KeyH, KeyI, KeyJ, KeyK, KeyP, KeyQ, KeyR, KeyS, KeyW, KeyX, KeyY, KeyZ, Space, Tab,
};
use Press::{Chord, Place, Shifted, Sign};

use crate::app::view::state::{Action, Overlay, Press};

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deed {
    /// Once when it is pressed.
    Act(Action),
    /// While it is held.
    Drive(DriveKey),
}

/// What a person asks of the robot that they drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriveKey {
    /// Drive ahead.
    Ahead,
    /// Drive back.
    Back,
    /// Turn to the left.
    TurnLeft,
    /// Turn to the right.
    TurnRight,
    /// Step to the left.
    StepLeft,
    /// Step to the right.
    StepRight,
    /// Kick ahead.
    KickAhead,
    /// Kick to the left.
    KickLeft,
    /// Kick to the right.
    KickRight,
    /// Hold the ball.
    Hold,
}

/// A deed, what is pressed for it, and what it is in words.
#[derive(Clone, Copy, Debug)]
pub struct Binding {
    /// What is done.
    pub deed: Deed,
    /// The keys that do it.
    pub presses: &'static [Press],
    /// What it does, in words for people.
    pub does: &'static str,
}

const fn drive(drive: DriveKey, presses: &'static [Press], does: &'static str) -> Binding {
    Binding { deed: Deed::Drive(drive), presses, does }
}

const fn act(action: Action, presses: &'static [Press], does: &'static str) -> Binding {
    Binding { deed: Deed::Act(action), presses, does }
}

/// The keys before those of the overlays.
const FIRST: [Binding; 25] = [
    drive(DriveKey::Ahead, &[Place(KeyW), Place(ArrowUp)], "Drive ahead"),
    drive(DriveKey::Back, &[Place(KeyS), Place(ArrowDown)], "Drive back"),
    drive(DriveKey::TurnLeft, &[Place(KeyA), Place(ArrowLeft)], "Turn left"),
    drive(DriveKey::TurnRight, &[Place(KeyD), Place(ArrowRight)], "Turn right"),
    drive(DriveKey::StepLeft, &[Place(KeyQ)], "Step to the left (on four legs)"),
    drive(DriveKey::StepRight, &[Place(KeyE)], "Step to the right (on four legs)"),
    drive(DriveKey::KickAhead, &[Place(Space)], "Kick ahead, while you drive four legs"),
    drive(DriveKey::KickLeft, &[Place(KeyZ)], "Kick to the left (on four legs)"),
    drive(DriveKey::KickRight, &[Place(KeyX)], "Kick to the right (on four legs)"),
    drive(DriveKey::Hold, &[Place(KeyC)], "Hold the ball under the chin, while it is held"),
    act(Action::PlayOrPause, &[Place(Space), Place(KeyP)], "Pause, or play on"),
    act(Action::OneTick, &[Sign(".")], "One tick"),
    act(Action::TickBack, &[Place(Comma)], "One tick back"),
    act(Action::EventBack, &[Place(KeyJ)], "To what happened last: goals, calls, roles, bookings, bookmarks"),
    act(Action::EventAhead, &[Place(KeyK)], "To what happens next, as far as it is known"),
    act(Action::Bookmark, &[Place(KeyB)], "A bookmark here, or none any more"),
    act(Action::Why, &[Place(KeyY)], "Why it is so: what in the seconds before has led to this moment"),
    act(Action::Undo, &[Chord(KeyZ)], "Take back what you did last, and go back to before it"),
    act(Action::Faster, &[Sign("+"), Sign("=")], "Faster"),
    act(Action::Slower, &[Sign("-")], "Slower"),
    act(Action::Restart, &[Place(KeyR)], "Restart the match"),
    act(Action::NextRobot, &[Place(Tab)], "Next robot; your seat moves along"),
    act(Action::PreviousRobot, &[Shifted(Tab)], "Previous robot; your seat moves along"),
    act(Action::HandOver, &[Place(KeyH)], "Take the selected robot over, or hand it back"),
    act(Action::Fit, &[Place(KeyF), Place(Home)], "Fit the pitch into the window"),
];

/// The keys after them.
const LAST: [Binding; 6] = [
    act(
        Action::SaveScenario,
        &[],
        "Write this moment as a scenario, which `touchline check` reads and plays",
    ),
    act(Action::Inspector, &[Place(KeyI)], "The inspector: the inside of the selected robot"),
    act(Action::World, &[Place(F12)], "The whole world, entity by entity"),
    act(Action::Help, &[Place(F1), Sign("?")], "These keys"),
    act(Action::Escape, &[Place(Escape)], "Close what is open, or leave the match"),
    act(Action::Leave, &[], "Back to the menu"),
];

/// What the mouse does.
pub const MOUSE: [(&str, &str); 4] = [
    ("Click", "Select a robot"),
    ("Drag", "Move the pitch"),
    ("Shift+Drag", "Carry a robot or the ball elsewhere"),
    ("Wheel", "Zoom at the pointer"),
];

/// All keys, in the order of the help page.
pub fn bindings() -> impl Iterator<Item = Binding> {
    let overlay = |overlay: Overlay| act(Action::Switch(overlay), overlay.presses(), overlay.shows());
    FIRST.into_iter().chain(Overlay::ALL.into_iter().map(overlay)).chain(LAST)
}

impl Deed {
    fn binding(self) -> Option<Binding> {
        bindings().find(|binding| binding.deed == self)
    }

    /// What it is in words.
    pub fn does(self) -> &'static str {
        self.binding().map_or("", |binding| binding.does)
    }

    /// What is pressed for it.
    pub fn presses(self) -> &'static [Press] {
        self.binding().map_or(&[], |binding| binding.presses)
    }
}

impl Action {
    /// The action of a key that goes down.
    pub fn of(key: &KeyboardInput, shift: bool) -> Option<Action> {
        let asked_by = |is_pressed: &dyn Fn(&Press) -> bool| {
            bindings().find_map(|binding| match binding.deed {
                Deed::Act(action) if binding.presses.iter().any(is_pressed) => Some(action),
                _ => None,
            })
        };
        // A sign means itself, even on a place that means something else.
        asked_by(&|press| matches!((press, &key.logical_key), (Sign(sign), Key::Character(typed)) if typed.as_str() == *sign))
            .or_else(|| asked_by(&|press| shift && *press == Shifted(key.key_code)))
            .or_else(|| asked_by(&|press| *press == Place(key.key_code)))
    }

    /// Whether holding the key goes on doing it.
    pub fn repeats(self) -> bool {
        matches!(self, Action::OneTick | Action::TickBack | Action::Faster | Action::Slower)
    }
}

impl DriveKey {
    /// Whether one of its keys is held.
    pub fn is_held(self, held: &ButtonInput<KeyCode>) -> bool {
        Deed::Drive(self).presses().iter().any(|press| matches!(press, Place(place) if held.pressed(*place)))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use KeyCode::{Digit3, KeyM};
    use bevy::input::ButtonState;

    use super::super::keyboard::Keyboard;
    use super::*;

    pub fn key(place: KeyCode, writes: Key) -> KeyboardInput {
        KeyboardInput {
            key_code: place,
            logical_key: writes,
            state: ButtonState::Pressed,
            text: None,
            repeat: false,
            window: Entity::PLACEHOLDER,
        }
    }

    pub fn letter(place: KeyCode, writes: &str) -> KeyboardInput {
        key(place, Key::Character(writes.into()))
    }

    #[test]
    fn a_letter_is_a_place_and_a_sign_is_what_is_written() {
        // On a French keyboard.
        assert_eq!(Action::of(&letter(KeyM, ","), false), Some(Action::Switch(Overlay::Radio)));
        assert_eq!(Action::of(&letter(KeyM, "?"), true), Some(Action::Help));
        assert_eq!(Action::of(&letter(KeyCode::Semicolon, "m"), false), None);
        assert_eq!(Action::of(&letter(Digit3, "\""), false), Some(Action::Switch(Overlay::Beliefs)));
        // On a German one.
        assert_eq!(Action::of(&letter(KeyCode::Slash, "-"), false), Some(Action::Slower));
        assert_eq!(Action::of(&letter(KeyCode::BracketRight, "+"), false), Some(Action::Faster));
        // On a US one, with caps lock and without Shift.
        assert_eq!(Action::of(&letter(KeyR, "R"), false), Some(Action::Restart));
        assert_eq!(Action::of(&letter(KeyCode::Equal, "="), false), Some(Action::Faster));
        assert_eq!(Action::of(&letter(KeyQ, "q"), false), None);
    }

    #[test]
    fn shift_turns_tab_round() {
        let tab = key(Tab, Key::Tab);
        assert_eq!(Action::of(&tab, true), Some(Action::PreviousRobot));
        assert_eq!(Action::of(&tab, false), Some(Action::NextRobot));
    }

    #[test]
    fn letters_and_arrows_drive_alike() {
        let mut held = ButtonInput::<KeyCode>::default();
        held.press(KeyW);
        held.press(ArrowRight);
        let all = [DriveKey::Ahead, DriveKey::Back, DriveKey::TurnLeft, DriveKey::TurnRight];
        assert_eq!(all.map(|drive| drive.is_held(&held)), [true, false, false, true]);
    }

    #[test]
    fn no_key_does_two_things_but_space() {
        let all: Vec<_> = bindings().flat_map(|binding| binding.presses).collect();
        for press in &all {
            let uses = all.iter().filter(|other| *other == press).count();
            assert_eq!(uses, if **press == Place(Space) { 2 } else { 1 }, "{press:?}");
        }
    }

    #[test]
    fn the_page_on_playing_has_this_table() {
        let keyboard = Keyboard::default();
        let keys = bindings().map(|binding| (keyboard.keys(binding.deed), binding.does));
        let keys = keys.filter(|(keys, _)| !keys.is_empty());
        let mouse = MOUSE.into_iter().map(|(keys, does)| (keys.to_owned(), does));
        let rows: String = keys.chain(mouse).map(|(keys, does)| format!("| {keys} | {does} |\n")).collect();
        let page = include_str!("../../../../docs/playing.md");
        assert!(page.contains(&format!("\n|---|---|\n{rows}\n")), "docs/playing.md has to say:\n{rows}");
    }
}
