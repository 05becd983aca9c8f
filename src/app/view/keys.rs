//! The keys: which place on the keyboard does what, and what this person's keyboard calls that place. The table here is the only
//! one: the keyboard, the driver's seat, the tooltips and the help page all read it.

use std::collections::BTreeMap;

use bevy::input::ButtonState;
use bevy::input::keyboard::{Key, KeyboardInput};
use bevy::prelude::*;

use super::actions::Action;
use super::state::Overlay;

use KeyCode::{
    ArrowDown, ArrowLeft, ArrowRight, ArrowUp, Digit1, Digit2, Digit3, Digit4, Digit5, Digit6, Escape, F1,
    F12, Home, KeyA, KeyC, KeyD, KeyE, KeyF, KeyH, KeyI, KeyM, KeyN, KeyP, KeyQ, KeyR, KeyS, KeyW, KeyX,
    KeyZ, Space, Tab,
};
use Press::{Place, Shifted, Sign};

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deed {
    /// Once when it is pressed.
    Act(Action),
    /// While it is held.
    Drive(Drive),
}

/// What a person asks of the robot that they drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    Ahead,
    Back,
    TurnLeft,
    TurnRight,
    StepLeft,
    StepRight,
    KickAhead,
    KickLeft,
    KickRight,
    Hold,
}

/// What is pressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Press {
    /// A place on the keyboard, whatever the layout writes there.
    Place(KeyCode),
    /// A place together with Shift.
    Shifted(KeyCode),
    /// A sign, wherever the layout has it.
    Sign(&'static str),
}

/// A deed, what is pressed for it, and what it is in words.
#[derive(Clone, Copy, Debug)]
pub struct Binding {
    pub deed: Deed,
    pub presses: &'static [Press],
    pub does: &'static str,
}

const fn drive(drive: Drive, presses: &'static [Press], does: &'static str) -> Binding {
    Binding { deed: Deed::Drive(drive), presses, does }
}

const fn act(action: Action, presses: &'static [Press], does: &'static str) -> Binding {
    Binding { deed: Deed::Act(action), presses, does }
}

/// All keys.
pub const BINDINGS: [Binding; 32] = [
    drive(Drive::Ahead, &[Place(KeyW), Place(ArrowUp)], "Drive ahead"),
    drive(Drive::Back, &[Place(KeyS), Place(ArrowDown)], "Drive back"),
    drive(Drive::TurnLeft, &[Place(KeyA), Place(ArrowLeft)], "Turn left"),
    drive(Drive::TurnRight, &[Place(KeyD), Place(ArrowRight)], "Turn right"),
    drive(Drive::StepLeft, &[Place(KeyQ)], "Step to the left (on four legs)"),
    drive(Drive::StepRight, &[Place(KeyE)], "Step to the right (on four legs)"),
    drive(Drive::KickAhead, &[Place(Space)], "Kick ahead, while you drive four legs"),
    drive(Drive::KickLeft, &[Place(KeyZ)], "Kick to the left (on four legs)"),
    drive(Drive::KickRight, &[Place(KeyX)], "Kick to the right (on four legs)"),
    drive(Drive::Hold, &[Place(KeyC)], "Hold the ball under the chin, while it is held"),
    act(Action::PlayOrPause, &[Place(Space), Place(KeyP)], "Pause, or play on"),
    act(Action::OneTick, &[Sign(".")], "One tick"),
    act(Action::Faster, &[Sign("+"), Sign("=")], "Faster"),
    act(Action::Slower, &[Sign("-")], "Slower"),
    act(Action::Restart, &[Place(KeyR)], "Restart the match"),
    act(Action::NextRobot, &[Place(Tab)], "Next robot"),
    act(Action::PreviousRobot, &[Shifted(Tab)], "Previous robot"),
    act(Action::HandOver, &[Place(KeyH)], "Take the selected robot over, or hand it back"),
    act(Action::Fit, &[Place(KeyF), Place(Home)], "Fit the pitch into the window"),
    act(Action::Switch(Overlay::Vectors), &[Place(Digit1)], "Motor-schema vectors"),
    act(Action::Switch(Overlay::FieldOfView), &[Place(Digit2)], "Field of view"),
    act(Action::Switch(Overlay::Beliefs), &[Place(Digit3)], "Sensed and believed"),
    act(Action::Switch(Overlay::Zones), &[Place(Digit4)], "Danger zone and homebase"),
    act(Action::Switch(Overlay::Labels), &[Place(Digit5)], "Roles and activities"),
    act(
        Action::Switch(Overlay::Teamwork),
        &[Place(Digit6)],
        "Teamwork: claims, supports, locks and messages",
    ),
    act(Action::Switch(Overlay::Radio), &[Place(KeyM)], "The radio: messages, bookings, interference"),
    act(Action::Switch(Overlay::Communication), &[Place(KeyN)], "Team communication, and the referee box"),
    act(Action::Inspector, &[Place(KeyI)], "The inspector: the inside of the selected robot"),
    act(Action::World, &[Place(F12)], "The whole world, entity by entity"),
    act(Action::Help, &[Place(F1), Sign("?")], "These keys"),
    act(Action::Escape, &[Place(Escape)], "Close what is open, or leave the match"),
    act(Action::Leave, &[], "Back to the menu"),
];

