//! How many matches it takes until a mean is known to within a width.

use super::average::SampleMoments;
use super::interval::Interval;
use super::quantiles::{normal_reach, student_reach};

/// Matches are played until the interval of a mean is no wider than asked for (Y. S. Chow and H. Robbins, *On the asymptotic theory of
/// fixed-width sequential confidence intervals for the mean*, 1965).
///
/// The rule looks at the first [`FIRST_LOOK`] matches, and then after each [`LOOK_EVERY`] more. It stops where Student's interval of all
/// matches so far is narrow enough, and the answer is their mean with half the width on either side. It depends on nothing but the values in
/// the order of their seeds, so neither does it matter how many are played at once, nor whether one was interrupted.
///
/// The confidence is exact only in the limit of many matches, since one tends to stop where the spread looks small. The tests of this file
/// simulate what it comes to. Of 20,000 intervals of 95 % that ended after 65 to 255 matches on average, 95 to 96 % held the mean of normal
/// values and of goal differences, also of uneven teams, and 94 % that of numbers as skewed as counts of rare events and waiting times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UntilWidth {
    /// In what share of cases the interval shall hold the mean; between 0 and 1.
    pub confidence: f64,
    /// From end to end of the interval, in the unit of the values.
    pub width: f64,
    /// The most matches.
    pub budget: usize,
}

/// The matches before which the rule does not look: fewer say too little about the spread.
pub const FIRST_LOOK: usize = 50;
/// The matches between two looks.
pub const LOOK_EVERY: usize = 10;

/// What the rule says about the matches so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WidthVerdict {
    /// It was narrow enough after this many matches; those that came later do not count.
    Reached {
        /// The matches that count.
        matches: usize,
        /// As wide as asked for.
        interval: Interval,
    },
    /// It is not narrow enough.
    More {
        /// The next look is after so many matches in all.
        next_look: usize,
        /// So many matches in all will do, as it seems; perhaps more than the budget.
        about: usize,
    },
    /// It is not narrow enough, and no match is left.
    BudgetSpent {
        /// Of all matches of the budget, by Student; wider than asked for. `None` if all values are equal.
        interval: Option<Interval>,
    },
}

impl UntilWidth {
    /// Looks at the values of the matches so far, in the order of their seeds.
    pub fn look(self, values: &[f64]) -> WidthVerdict {
        let values = &values[..values.len().min(self.budget)];
        let mut running = Running::default();
        for (index, value) in values.iter().enumerate() {
            running.add(*value);
            let matches = index + 1;
            if self.is_look(matches) && self.is_narrow(running.spread()) {
                let interval = Interval::around(running.mean, self.width / 2.0);
                return WidthVerdict::Reached { matches, interval };
            }
        }
        if values.len() >= self.budget {
            let spread = Some(running.spread()).filter(|spread| spread.deviation > 0.0);
            return WidthVerdict::BudgetSpent {
                interval: spread.and_then(|it| it.interval(self.confidence)),
            };
        }
        let looks = |matches: &usize| self.is_look(*matches);
        let next_look = (values.len() + 1..).find(looks).unwrap_or(self.budget);
        WidthVerdict::More { next_look, about: self.estimate(running.spread()).max(next_look) }
    }

    fn is_look(self, matches: usize) -> bool {
        matches == self.budget || matches >= FIRST_LOOK && (matches - FIRST_LOOK).is_multiple_of(LOOK_EVERY)
    }

    /// Values that are all equal say nothing about the spread.
    fn is_narrow(self, spread: SampleMoments) -> bool {
        let errors = self.width / 2.0 / spread.standard_error();
        let is_near = spread.deviation > 0.0 && errors >= normal_reach(self.confidence);
        is_near && student_reach(self.confidence, spread.freedom()).is_some_and(|reach| errors >= reach)
    }

    /// How many matches with this spread it takes.
    fn estimate(self, spread: SampleMoments) -> usize {
        let errors = normal_reach(self.confidence) * spread.deviation / (self.width / 2.0);
        (errors * errors).ceil() as usize
    }
}

/// Mean and spread of values that come one by one (B. P. Welford, *Note on a method for calculating corrected sums of squares and
/// products*, 1962).
#[derive(Clone, Copy, Debug, Default)]
struct Running {
    count: usize,
    mean: f64,
    /// The sum of the squares of the deviations from the mean.
    squares: f64,
}

impl Running {
    fn add(&mut self, value: f64) {
        self.count += 1;
        let off = value - self.mean;
        self.mean += off / self.count as f64;
        self.squares += off * (value - self.mean);
    }

