//! Seeded dice. Every purpose and robot has a stream of its own, so that switching one mechanism on or off does not
//! shift the dice of another. They fall alike on every machine: distributions rest on [`ops`] alone.

use std::f32::consts::TAU;
use std::fmt;

use bevy::prelude::*;
use rand::distr::{Distribution, StandardUniform};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use xxhash_rust::xxh3::xxh3_64_with_seed;

use crate::ids::RobotId;
use crate::ops;

/// The seed of a match: with the assets and the recorded inputs, all that chance depends on.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Resource)]
pub struct Seed(pub u64);

/// The seed of a match that nobody has chosen one for.
pub const DEFAULT_SEED: u64 = 1;
/// The largest seed. Every reader of JSON keeps it and all below it exactly, also one that keeps numbers as doubles.
pub const LARGEST_SEED: u64 = (1 << 53) - 1;

/// A stream of random numbers: PCG (MCG 128/64), named by its purpose and its robot.
#[derive(Clone, PartialEq)]
pub struct Dice(Pcg64Mcg);

/// All dice of a match go on with other streams, which this salt decides: another chance from here on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DiceStirred(pub u64);

/// The generator hides its state; the next number tells streams apart.
impl fmt::Debug for Dice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let next: u64 = StandardUniform.sample(&mut self.0.clone());
        write!(f, "Dice({next:016x})")
    }
}

impl Dice {
    /// The stream for a purpose, and for one robot where each robot has its own.
    pub fn new(seed: Seed, purpose: &str, robot: Option<RobotId>) -> Dice {
        let owner = robot.map_or(u64::MAX, |id| (id.team.index() as u64) << 8 | u64::from(id.number));
        let hashed =
            xxh3_64_with_seed(purpose.as_bytes(), seed.0 ^ owner.wrapping_mul(0x9E37_79B9_7F4A_7C15));
        Dice(Pcg64Mcg::seed_from_u64(hashed))
    }

    /// Goes on with another stream, which this one and the salt decide.
    pub fn stir(&mut self, DiceStirred(salt): DiceStirred) {
        let next: u64 = StandardUniform.sample(&mut self.0);
        *self = Dice(Pcg64Mcg::seed_from_u64(xxh3_64_with_seed(&next.to_le_bytes(), salt)));
    }

    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f32 {
        StandardUniform.sample(&mut self.0)
    }

    /// Normal with mean 0 and the given standard deviation, within 5.8 of them. Takes two numbers from the stream. Source: Box
    /// and Muller, "A Note on the Generation of Random Normal Deviates" (1958).
    pub fn normal(&mut self, deviation: f32) -> f32 {
        let (square, turn) = (self.exponential(2.0), TAU * self.uniform());
        deviation * square.sqrt() * ops::cos(turn)
    }

    /// Exponential with the given mean: at least 0, mostly less than the mean and seldom many times as much. Takes one
    /// number from the stream.
    pub fn exponential(&mut self, mean: f32) -> f32 {
        -mean * ops::ln(1.0 - self.uniform())
    }

    /// Uniform among the whole numbers from 0 to below `end`, which is above 0.
    pub fn below(&mut self, end: usize) -> usize {
        self.0.random_range(0..end)
    }

