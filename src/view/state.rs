//! What the window remembers: the selection, which overlays are drawn, and how time passes. Shared by view and inspector.

use bevy::prelude::*;

use crate::ids::RobotId;

/// The robot that a person has clicked or cycled to.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Selected(pub Option<RobotId>);

/// The robot under a person's hands, if any.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Piloted(pub Option<RobotId>);

/// What is drawn on top of the pitch.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overlays {
    /// Motor-schema vectors of the selected robot.
    pub vectors: bool,
    /// Field of view of the selected robot.
    pub field_of_view: bool,
    /// What the selected robot senses (white dots) and believes (dashed, in its team's colour).
    pub beliefs: bool,
    /// Danger zone and homebase of the selected robot.
    pub zones: bool,
    /// Roles and activities as text under the robots.
    pub labels: bool,
}

impl Default for Overlays {
    fn default() -> Overlays {
        Overlays { vectors: true, field_of_view: true, beliefs: true, zones: false, labels: true }
    }
}

/// How time passes in the window.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    pub paused: bool,
    /// Index into [`Pace::SPEEDS`].
    pub speed: usize,
    /// Ticks to run although time is paused.
    pub single_ticks: u32,
    /// Match seconds that have passed on screen and not yet in ticks.
    pub owed: f32,
    /// How far the picture is between the last tick and the one before, 0 to 1.
    pub between: f32,
}

impl Pace {
    /// Times real time, slowest first.
    pub const SPEEDS: [f32; 10] = [0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];

    pub fn factor(&self) -> f32 {
        Pace::SPEEDS[self.speed]
    }

    pub fn faster(&mut self) {
        self.speed = (self.speed + 1).min(Pace::SPEEDS.len() - 1);
    }

    pub fn slower(&mut self) {
        self.speed = self.speed.saturating_sub(1);
    }
}

impl Default for Pace {
    fn default() -> Pace {
        Pace { paused: false, speed: 3, single_ticks: 0, owed: 0.0, between: 1.0 }
    }
}
