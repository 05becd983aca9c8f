//! A wandering direction: the standard cure for the places where the other schemas cancel out.
//!
//! Every draw comes from the robot's own seeded dice, so the first direction repeats from run to run as well.
//!
//! Source: Clay's Noise node, after Arkin's noise schema.

use std::f32::consts::TAU;

use bevy::prelude::*;

use crate::geometry::unit;
use crate::rng::Dice;

/// The state of one noise schema: the present direction and the time in seconds at which the next one is
/// drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Noise {
    direction: Vec2,
    until: f32,
}

impl Noise {
    /// A unit vector whose angle is drawn evenly from the full circle at the first call and then every
    /// `period` seconds. A clock that was set back starts a new period.
    pub fn sample(&mut self, now: f32, period: f32, dice: &mut Dice) -> Vec2 {
        if self.direction == Vec2::ZERO || now >= self.until || self.until > now + period {
            self.direction = unit(dice.uniform() * TAU);
            self.until = now + period;
        }
        self.direction
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;

    fn dice() -> Dice {
        Dice::new(Seed(3), "noise test", None)
    }

    #[test]
    fn the_direction_holds_for_one_period_and_then_changes() {
        let (mut noise, mut dice) = (Noise::default(), dice());
        let first = noise.sample(0.0, 5.0, &mut dice);
        assert!((0..100).all(|step| noise.sample(step as f32 * 0.05, 5.0, &mut dice) == first));
        let second = noise.sample(5.0, 5.0, &mut dice);
        assert_ne!(first, second);
        assert_eq!(noise.sample(9.9, 5.0, &mut dice), second);
    }

    #[test]
    fn a_held_direction_takes_no_dice() {
        let (mut noise, mut used) = (Noise::default(), dice());
        for step in 0..20 {
            noise.sample(100.0 + step as f32 * 0.05, 1.5, &mut used);
        }
        let mut fresh = dice();
        fresh.uniform();
        assert_eq!(used, fresh);
    }

    #[test]
    fn a_clock_that_was_set_back_starts_a_new_period() {
        let (mut noise, mut dice) = (Noise::default(), dice());
        let late = noise.sample(600.0, 5.0, &mut dice);
        assert_ne!(noise.sample(0.0, 5.0, &mut dice), late);
    }

    #[test]
    fn directions_are_unit_vectors_from_the_whole_circle() {
        let (mut noise, mut dice) = (Noise::default(), dice());
        let drawn: Vec<Vec2> = (0..4000).map(|s| noise.sample(s as f32, 1.0, &mut dice)).collect();
        assert!(drawn.iter().all(|v| (v.length() - 1.0).abs() < 1e-5));
        for quadrant in
            [Vec2::new(1.0, 1.0), Vec2::new(-1.0, 1.0), Vec2::new(1.0, -1.0), Vec2::new(-1.0, -1.0)]
        {
            let share = drawn.iter().filter(|v| (**v * quadrant).cmpgt(Vec2::ZERO).all()).count();
            assert!((900..1100).contains(&share), "{quadrant}: {share} of 4000");
        }
    }

    #[test]
    fn the_same_dice_give_the_same_walk() {
        let walk = || {
            let (mut noise, mut dice) = (Noise::default(), dice());
            (0..50).map(|s| noise.sample(s as f32 * 0.7, 2.0, &mut dice)).collect::<Vec<_>>()
        };
        assert_eq!(walk(), walk());
    }
}
