//! What is drawn on top of the pitch, and the panels below it: one table of what there is, and which of them are on.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

/// What is pressed for something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Press {
    /// A place on the keyboard, whatever the layout writes there.
    Place(KeyCode),
    /// A place together with Shift.
    Shifted(KeyCode),
    /// A sign, wherever the layout has it.
    Sign(&'static str),
    /// A place together with Ctrl, which panels may want for themselves.
    Chord(KeyCode),
}

macro_rules! overlays {
    ($($overlay:ident $key:ident $title:literal $shows:literal;)*) => {
        /// One of the [`Overlays`].
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        pub enum Overlay {
            $(#[doc = $shows] $overlay,)*
        }

        impl Overlay {
            /// All of them, in the order of their buttons.
            pub const ALL: [Overlay; [$(Overlay::$overlay),*].len()] = [$(Overlay::$overlay),*];

            /// What it is called on its button.
            pub const fn title(self) -> &'static str {
                match self { $(Overlay::$overlay => $title),* }
            }

            /// What it shows.
            pub const fn shows(self) -> &'static str {
                match self { $(Overlay::$overlay => $shows),* }
            }

            /// What is pressed for it.
            pub const fn presses(self) -> &'static [Press] {
                match self { $(Overlay::$overlay => &[Press::Place(KeyCode::$key)]),* }
            }
        }
    };
}

overlays! {
    Vectors       Digit1 "Vectors"  "Motor-schema vectors";
    FieldOfView   Digit2 "View"     "Field of view";
    Beliefs       Digit3 "Beliefs"  "Sensed and believed";
    Zones         Digit4 "Zones"    "Danger zone and homebase";
    Labels        Digit5 "Labels"   "Roles and activities";
    Teamwork      Digit6 "Teamwork" "Teamwork: claims, supports, locks and messages";
    Radio         KeyM   "Radio"    "The radio: messages, bookings, interference";
    Communication KeyN   "Comms"    "Team communication, and the referee box";
    States        KeyG   "States"   "The state machine of the selected robot: where it is, how it came there, when it goes on";
    Camera        KeyV   "Camera"   "The camera of the selected robot, and its calibration";
}

impl Overlay {
    /// Whether it is a panel below the pitch, where there is room for one.
    fn is_panel(self) -> bool {
        matches!(self, Overlay::Radio | Overlay::Communication | Overlay::States | Overlay::Camera)
    }
}

/// Which overlays are on.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "Vec<Overlay>", into = "Vec<Overlay>")]
pub struct Overlays([bool; Overlay::ALL.len()]);

impl From<Vec<Overlay>> for Overlays {
    fn from(on: Vec<Overlay>) -> Overlays {
        Overlays::only(on)
    }
}

impl From<Overlays> for Vec<Overlay> {
    fn from(overlays: Overlays) -> Vec<Overlay> {
        Overlay::ALL.into_iter().filter(|overlay| overlays.shows(*overlay)).collect()
    }
}

impl Overlays {
    /// These and no others; of the panels below the pitch the last.
    pub fn only(on: impl IntoIterator<Item = Overlay>) -> Overlays {
        let mut overlays = Overlays([false; _]);
        for overlay in on {
            overlays.set(overlay, true);
        }
        overlays
    }

    /// Whether an overlay is shown.
    pub fn shows(&self, overlay: Overlay) -> bool {
        self.0[overlay as usize]
    }

    /// Switches one of them on or off. Of the panels below the pitch only one is open.
    pub fn set(&mut self, overlay: Overlay, on: bool) {
        if on && overlay.is_panel() {
            Overlay::ALL
                .into_iter()
                .filter(|other| other.is_panel())
                .for_each(|other| self.0[other as usize] = false);
        }
        self.0[overlay as usize] = on;
    }

    /// Shows an overlay, or hides it.
    pub fn toggle(&mut self, overlay: Overlay) {
        self.set(overlay, !self.shows(overlay));
    }
}

impl Default for Overlays {
    fn default() -> Overlays {
        use Overlay::{Beliefs, FieldOfView, Labels, Teamwork, Vectors};
        Overlays::only([Vectors, FieldOfView, Beliefs, Labels, Teamwork])
    }
}

/// Whether an overlay is on, as a condition of a system.
pub fn shows(overlay: Overlay) -> impl FnMut(Res<Overlays>) -> bool + Clone {
    move |overlays| overlays.shows(overlay)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_panel_below_the_pitch_takes_the_place_of_the_other() {
        let mut overlays = Overlays::default();
        overlays.toggle(Overlay::Radio);
        overlays.toggle(Overlay::Communication);
        assert!(overlays.shows(Overlay::Communication) && !overlays.shows(Overlay::Radio));
        overlays.toggle(Overlay::Communication);
        assert_eq!(overlays, Overlays::default());
    }

    #[test]
    fn every_overlay_has_its_own_switch() {
        for overlay in Overlay::ALL {
            let on: Vec<Overlay> = Overlays::only([overlay]).into();
            assert_eq!(on, [overlay]);
        }
    }
}
