//! The velocity of a walking robot, and what limits it.

use bevy::prelude::*;

use super::Walker;

/// A velocity in the robot's own frame: m/s ahead and to the left, and rad/s counter-clockwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Reflect)]
pub struct Gait {
    /// m/s.
    pub ahead: f32,
    /// m/s.
    pub left: f32,
    /// rad/s, counter-clockwise.
    pub turn: f32,
}

impl Gait {
    /// This gait within a walker's limits: a turn takes from the walk what it needs of the legs' way.
    pub fn limited(self, walker: &Walker) -> Gait {
        let fastest = walker.turn.to_radians();
        let turn = self.turn.clamp(-fastest, fastest);
        let longest = if self.ahead >= 0.0 { walker.ahead } else { walker.back };
        let (x, y) = (self.ahead / longest, self.left / walker.aside);
        let share = (1.0 - turn.abs() / fastest) / (x * x + y * y).sqrt().max(1.0);
        Gait { ahead: self.ahead * share, left: self.left * share, turn }
    }

    /// This gait, moved towards `wanted` by what a walker can change in `dt` seconds.
    pub fn towards(self, wanted: Gait, walker: &Walker, dt: f32) -> Gait {
        let (step, turn_step) = (walker.acceleration * dt, walker.turn_acceleration.to_radians() * dt);
        let (x, y) = (wanted.ahead - self.ahead, wanted.left - self.left);
        let share = (step / (x * x + y * y).sqrt()).min(1.0);
        let turn = (wanted.turn - self.turn).clamp(-turn_step, turn_step);
        Gait { ahead: self.ahead + x * share, left: self.left + y * share, turn: self.turn + turn }
    }

    /// This gait, slower by a factor.
    pub fn times(self, share: f32) -> Gait {
        Gait { ahead: self.ahead * share, left: self.left * share, turn: self.turn * share }
    }

    /// m/s
    pub fn speed(self) -> f32 {
        (self.ahead * self.ahead + self.left * self.left).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::GaitNoise;

    const AIBO: Walker = Walker {
        ahead: 0.4,
        back: 0.3,
        aside: 0.2,
        turn: 100.0,
        acceleration: 0.8,
        turn_acceleration: 300.0,
        push: 9.0,
        turn_gain: 3.0,
        noise: GaitNoise { step: 0.4, share: 0.0, drift: 0.0, turn: 0.0 },
    };

    fn gait(ahead: f32, left: f32, turn: f32) -> Gait {
        Gait { ahead, left, turn }
    }

    #[test]
    fn each_direction_has_its_own_top_speed() {
        assert_eq!(gait(1.0, 0.0, 0.0).limited(&AIBO), gait(0.4, 0.0, 0.0));
        assert_eq!(gait(-1.0, 0.0, 0.0).limited(&AIBO), gait(-0.3, 0.0, 0.0));
        assert_eq!(gait(0.0, -1.0, 0.0).limited(&AIBO), gait(0.0, -0.2, 0.0));
        let both = gait(0.4, 0.2, 0.0).limited(&AIBO);
        assert!(
            (both.ahead - 0.4 / 2f32.sqrt()).abs() < 1e-6 && (both.left - 0.2 / 2f32.sqrt()).abs() < 1e-6
        );
    }

    #[test]
    fn a_robot_that_turns_as_fast_as_it_can_does_not_walk() {
        let half = gait(0.4, 0.0, 50f32.to_radians()).limited(&AIBO);
        assert!((half.ahead - 0.2).abs() < 1e-6, "{half:?}");
        let full = gait(0.4, 0.0, 10.0).limited(&AIBO);
        assert!(full.ahead.abs() < 1e-6 && (full.turn - 100f32.to_radians()).abs() < 1e-6);
    }

    #[test]
    fn the_top_speed_takes_half_a_second_to_reach() {
        let (mut now, wanted) = (Gait::default(), gait(0.4, 0.0, 0.0));
        for _ in 0..30 {
            now = now.towards(wanted, &AIBO, 1.0 / 60.0);
        }
        assert!((now.ahead - 0.4).abs() < 1e-5, "{now:?}");
        assert_eq!(now.towards(wanted, &AIBO, 1.0 / 60.0).ahead, 0.4);
    }
}