    /// True with this probability: never at 0, always at 1.
    pub fn chance(&mut self, probability: f32) -> bool {
        self.uniform() < probability
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    fn first(seed: u64, purpose: &str, robot: Option<RobotId>) -> f32 {
        Dice::new(Seed(seed), purpose, robot).uniform()
    }

    #[test]
    fn streams_differ_by_seed_purpose_and_robot_and_repeat() {
        let robot = Some(RobotId::new(Team::Home, 1));
        let base = first(1, "camera", robot);
        assert_eq!(base, first(1, "camera", robot));
        assert_ne!(base, first(2, "camera", robot));
        assert_ne!(base, first(1, "odometry", robot));
        assert_ne!(base, first(1, "camera", Some(RobotId::new(Team::Away, 1))));
        assert_ne!(base, first(1, "camera", None));
    }

    #[test]
    fn stirred_dice_differ_by_salt_and_repeat() {
        let stirred = |salt| {
            let mut dice = Dice::new(Seed(7), "test", None);
            dice.stir(DiceStirred(salt));
            dice.uniform()
        };
        assert_eq!(stirred(1), stirred(1));
        assert_ne!(stirred(1), stirred(2));
        assert_ne!(stirred(1), first(7, "test", None));
    }

    #[test]
    fn below_reaches_every_number_about_as_often() {
        let mut dice = Dice::new(Seed(7), "test", None);
        let mut counts = [0_u32; 7];
        (0..7000).for_each(|_| counts[dice.below(7)] += 1);
        // Four standard deviations.
        assert!(counts.iter().all(|count| count.abs_diff(1000) < 120), "{counts:?}");
    }

    #[test]
    fn chance_zero_never_happens_and_chance_one_always_does() {
        let mut dice = Dice::new(Seed(7), "test", None);
        assert!((0..10_000).all(|_| !dice.chance(0.0)));
        assert!((0..10_000).all(|_| dice.chance(1.0)));
    }

    #[test]
    fn normal_has_the_asked_mean_deviation_and_tails() {
        let mut dice = Dice::new(Seed(7), "test", None);
        let n = 20_000;
        let values: Vec<f32> = (0..n).map(|_| dice.normal(0.3)).collect();
        // Four standard deviations of the mean, of the variance and of the shares beyond one, two and three deviations.
        let root = (n as f32).sqrt();
        let mean = values.iter().sum::<f32>() / n as f32;
        assert!(mean.abs() < 4.0 * 0.3 / root, "{mean}");
        let variance = values.iter().map(|value| value.powi(2)).sum::<f32>() / n as f32;
        assert!((variance - 0.09).abs() < 4.0 * 0.09 * 2.0_f32.sqrt() / root, "{variance}");
        for (deviations, expected) in [(1.0, 0.158_655), (2.0, 0.022_750), (3.0, 0.001_350)] {
            for sign in [-1.0, 1.0] {
                let beyond = values.iter().filter(|value| sign * **value > deviations * 0.3).count();
                let share = beyond as f32 / n as f32;
                let tolerance = 4.0 * (expected * (1.0_f32 - expected)).sqrt() / root;
                assert!((share - expected).abs() < tolerance, "{share} beyond {sign} {deviations}");
            }
        }
    }

    #[test]
    fn neighbours_in_the_stream_of_normals_do_not_lean_on_each_other() {
        let mut dice = Dice::new(Seed(7), "test", None);
        let n = 20_000;
        let values: Vec<f32> = (0..=n).map(|_| dice.normal(1.0)).collect();
        let product = values.windows(2).map(|pair| pair[0] * pair[1]).sum::<f32>() / n as f32;
        assert!(product.abs() < 4.0 / (n as f32).sqrt(), "{product}");
    }

    #[test]
    fn exponential_has_the_asked_mean_and_tail() {
        let mut dice = Dice::new(Seed(7), "test", None);
        let n = 20_000;
        let values: Vec<f32> = (0..n).map(|_| dice.exponential(0.3)).collect();
        assert!(values.iter().all(|value| *value >= 0.0 && value.is_finite()));
        // Four standard deviations of the mean and of the share beyond it, which is 1 / e.
        let mean = values.iter().sum::<f32>() / n as f32;
        assert!((mean - 0.3).abs() < 4.0 * 0.3 / (n as f32).sqrt(), "{mean}");
        let beyond = values.iter().filter(|value| **value > 0.3).count() as f32 / n as f32;
        assert!((beyond - 0.3679).abs() < 4.0 * (0.3679 * 0.6321 / n as f32).sqrt(), "{beyond}");
    }
}
