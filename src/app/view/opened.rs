//! What a person has opened: remembered apart for watching and for playing, since a player needs to see little besides the match.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::FrameSystems;
use super::actions::Action;
use super::state::{Overlay, Overlays, Piloted};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Inspector>()
        .init_resource::<Remembered>()
        .add_systems(Update, (open_inspector.in_set(FrameSystems::Input), follow.in_set(FrameSystems::Time)));
}

/// What of the inspector is open.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inspector {
    /// The panel.
    pub open: bool,
    /// The view of the whole world.
    pub world: bool,
}

impl Default for Inspector {
    fn default() -> Inspector {
        Inspector { open: true, world: false }
    }
}

/// Overlays and panels that are open together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Opened {
    pub overlays: Overlays,
    pub inspector: bool,
}

/// What is open while a person watches, and while they drive a robot.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Remembered {
    pub watching: Opened,
    pub playing: Opened,
    /// Which of them is shown.
    plays: bool,
}

impl Default for Remembered {
    fn default() -> Remembered {
        Remembered {
            watching: Opened { overlays: Overlays::default(), inspector: true },
            playing: Opened { overlays: Overlays::only([Overlay::Labels]), inspector: false },
            plays: false,
        }
    }
}

impl Remembered {
    pub fn new(watching: Opened, playing: Opened) -> Remembered {
        Remembered { watching, playing, plays: false }
    }

    fn shown(&mut self) -> &mut Opened {
        if self.plays { &mut self.playing } else { &mut self.watching }
    }

    /// Takes note of what is open, unless the person has just begun or ceased to play: then what to open.
    fn follow(&mut self, open: Opened, plays: bool) -> Option<Opened> {
        if self.plays == plays {
            *self.shown() = open;
            return None;
        }
        self.plays = plays;
        Some(*self.shown()).filter(|wanted| *wanted != open)
    }
}

fn open_inspector(mut actions: MessageReader<Action>, mut inspector: ResMut<Inspector>) {
    for action in actions.read() {
        match action {
            Action::Inspector => inspector.open = !inspector.open,
            Action::World => inspector.world = !inspector.world,
            _ => {}
        }
    }
}

fn follow(
    piloted: Res<Piloted>,
    mut remembered: ResMut<Remembered>,
    (mut overlays, mut inspector): (ResMut<Overlays>, ResMut<Inspector>),
) {
    let mut known = *remembered;
    let open = Opened { overlays: *overlays, inspector: inspector.open };
    if let Some(wanted) = known.follow(open, piloted.0.is_some()) {
        *overlays = wanted.overlays;
        inspector.open = wanted.inspector;
    }
    remembered.set_if_neq(known);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_player_sees_little_until_more_is_asked_for_and_a_watcher_what_was_open_before() {
        let mut remembered = Remembered::default();
        let watching = remembered.watching;
        let playing = remembered.follow(watching, true).expect("a player sees less");
        assert_eq!(playing, Opened { overlays: Overlays::only([Overlay::Labels]), inspector: false });
        let asked = Opened { overlays: Overlays::only([Overlay::Labels, Overlay::Vectors]), inspector: true };
        assert_eq!(remembered.follow(asked, true), None);
        assert_eq!(remembered.follow(asked, false), Some(watching));
        assert_eq!(remembered.follow(watching, true), Some(asked));
    }
}