impl Deed {
    fn binding(self) -> Option<&'static Binding> {
        BINDINGS.iter().find(|binding| binding.deed == self)
    }

    /// What it is in words.
    pub fn does(self) -> &'static str {
        self.binding().map_or("", |binding| binding.does)
    }

    fn presses(self) -> &'static [Press] {
        self.binding().map_or(&[], |binding| binding.presses)
    }
}

impl Action {
    /// The action of a key that goes down.
    pub fn of(key: &KeyboardInput, shift: bool) -> Option<Action> {
        let asked_by = |is_pressed: &dyn Fn(&Press) -> bool| {
            BINDINGS.iter().find_map(|binding| match binding.deed {
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
        matches!(self, Action::OneTick | Action::Faster | Action::Slower)
    }
}

impl Drive {
    /// Whether one of its keys is held.
    pub fn is_held(self, held: &ButtonInput<KeyCode>) -> bool {
        Deed::Drive(self).presses().iter().any(|press| matches!(press, Place(place) if held.pressed(*place)))
    }
}

/// What this person's keyboard writes at the places of letters, as far as it has been seen. Until then a place is called as on a
/// US keyboard.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct Keyboard {
    written: BTreeMap<KeyCode, String>,
}

impl Keyboard {
    /// Takes note of what a key has written that was pressed without others.
    fn learn(&mut self, key: &KeyboardInput) {
        let written = match &key.logical_key {
            Key::Character(typed) => typed.to_uppercase(),
            Key::Dead(Some(accent)) => accent.to_string(),
            _ => return,
        };
        if us_name(key.key_code).len() == 1 && !is_digit(key.key_code) {
            self.written.insert(key.key_code, written);
        }
    }

    /// What a place is called.
    pub fn name(&self, place: KeyCode) -> String {
        self.written.get(&place).cloned().unwrap_or_else(|| us_name(place))
    }

    fn press(&self, press: Press) -> String {
        match press {
            Place(place) => self.name(place),
            Shifted(place) => format!("Shift+{}", self.name(place)),
            Sign(sign) => sign.to_owned(),
        }
    }

    /// The first key of a deed.
    pub fn key(&self, deed: Deed) -> String {
        deed.presses().first().map_or_else(String::new, |press| self.press(*press))
    }

    /// All keys of a deed.
    pub fn keys(&self, deed: Deed) -> String {
        let keys: Vec<String> = deed.presses().iter().map(|press| self.press(*press)).collect();
        keys.join(" or ")
    }

    /// The keys that drive.
    pub fn driving_keys(&self) -> String {
        let letters = [Drive::Ahead, Drive::TurnLeft, Drive::Back, Drive::TurnRight];
        let letters = letters.map(|drive| self.key(Deed::Drive(drive))).join(" ");
        format!("{letters} or the arrow keys")
    }

    /// What a control says about itself: what it does, and its keys.
    pub fn tip(&self, action: Action) -> String {
        let deed = Deed::Act(action);
        self.tip_that_says(deed.does(), action)
    }

    /// The same in other words.
    pub fn tip_that_says(&self, words: &str, action: Action) -> String {
        match self.keys(Deed::Act(action)) {
            keys if keys.is_empty() => words.to_owned(),
            keys => format!("{words} ({keys})"),
        }
    }
}

/// What a place is called on a US keyboard.
fn us_name(place: KeyCode) -> String {
    let name = format!("{place:?}");
    let short = ["Key", "Digit", "Arrow"].into_iter().find_map(|kind| name.strip_prefix(kind));
    short.map(str::to_owned).unwrap_or(name)
}

/// Digits are printed on their places wherever Latin is written, although some layouts write them with Shift only.
fn is_digit(place: KeyCode) -> bool {
    us_name(place).starts_with(|first: char| first.is_ascii_digit())
}

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Keyboard>().add_systems(PreUpdate, learn_layout.after(bevy::input::InputSystems));
}

fn learn_layout(
    mut typed: MessageReader<KeyboardInput>,
    held: Res<ButtonInput<KeyCode>>,
    mut keyboard: ResMut<Keyboard>,
) {
    let mut seen = keyboard.clone();
    for key in typed.read().filter(|key| key.state == ButtonState::Pressed && !with_others(&held)) {
        seen.learn(key);
    }
    keyboard.set_if_neq(seen);
}

fn with_others(held: &ButtonInput<KeyCode>) -> bool {
    use KeyCode::{
        AltLeft, AltRight, ControlLeft, ControlRight, ShiftLeft, ShiftRight, SuperLeft, SuperRight,
    };
    held.any_pressed([
        ShiftLeft,
        ShiftRight,
        ControlLeft,
        ControlRight,
        AltLeft,
        AltRight,
        SuperLeft,
        SuperRight,
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(place: KeyCode, writes: Key) -> KeyboardInput {
        KeyboardInput {
            key_code: place,
            logical_key: writes,
            state: ButtonState::Pressed,
            text: None,
            repeat: false,
            window: Entity::PLACEHOLDER,
        }
    }

    fn letter(place: KeyCode, writes: &str) -> KeyboardInput {
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
        let all = [Drive::Ahead, Drive::Back, Drive::TurnLeft, Drive::TurnRight];
        assert_eq!(all.map(|drive| drive.is_held(&held)), [true, false, false, true]);
    }

    #[test]
    fn labels_follow_the_layout_once_a_key_has_been_seen() {
        let mut keyboard = Keyboard::default();
        assert_eq!(keyboard.driving_keys(), "W A S D or the arrow keys");
        for (place, writes) in [(KeyW, "z"), (KeyA, "q"), (KeyM, ","), (Digit1, "&"), (KeyCode::Period, ":")]
        {
            keyboard.learn(&letter(place, writes));
        }
        assert_eq!(keyboard.driving_keys(), "Z Q S D or the arrow keys");
        assert_eq!(keyboard.keys(Deed::Drive(Drive::Ahead)), "Z or Up");
        assert_eq!(keyboard.key(Deed::Act(Action::Switch(Overlay::Radio))), ",");
        assert_eq!(keyboard.key(Deed::Act(Action::Switch(Overlay::Vectors))), "1");
        assert_eq!(keyboard.tip(Action::OneTick), "One tick (.)");
    }

    #[test]
    fn a_key_pressed_with_shift_teaches_nothing() {
        let mut app = App::new();
        app.add_plugins((MinimalPlugins, bevy::input::InputPlugin, plugin));
        app.world_mut().write_message(key(KeyCode::ShiftLeft, Key::Shift));
        app.world_mut().write_message(letter(KeyM, "?"));
        app.update();
        assert_eq!(*app.world().resource::<Keyboard>(), Keyboard::default());
        let release = KeyboardInput { state: ButtonState::Released, ..key(KeyCode::ShiftLeft, Key::Shift) };
        app.world_mut().write_message(release);
        app.world_mut().write_message(letter(KeyM, ","));
        app.update();
        assert_eq!(app.world().resource::<Keyboard>().name(KeyM), ",");
    }

    #[test]
    fn a_tip_names_its_keys() {
        let keyboard = Keyboard::default();
        assert_eq!(keyboard.tip(Action::PlayOrPause), "Pause, or play on (Space or P)");
        assert_eq!(keyboard.tip(Action::PreviousRobot), "Previous robot (Shift+Tab)");
        assert_eq!(keyboard.tip(Action::Leave), "Back to the menu");
    }

    #[test]
    fn no_key_does_two_things_but_space() {
        let all: Vec<_> = BINDINGS.iter().flat_map(|binding| binding.presses).collect();
        for press in &all {
            let uses = all.iter().filter(|other| *other == press).count();
            assert_eq!(uses, if **press == Place(Space) { 2 } else { 1 }, "{press:?}");
        }
    }

    #[test]
    fn the_page_on_playing_names_every_key() {
        let text = include_str!("../../../docs/playing.md");
        let keys =
            text.split("\n## ").find(|section| section.starts_with("Keys")).expect("a section on keys");
        let rows: String = keys.lines().filter_map(|line| line.strip_prefix("| ")).collect();
        let named = rows.replace([',', '`', '|'], " ");
        for binding in &BINDINGS {
            for press in binding.presses {
                let key = Keyboard::default().press(*press);
                let known = match press {
                    Place(ArrowUp | ArrowDown | ArrowLeft | ArrowRight) => named.contains("arrows"),
                    Place(place) if is_digit(*place) => named.contains("1 to 6"),
                    _ => named.split_whitespace().any(|name| name == key),
                };
                assert!(known, "{key}: {}", binding.does);
            }
        }
    }
}
