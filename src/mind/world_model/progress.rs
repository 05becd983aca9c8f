//! Whether a robot that is told to move gets on, by what it can know: its wheels or steps, and the landmarks that it sees.
//!
//! Wheels that are blocked do not turn, and the robot knows it at once. Legs step as they are told, whatever comes of it: that
//! they step in vain is known only where landmarks show the robot at two times at hardly another place.

use std::collections::VecDeque;

use bevy::prelude::*;

use crate::clock::Clock;

/// Robots that are told to move slower than this are not judged, m/s.
const TOLD: f32 = 0.12;
/// Wheels or legs that report less motion than this stand still, m/s; each rad/s of turn counts as [`TURN`].
const STILL: f32 = 0.04;
/// m/s for each rad/s: about where a robot's wheels or paws are.
const TURN: f32 = 0.1;
/// Over how long two places are compared that landmarks gave, s. Shorter spans drown in the errors of localisation.
const SPAN: f32 = 0.8;
/// Legs must have stepped this far meanwhile, m.
const LEAST_WAY: f32 = 0.1;
/// Who has come less than this share of the way that its legs have stepped is held.
const LEAST_SHARE: f32 = 0.33;
/// A fix counts if it is at least this share of a full one: more than lines alone give.
const SURE: f32 = 0.5;

/// What a robot knows of its own getting on.
#[derive(Clone, Debug, Default)]
pub(super) struct Progress {
    /// The tick since which it has found itself not to move.
    stalled_since: Option<u64>,
    /// Where landmarks have shown it, by the tick of the frame, oldest first.
    seen: VecDeque<(u64, Vec2)>,
    /// The first and the last frame in which landmarks have shown it held.
    held: Option<(u64, u64)>,
}

/// What wheels or legs have done since the last decision.
#[derive(Clone, Copy, Debug)]
pub(super) struct WayReported {
    /// The fastest that they are told to move, m/s.
    pub told: f32,
    /// m
    pub way: f32,
    /// rad
    pub turn: f32,
    /// s
    pub time: f32,
}

impl Progress {
    /// How long it has been told to move and has found itself not to, s.
    pub fn stalled_for(&self, clock: &Clock) -> f32 {
        self.stalled_since.map_or(0.0, |since| clock.seconds_since(since))
    }

    /// Takes in what wheels or legs report.
    pub fn felt(&mut self, step: WayReported, clock: &Clock) {
        if step.told <= TOLD {
            *self = Progress::default();
            return;
        }
        self.held = self.held.filter(|(_, last)| clock.seconds_since(*last) <= SPAN);
        let stands = step.way + TURN * step.turn.abs() < STILL * step.time;
        let since = self.held.map(|(first, _)| first).or(stands.then_some(clock.tick));
        self.stalled_since = since.map(|since| self.stalled_since.unwrap_or(since));
    }

