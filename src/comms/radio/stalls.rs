//! Stalls: now and then nothing gets through a link, and all that was sent meanwhile arrives when it does again. So delays are correlated.

use serde::{Deserialize, Serialize};

use crate::data::{Bound, Fault, Validate, check_all, ensure};
use crate::ops;
use crate::rng::Dice;

/// How often each directed link stalls, and for how long: a Pareto distribution between two bounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stalls {
    /// The mean time from the end of one to the beginning of the next, s.
    pub every: f32,
    /// The shortest, s.
    pub least: f32,
    /// The longest, s.
    pub most: f32,
    /// The share of stalls longer than `t` falls as `t` to the power of minus this, up to the longest.
    pub shape: f32,
}

/// The stall of a link that was begun last or is to begin next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stall {
    /// s
    begins: f64,
    /// s
    ends: f64,
}

impl Stalls {
    /// How long a message is held up that is sent at `now`, s. `stall` is that of its link, if there was one; time does not go back.
    pub(super) fn hold_up(&self, stall: &mut Option<Stall>, now: f64, dice: &mut Dice) -> f32 {
        let mut current = stall.unwrap_or_else(|| self.next(now, dice));
        while current.ends <= now {
            current = self.next(current.ends, dice);
        }
        *stall = Some(current);
        if current.begins <= now { (current.ends - now) as f32 } else { 0.0 }
    }

    fn next(&self, after: f64, dice: &mut Dice) -> Stall {
        let begins = after + f64::from(dice.exponential(self.every));
        Stall { begins, ends: begins + f64::from(self.length(dice.uniform())) }
    }

    /// The length of which this share of the stalls is shorter, s.
    fn length(&self, share: f32) -> f32 {
        let beyond = ops::powf(self.least / self.most, self.shape);
        self.least * ops::powf(1.0 - share * (1.0 - beyond), -1.0 / self.shape)
    }
}

impl Validate for Stalls {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("every", self.every, Bound::SECONDS.positive()),
            ("least", self.least, Bound::DELAY.positive()),
            ("most", self.most, Bound::DELAY.positive()),
            ("shape", self.shape, Bound::COEFFICIENT.positive()),
        ])?;
        let longer = || format!("must be at least stalls.least, {}, not {}", self.least, self.most);
        ensure(self.most >= self.least, "most", longer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;

    const STALLS: Stalls = Stalls { every: 0.1, least: 0.01, most: 1.0, shape: 1.5 };

    #[test]
    fn lengths_lie_between_their_bounds_and_half_are_shorter_than_the_median() {
        assert!((STALLS.length(0.0) - 0.01).abs() < 1e-6 && (STALLS.length(1.0) - 1.0).abs() < 1e-3);
        // All but a thousandth are shorter than the longest, so that is hardly more than the median of an unbounded one.
        assert!((STALLS.length(0.5) - 0.01 * ops::powf(2.0, 1.0 / 1.5)).abs() < 1e-4);
    }

    #[test]
    fn whatever_is_sent_in_a_stall_arrives_when_it_ends() {
        let (mut dice, mut stall) = (Dice::new(Seed(3), "stalls", None), None);
        let held: Vec<f32> =
            (0..20_000).map(|i| STALLS.hold_up(&mut stall, f64::from(i) * 1e-3, &mut dice)).collect();
        for pair in held.windows(2).filter(|pair| pair[1] > 0.0 && pair[0] > 0.001) {
            let is_same = (pair[0] - pair[1] - 0.001).abs() < 1e-5;
            assert!(is_same || pair[1] > pair[0] - 0.001, "the same stall, or the next one: {pair:?}");
        }
        let share = held.iter().filter(|held| **held > 0.0).count() as f32 / held.len() as f32;
        // A mean length of 0.027 s, each 0.1 s after the one before.
        assert!((0.12..0.32).contains(&share), "{share}");
    }
}
