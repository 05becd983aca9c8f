//! What the window remembers: the selection, which overlays are drawn, and how time passes. Shared by view and inspector.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use crate::ids::RobotId;

/// The robot that a person has clicked or cycled to.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Selected(pub Option<RobotId>);

/// The robot under a person's hands, if any.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Piloted(pub Option<RobotId>);

/// What is drawn on top of the pitch, and the panel below it.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "Vec<Overlay>", into = "Vec<Overlay>")]
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
    /// Claims, supports, locks and messages of both teams.
    pub teamwork: bool,
    /// The radio's panel.
    pub radio: bool,
    /// The team communication's panel, in the radio's place.
    pub communication: bool,
}

/// One of the [`Overlays`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Overlay {
    Vectors,
    FieldOfView,
    Beliefs,
    Zones,
    Labels,
    Teamwork,
    Radio,
    Communication,
}

impl Overlay {
    pub const ALL: [Overlay; 8] = [
        Overlay::Vectors,
        Overlay::FieldOfView,
        Overlay::Beliefs,
        Overlay::Zones,
        Overlay::Labels,
        Overlay::Teamwork,
        Overlay::Radio,
        Overlay::Communication,
    ];
}

impl From<Vec<Overlay>> for Overlays {
    fn from(on: Vec<Overlay>) -> Overlays {
        Overlays::only(on)
    }
}

impl From<Overlays> for Vec<Overlay> {
    fn from(mut overlays: Overlays) -> Vec<Overlay> {
        Overlay::ALL.into_iter().filter(|overlay| *overlays.switch(*overlay)).collect()
    }
}

impl Overlays {
    const NONE: Overlays = Overlays {
        vectors: false,
        field_of_view: false,
        beliefs: false,
        zones: false,
        labels: false,
        teamwork: false,
        radio: false,
        communication: false,
    };

    /// These and no others.
    pub fn only(on: impl IntoIterator<Item = Overlay>) -> Overlays {
        let mut overlays = Overlays::NONE;
        for overlay in on {
            if !*overlays.switch(overlay) {
                overlays.toggle(overlay);
            }
        }
        overlays
    }

    /// The switch of one of them.
    pub fn switch(&mut self, overlay: Overlay) -> &mut bool {
        match overlay {
            Overlay::Vectors => &mut self.vectors,
            Overlay::FieldOfView => &mut self.field_of_view,
            Overlay::Beliefs => &mut self.beliefs,
            Overlay::Zones => &mut self.zones,
            Overlay::Labels => &mut self.labels,
            Overlay::Teamwork => &mut self.teamwork,
            Overlay::Radio => &mut self.radio,
            Overlay::Communication => &mut self.communication,
        }
    }

    /// Switches one of them on or off. Of the two panels below the pitch only one is open.
    pub fn toggle(&mut self, overlay: Overlay) {
        let on = !*self.switch(overlay);
        match overlay {
            Overlay::Radio => self.communication = false,
            Overlay::Communication => self.radio = false,
            _ => {}
        }
        *self.switch(overlay) = on;
    }
}

impl Default for Overlays {
    fn default() -> Overlays {
        use Overlay::{Beliefs, FieldOfView, Labels, Teamwork, Vectors};
        Overlays::only([Vectors, FieldOfView, Beliefs, Labels, Teamwork])
    }
}

/// What the window shows.
#[derive(States, Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Screen {
    #[default]
    Menu,
    Match,
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

/// The longest time of one frame that counts, s: after a longer one the match has simply stood still.
const LONGEST_FRAME: f32 = 0.1;

impl Pace {
    /// The ticks of `dt` seconds that are due after `elapsed` seconds of real time.
    pub fn take_ticks(&mut self, elapsed: f32, dt: f32) -> u32 {
        let single = std::mem::take(&mut self.single_ticks);
        if self.paused {
            if single > 0 {
                self.owed = dt * JUST_BEFORE;
                self.between = 1.0;
            }
            return single;
        }
        self.owed += elapsed.clamp(0.0, LONGEST_FRAME) * self.factor();
        let due = (self.owed / dt).floor();
        self.owed = (self.owed - due * dt).clamp(0.0, dt * JUST_BEFORE);
        self.between = self.owed / dt;
        due as u32 + single
    }
}

/// Share of a tick after which the next one is all but due: where a single tick leaves off.
const JUST_BEFORE: f32 = 0.999;

impl Default for Pace {
    fn default() -> Pace {
        Pace { paused: false, speed: 3, single_ticks: 0, owed: 0.0, between: 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f32 = 1.0 / 60.0;

    #[test]
    fn real_time_runs_sixty_ticks_a_second_whatever_the_frame_rate() {
        for frames in [24, 60, 144] {
            let mut pace = Pace::default();
            let ticks: u32 = (0..frames).map(|_| pace.take_ticks(1.0 / frames as f32, DT)).sum();
            assert!((59..=60).contains(&ticks), "{ticks} at {frames} frames/s");
        }
    }

    #[test]
    fn slow_motion_moves_the_picture_between_ticks() {
        let mut pace = Pace { speed: 0, ..Pace::default() };
        assert_eq!(pace.take_ticks(DT, DT), 0);
        assert!((pace.between - 0.125).abs() < 1e-4, "{}", pace.between);
    }

    #[test]
    fn fast_forward_runs_several_ticks_a_frame() {
        let mut pace = Pace { speed: 9, ..Pace::default() };
        let ticks: u32 = (0..10).map(|_| pace.take_ticks(DT, DT)).sum();
        assert!((639..=640).contains(&ticks), "{ticks}");
    }

    #[test]
    fn a_pause_runs_single_ticks_only_and_goes_on_from_there() {
        let mut pace = Pace { paused: true, ..Pace::default() };
        assert_eq!(pace.take_ticks(0.1, DT), 0);
        pace.single_ticks = 2;
        assert_eq!(pace.take_ticks(0.1, DT), 2);
        assert_eq!((pace.single_ticks, pace.between), (0, 1.0));
        pace.paused = false;
        pace.take_ticks(0.0, DT);
        assert!(pace.between > 0.99, "the picture does not jump back: {}", pace.between);
    }

    #[test]
    fn a_frame_that_took_seconds_is_not_made_up_for() {
        let mut pace = Pace::default();
        assert_eq!(pace.take_ticks(5.0, DT), 6);
    }

    #[test]
    fn speeds_stop_at_both_ends() {
        let mut pace = Pace::default();
        (0..20).for_each(|_| pace.faster());
        assert_eq!(pace.factor(), 64.0);
        (0..20).for_each(|_| pace.slower());
        assert_eq!(pace.factor(), 0.125);
    }

    #[test]
    fn one_panel_below_the_pitch_takes_the_place_of_the_other() {
        let mut overlays = Overlays::default();
        overlays.toggle(Overlay::Radio);
        overlays.toggle(Overlay::Communication);
        assert!(overlays.communication && !overlays.radio);
        overlays.toggle(Overlay::Communication);
        assert_eq!(overlays, Overlays::default());
    }

    #[test]
    fn every_overlay_has_its_own_switch() {
        let mut overlays = Overlays::default();
        *overlays.switch(Overlay::Zones) = true;
        *overlays.switch(Overlay::Labels) = false;
        assert_eq!(overlays, Overlays { zones: true, labels: false, ..Overlays::default() });
    }
}