    /// Takes in the place of a robot that a frame has shown, with how good it is. `way` tells how far the robot has moved by its
    /// wheels or steps between two ticks.
    pub fn saw(
        &mut self,
        (taken, place): (u64, Vec2),
        share: f32,
        way: impl Fn(u64, u64) -> Vec2,
        clock: &Clock,
    ) {
        if share < SURE {
            return;
        }
        self.seen.push_back((taken, place));
        let span = clock.ticks(SPAN);
        while self.seen.get(1).is_some_and(|(next, _)| next + span <= taken) {
            self.seen.pop_front();
        }
        let Some(&(before, from)) = self.seen.front().filter(|(before, _)| before + span <= taken) else {
            return;
        };
        let way = way(before, taken);
        let (direction, stepped) = way.normalize_and_length();
        if stepped >= LEAST_WAY {
            let is_held = (place - from).dot(direction) < LEAST_SHARE * stepped;
            self.held = is_held.then(|| (self.held.map_or(before, |(first, _)| first), taken));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Decisions and frames in every second tick of 60 a second; by its legs the robot goes ahead at 0.3 m/s.
    struct Walk {
        progress: Progress,
        clock: Clock,
        place: Vec2,
    }

    const SPEED: f32 = 0.3;

    impl Walk {
        fn new() -> Walk {
            Walk { progress: Progress::default(), clock: Clock::new(60.0), place: Vec2::ZERO }
        }

        /// For this time it comes this share of its way; returns for how long it takes itself to be stalled.
        fn on(&mut self, seconds: f32, share: f32, landmarks: Option<f32>) -> f32 {
            for _ in 0..(30.0 * seconds).round() as usize {
                self.clock.tick += 2;
                let time = 2.0 / 60.0;
                self.place.x += share * SPEED * time;
                self.progress
                    .felt(WayReported { told: SPEED, way: SPEED * time, turn: 0.0, time }, &self.clock);
                let way = |from: u64, to: u64| Vec2::X * (SPEED * (to - from) as f32 / 60.0);
                if let Some(landmarks) = landmarks {
                    self.progress.saw((self.clock.tick, self.place), landmarks, way, &self.clock);
                }
            }
            self.progress.stalled_for(&self.clock)
        }
    }

    fn wheels(told: f32, way: f32, turn: f32, seconds: f32) -> f32 {
        let (mut progress, mut clock) = (Progress::default(), Clock::new(60.0));
        for _ in 0..(20.0 * seconds).round() as usize {
            clock.tick += 3;
            let time = 3.0 / 60.0;
            progress.felt(WayReported { told, way: way * time, turn: turn * time, time }, &clock);
        }
        progress.stalled_for(&clock)
    }

    #[test]
    fn wheels_that_do_not_turn_as_told_are_known_at_once() {
        assert!((wheels(0.5, 0.0, 0.0, 1.05) - 1.0).abs() < 1e-3);
        assert!((wheels(0.5, -0.03, 0.0, 1.05) - 1.0).abs() < 1e-3, "creeping is no moving");
        assert_eq!(wheels(0.1, 0.0, 0.0, 1.0), 0.0, "hardly told to move");
        assert_eq!(wheels(0.5, 0.1, 0.0, 1.0), 0.0, "it drives");
        assert_eq!(wheels(0.5, 0.0, -0.5, 1.0), 0.0, "it turns");
    }

    #[test]
    fn legs_that_step_in_vain_are_known_by_landmarks_and_not_without() {
        assert_eq!(Walk::new().on(5.0, 0.0, None), 0.0);
        assert_eq!(Walk::new().on(5.0, 0.0, Some(0.1)), 0.0, "lines alone");
        let blocked = Walk::new().on(5.0, 0.0, Some(1.0));
        assert!(blocked > 4.8, "{blocked}");
        assert_eq!(Walk::new().on(5.0, 0.9, Some(1.0)), 0.0, "it walks");
    }

    #[test]
    fn a_robot_is_stalled_until_landmarks_show_that_it_gets_on_or_show_nothing() {
        let mut walk = Walk::new();
        assert_eq!(walk.on(2.0, 1.0, Some(1.0)), 0.0);
        assert!(walk.on(1.5, 0.0, Some(1.0)) > 1.0);
        assert_eq!(walk.on(1.0, 1.0, Some(1.0)), 0.0, "it is free again");
        assert!(walk.on(1.5, 0.0, Some(1.0)) > 1.0);
        assert_eq!(walk.on(1.0, 0.0, None), 0.0, "what it saw is old");
    }

    #[test]
    fn who_is_told_to_rest_is_not_stalled() {
        let mut walk = Walk::new();
        walk.on(2.0, 0.0, Some(1.0));
        walk.progress.felt(WayReported { told: 0.0, way: 0.0, turn: 0.0, time: 0.05 }, &walk.clock);
        assert_eq!(walk.progress.stalled_for(&walk.clock), 0.0);
    }
}