    fn spread(self) -> SampleMoments {
        let deviation = if self.count < 2 { 0.0 } else { (self.squares / (self.count as f64 - 1.0)).sqrt() };
        SampleMoments { count: self.count, mean: self.mean, deviation }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ops;
    use crate::rng::{Dice, Seed};

    /// A Poisson number, by the product of uniform ones.
    fn poisson(mean: f64, dice: &mut Dice) -> f64 {
        let (limit, mut product, mut count) = (ops::exp_f64(-mean), f64::from(dice.uniform()), 0);
        while product > limit {
            product *= f64::from(dice.uniform());
            count += 1;
        }
        f64::from(count)
    }

    /// Goals of one team less those of the other.
    fn goals(ours: f64, theirs: f64) -> impl Fn(&mut Dice) -> f64 {
        move |dice| poisson(ours, dice) - poisson(theirs, dice)
    }

    const RUNS: u32 = 1500;

    /// How many of 100 intervals hold the mean, and after how many matches they end on average, if as many as `wanted` are needed with the
    /// deviation known.
    fn coverage(draw: impl Fn(&mut Dice) -> f64, (mean, deviation): (f64, f64), wanted: f64) -> (f64, f64) {
        let mut dice = Dice::new(Seed(11), "width", None);
        let rule = UntilWidth {
            confidence: 0.95,
            width: 2.0 * normal_reach(0.95) * deviation / wanted.sqrt(),
            budget: 3000,
        };
        let (mut held, mut played) = (0, 0);
        for _ in 0..RUNS {
            let mut values = Vec::new();
            let (matches, interval) = loop {
                values.extend((0..150).map(|_| draw(&mut dice)));
                match rule.look(&values) {
                    WidthVerdict::Reached { matches, interval } => break (matches, interval),
                    WidthVerdict::More { .. } => {}
                    WidthVerdict::BudgetSpent { .. } => panic!("the budget is wide"),
                }
            };
            held += u32::from(interval.holds(mean));
            played += matches;
        }
        (100.0 * f64::from(held) / f64::from(RUNS), played as f64 / f64::from(RUNS))
    }

    /// Two standard deviations of a share of 1500 are 1.1 %: what is asserted is what the rule's description says less that.
    #[test]
    fn the_interval_holds_the_mean_nearly_as_often_as_said() {
        let normal = |dice: &mut Dice| f64::from(dice.normal(1.7));
        for wanted in [60.0, 250.0] {
            for (name, (held, matches), least) in [
                ("normal values", coverage(normal, (0.0, 1.7), wanted), 93.9),
                ("even goals", coverage(goals(1.5, 1.0), (0.5, 2.5_f64.sqrt()), wanted), 93.9),
                ("uneven goals", coverage(goals(2.0, 0.1), (1.9, 2.1_f64.sqrt()), wanted), 93.7),
                ("rare events", coverage(goals(0.3, 0.0), (0.3, 0.3_f64.sqrt()), wanted), 92.9),
                (
                    "waiting times",
                    coverage(|dice| f64::from(dice.exponential(1.0)), (1.0, 1.0), wanted),
                    92.9,
                ),
            ] {
                assert!(held >= least && held < 98.0, "{name}, {wanted}: {held} %");
                assert!((0.85..1.25).contains(&(matches / wanted)), "{name}, {wanted}: {matches} matches");
            }
        }
    }

    fn rule(width: f64, budget: usize) -> UntilWidth {
        UntilWidth { confidence: 0.95, width, budget }
    }

    /// A deviation of 1, about.
    fn alternating(count: usize) -> Vec<f64> {
        (0..count).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect()
    }

    #[test]
    fn what_comes_after_the_stop_does_not_count() {
        let stop = |count| match rule(0.5, 1000).look(&alternating(count)) {
            WidthVerdict::Reached { matches, interval } => (matches, interval),
            other => panic!("{other:?}"),
        };
        assert_eq!(stop(70), stop(400));
        let (matches, interval) = stop(70);
        assert!(
            matches == 70 && (interval.width() - 0.5).abs() < 1e-12 && interval.high - 0.25 < 1e-12,
            "{interval:?}"
        );
    }

    #[test]
    fn the_rule_says_when_it_looks_next_and_how_many_it_may_take() {
        let more = |count| match rule(0.2, 1000).look(&alternating(count)) {
            WidthVerdict::More { next_look, about } => (next_look, about),
            other => panic!("{other:?}"),
        };
        assert_eq!((more(0).0, more(49).0, more(50).0, more(69).0), (50, 50, 60, 70));
        // (1.96 / 0.1)² and a little more, since the deviation of a sample is a little more than 1.
        assert!((385..400).contains(&more(60).1), "{:?}", more(60));
    }

    #[test]
    fn a_budget_ends_with_the_wider_interval() {
        let WidthVerdict::BudgetSpent { interval: Some(interval) } = rule(0.2, 64).look(&alternating(90))
        else {
            panic!("64 are too few");
        };
        assert!((interval.width() - 0.503).abs() < 0.001, "{interval:?}");
    }

    #[test]
    fn values_that_are_all_equal_are_no_reason_to_stop() {
        assert!(matches!(rule(0.5, 200).look(&[1.0; 120]), WidthVerdict::More { next_look: 130, .. }));
        assert_eq!(rule(0.5, 120).look(&[1.0; 120]), WidthVerdict::BudgetSpent { interval: None });
    }
}
