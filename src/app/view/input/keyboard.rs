//! What this person's keyboard calls its keys, and what the controls say of them.

use std::collections::BTreeMap;

use bevy::input::ButtonState;
use bevy::input::keyboard::{Key, KeyboardInput};
use bevy::prelude::*;

use super::keys::{Deed, DriveKey};
use crate::app::view::state::{Action, Press};

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
            Press::Place(place) => self.name(place),
            Press::Shifted(place) => format!("Shift+{}", self.name(place)),
            Press::Sign(sign) => sign.to_owned(),
            Press::Chord(place) => format!("Ctrl+{}", self.name(place)),
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
        let letters = [DriveKey::Ahead, DriveKey::TurnLeft, DriveKey::Back, DriveKey::TurnRight];
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
    if place == KeyCode::Comma {
        return ",".into();
    }
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
    use KeyCode::{Digit1, KeyA, KeyM, KeyW};

    use super::super::keys::tests::{key, letter};
    use super::*;
    use crate::app::view::state::Overlay;

    #[test]
    fn labels_follow_the_layout_once_a_key_has_been_seen() {
        let mut keyboard = Keyboard::default();
        assert_eq!(keyboard.driving_keys(), "W A S D or the arrow keys");
        for (place, writes) in [(KeyW, "z"), (KeyA, "q"), (KeyM, ","), (Digit1, "&"), (KeyCode::Period, ":")]
        {
            keyboard.learn(&letter(place, writes));
        }
        assert_eq!(keyboard.driving_keys(), "Z Q S D or the arrow keys");
        assert_eq!(keyboard.keys(Deed::Drive(DriveKey::Ahead)), "Z or Up");
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
        assert_eq!(keyboard.tip(Action::PreviousRobot), "Previous robot; your seat moves along (Shift+Tab)");
        assert_eq!(keyboard.tip(Action::Leave), "Back to the menu");
    }
}
