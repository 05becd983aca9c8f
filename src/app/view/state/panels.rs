//! What is open: dialogues over the pitch, and panels, which are remembered apart for watching and for playing, since a player
//! needs to see little besides the match.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::overlays::{Overlay, Overlays};

/// What lies over the pitch.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OpenDialogues {
    /// The question that waits for an answer.
    pub question: Option<Question>,
    /// Whether the help is open.
    pub help: bool,
    /// The final score.
    pub result: bool,
}

/// What is asked before it is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// Whether to play from the beginning.
    Restart,
    /// Whether to leave the match.
    Leave,
}

impl OpenDialogues {
    /// Closes the uppermost thing; whether there was one.
    pub fn close_one(&mut self) -> bool {
        let open = [self.question.take().is_some(), self.help, self.result];
        match open {
            [true, ..] => true,
            [_, true, _] => std::mem::take(&mut self.help),
            [.., result] => {
                self.result = false;
                result
            }
        }
    }
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
pub struct OpenPanels {
    /// The overlays.
    pub overlays: Overlays,
    /// Whether the inspector is open.
    pub inspector: bool,
}

/// What is open while a person watches, and while they drive a robot.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq)]
pub struct RememberedPanels {
    /// While nobody drives.
    pub watching: OpenPanels,
    /// While the person drives.
    pub playing: OpenPanels,
    /// Which of them is shown.
    plays: bool,
}

impl Default for RememberedPanels {
    fn default() -> RememberedPanels {
        RememberedPanels {
            watching: OpenPanels { overlays: Overlays::default(), inspector: true },
            playing: OpenPanels { overlays: Overlays::only([Overlay::Labels]), inspector: false },
            plays: false,
        }
    }
}

impl RememberedPanels {
    /// What is open while nobody drives, and while the person does.
    pub fn new(watching: OpenPanels, playing: OpenPanels) -> RememberedPanels {
        RememberedPanels { watching, playing, plays: false }
    }

    fn shown(&mut self) -> &mut OpenPanels {
        if self.plays { &mut self.playing } else { &mut self.watching }
    }

    /// Takes note of what is open, unless the person has just begun or ceased to play: then what to open.
    pub fn follow(&mut self, open: OpenPanels, plays: bool) -> Option<OpenPanels> {
        if self.plays == plays {
            *self.shown() = open;
            return None;
        }
        self.plays = plays;
        Some(*self.shown()).filter(|wanted| *wanted != open)
    }
}

/// How large panels are whose edges can be dragged, in points.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PanelSizes {
    /// Its width.
    pub inspector: f32,
    /// Its height.
    pub radio: f32,
    /// Its height.
    pub communication: f32,
    /// Its height.
    pub states: f32,
    /// Its height.
    pub camera: f32,
}

impl PanelSizes {
    /// Each with its name in the file of settings.
    pub fn each(&mut self) -> [(&'static str, &mut f32); 5] {
        let PanelSizes { inspector, radio, communication, states, camera } = self;
        let below =
            [("radio", radio), ("communication", communication), ("states", states), ("camera", camera)];
        let [radio, communication, states, camera] = below;
        [("inspector", inspector), radio, communication, states, camera]
    }

    /// The height of a panel below the pitch.
    pub fn below(&mut self, panel: Overlay) -> &mut f32 {
        match panel {
            Overlay::Communication => &mut self.communication,
            Overlay::Camera => &mut self.camera,
            Overlay::States => &mut self.states,
            _ => &mut self.radio,
        }
    }
}

impl Default for PanelSizes {
    fn default() -> PanelSizes {
        PanelSizes { inspector: 400.0, radio: 246.0, communication: 246.0, states: 360.0, camera: 340.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escape_closes_one_thing_at_a_time_from_the_top() {
        let mut open = OpenDialogues { question: Some(Question::Leave), help: true, result: true };
        assert!(open.close_one());
        assert_eq!(open, OpenDialogues { question: None, help: true, result: true });
        assert!(open.close_one() && open.close_one());
        assert_eq!(open, OpenDialogues::default());
        assert!(!open.close_one());
    }

    #[test]
    fn a_player_sees_little_until_more_is_asked_for_and_a_watcher_what_was_open_before() {
        let mut remembered = RememberedPanels::default();
        let watching = remembered.watching;
        let playing = remembered.follow(watching, true).expect("a player sees less");
        assert_eq!(playing, OpenPanels { overlays: Overlays::only([Overlay::Labels]), inspector: false });
        let asked =
            OpenPanels { overlays: Overlays::only([Overlay::Labels, Overlay::Vectors]), inspector: true };
        assert_eq!(remembered.follow(asked, true), None);
        assert_eq!(remembered.follow(asked, false), Some(watching));
        assert_eq!(remembered.follow(watching, true), Some(asked));
    }
}
