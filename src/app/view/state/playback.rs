//! How time passes in the window: paused or not, how fast, and which ticks are due in a frame. Pure.

use bevy::prelude::*;

/// How time passes in the window.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct Playback {
    /// Whether time stands still.
    pub paused: bool,
    /// Index into [`Playback::SPEEDS`].
    pub speed: usize,
    /// Ticks to run although time is paused.
    pub single_ticks: u32,
    /// Match seconds that have passed on screen and not yet in ticks.
    pub owed: f32,
    /// How far the picture is between the last tick and the one before, 0 to 1.
    pub between: f32,
}

impl Playback {
    /// Times real time, slowest first.
    pub const SPEEDS: [f32; 10] = [0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];

    /// Seconds of the match in a second.
    pub fn factor(&self) -> f32 {
        Playback::SPEEDS[self.speed]
    }

    /// Takes the next higher speed.
    pub fn faster(&mut self) {
        self.speed = (self.speed + 1).min(Playback::SPEEDS.len() - 1);
    }

    /// Takes the next lower speed.
    pub fn slower(&mut self) {
        self.speed = self.speed.saturating_sub(1);
    }
}

impl Playback {
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

impl Playback {
    /// Stops after the tick of `dt` seconds that has just been run: the picture shows it.
    pub fn stop(&mut self, dt: f32) {
        (self.paused, self.single_ticks) = (true, 0);
        (self.owed, self.between) = (dt * JUST_BEFORE, 1.0);
    }
}

/// The longest time of one frame that counts, s: after a longer one the match has simply stood still.
const LONGEST_FRAME: f32 = 0.1;

/// Share of a tick after which the next one is all but due: where a single tick leaves off.
const JUST_BEFORE: f32 = 0.999;

impl Default for Playback {
    fn default() -> Playback {
        Playback { paused: false, speed: 3, single_ticks: 0, owed: 0.0, between: 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f32 = 1.0 / 60.0;

    #[test]
    fn real_time_runs_sixty_ticks_a_second_whatever_the_frame_rate() {
        for frames in [24, 60, 144] {
            let mut playback = Playback::default();
            let ticks: u32 = (0..frames).map(|_| playback.take_ticks(1.0 / frames as f32, DT)).sum();
            assert!((59..=60).contains(&ticks), "{ticks} at {frames} frames/s");
        }
    }

    #[test]
    fn slow_motion_moves_the_picture_between_ticks() {
        let mut playback = Playback { speed: 0, ..Playback::default() };
        assert_eq!(playback.take_ticks(DT, DT), 0);
        assert!((playback.between - 0.125).abs() < 1e-4, "{}", playback.between);
    }

    #[test]
    fn fast_forward_runs_several_ticks_a_frame() {
        let mut playback = Playback { speed: 9, ..Playback::default() };
        let ticks: u32 = (0..10).map(|_| playback.take_ticks(DT, DT)).sum();
        assert!((639..=640).contains(&ticks), "{ticks}");
    }

    #[test]
    fn a_pause_runs_single_ticks_only_and_goes_on_from_there() {
        let mut playback = Playback { paused: true, ..Playback::default() };
        assert_eq!(playback.take_ticks(0.1, DT), 0);
        playback.single_ticks = 2;
        assert_eq!(playback.take_ticks(0.1, DT), 2);
        assert_eq!((playback.single_ticks, playback.between), (0, 1.0));
        playback.paused = false;
        playback.take_ticks(0.0, DT);
        assert!(playback.between > 0.99, "the picture does not jump back: {}", playback.between);
    }

    #[test]
    fn what_is_stopped_shows_its_last_tick_and_owes_none() {
        let mut playback = Playback { single_ticks: 3, ..Playback::default() };
        playback.take_ticks(0.04, DT);
        playback.stop(DT);
        assert_eq!((playback.take_ticks(0.1, DT), playback.between), (0, 1.0));
    }

    #[test]
    fn a_frame_that_took_seconds_is_not_made_up_for() {
        let mut playback = Playback::default();
        assert_eq!(playback.take_ticks(5.0, DT), 6);
    }

    #[test]
    fn speeds_stop_at_both_ends() {
        let mut playback = Playback::default();
        (0..20).for_each(|_| playback.faster());
        assert_eq!(playback.factor(), 64.0);
        (0..20).for_each(|_| playback.slower());
        assert_eq!(playback.factor(), 0.125);
    }
}
