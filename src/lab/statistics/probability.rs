//! Whether something happens with at least a certain probability, asked again after each trial until it is decided.

use serde::Serialize;
use statrs::function::beta::{beta_reg, ln_beta};

use crate::ops;

/// A sequential test of a probability against a threshold, which may be looked at after every trial.
///
/// On either side of the threshold, the likelihood of the trials is weighed over all probabilities there by Jeffreys's distribution and divided
/// by the likelihood at the threshold (A. Wald, *Sequential tests of statistical hypotheses*, 1945, weight functions; H. Robbins,
/// *Statistical methods related to the law of the iterated logarithm*, 1970). If the truth lies on the other side or on the threshold, this
/// ratio is a supermartingale that begins at 1, so by Ville's inequality it ever reaches 1 / (1 - confidence) with a probability of at
/// most 1 - confidence. So both wrong verdicts are at most that likely, however many trials there are and whenever one stops. How long
/// it takes has no bound: with the truth at the threshold it goes on for ever, as a rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProbabilityTest {
    /// The probability that is asked for, between 0 and 1.
    pub at_least: f64,
    /// The probability that a verdict is not wrong, whichever it is; between 0 and 1.
    pub confidence: f64,
}

/// What trials say about a probability.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum TestVerdict {
    /// It is the threshold or more.
    Met,
    /// It is less.
    Missed,
    /// More trials are needed.
    #[default]
    Undecided,
}

/// The trials of a test up to its verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TestCount {
    /// Those that went as they should.
    pub met: u32,
    /// All of them.
    pub of: u32,
    /// What they say.
    pub verdict: TestVerdict,
}

impl ProbabilityTest {
    /// The verdict after `of` trials, of which `met` went as they should.
    pub fn verdict(self, met: u32, of: u32) -> TestVerdict {
        let (met, missed) = (f64::from(met), f64::from(of) - f64::from(met));
        let threshold = self.at_least;
        // A ratio exceeds 1 only on the side on which the trials themselves lie.
        let is_above = met > threshold * (met + missed);
        let (trials, threshold) =
            if is_above { ((met, missed), threshold) } else { ((missed, met), 1.0 - threshold) };
        let wanted = -ops::ln_f64(1.0 - self.confidence);
        // The mean ratio is no more than the largest one, which is quickly found.
        let is_decided =
            largest_log_ratio(trials, threshold) >= wanted && log_ratio(trials, threshold) >= wanted;
        match (is_decided, is_above) {
            (false, _) => TestVerdict::Undecided,
            (true, true) => TestVerdict::Met,
            (true, false) => TestVerdict::Missed,
        }
    }

    /// Counts one more trial, unless it is decided already: what comes after the verdict does not change it.
    pub fn count(self, counted: TestCount, met: bool) -> TestCount {
        if counted.verdict != TestVerdict::Undecided {
            return counted;
        }
        let (met, of) = (counted.met + u32::from(met), counted.of + 1);
        TestCount { met, of, verdict: self.verdict(met, of) }
    }

    /// The fewest trials that may show that it is met: all of them go as they should. `None` if that takes more than `most`.
    pub fn fewest(self, most: u32) -> Option<u32> {
        (1..=most).find(|trials| self.verdict(*trials, *trials) == TestVerdict::Met)
    }
}

/// The logarithm of the mean likelihood over all probabilities above a threshold by the likelihood at it, for trials that went so and that
/// did not.
pub(super) fn log_ratio((met, missed): (f64, f64), threshold: f64) -> f64 {
    const JEFFREYS: f64 = 0.5;
    let log_integral = |met: f64, missed: f64| {
        let (a, b) = (met + JEFFREYS, missed + JEFFREYS);
        ln_beta(a, b) + ops::ln_f64(beta_reg(b, a, 1.0 - threshold))
    };
    let at_threshold = met * ops::ln_f64(threshold) + missed * ops::ln_f64(1.0 - threshold);
    log_integral(met, missed) - log_integral(0.0, 0.0) - at_threshold
}

/// As [`log_ratio`], with the share of the trials that went so in place of all probabilities.
fn largest_log_ratio((met, missed): (f64, f64), threshold: f64) -> f64 {
    let part = |count: f64, probability: f64| {
        if count > 0.0 { count * ops::ln_f64(count / (met + missed) / probability) } else { 0.0 }
    };
    part(met, threshold) + part(missed, 1.0 - threshold)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Dice, Seed};

    const TEST: ProbabilityTest = ProbabilityTest { at_least: 0.9, confidence: 0.95 };

    /// How many of so many tests end with this verdict within some trials, and how many trials the tests took on average.
    fn count(test: ProbabilityTest, truth: f32, wanted: TestVerdict) -> (u32, f64) {
        let mut dice = Dice::new(Seed(3), "probability test", None);
        let (mut ended_so, mut trials) = (0, 0_u32);
        for _ in 0..TESTS {
            let mut counted = TestCount::default();
            while counted.of < 400 && counted.verdict == TestVerdict::Undecided {
                counted = test.count(counted, dice.chance(truth));
            }
            ended_so += u32::from(counted.verdict == wanted);
            trials += counted.of;
        }
        (ended_so, f64::from(trials) / f64::from(TESTS))
    }

    const TESTS: u32 = 1000;

    /// At the threshold a miss is wrong, and just below it a pass; looked at after each of 400 trials. Three standard deviations are 2 %.
    #[test]
    fn a_wrong_verdict_is_no_more_likely_than_said_however_often_one_looks() {
        let (missed, _) = count(TEST, 0.9, TestVerdict::Missed);
        let (met, _) = count(TEST, 0.899, TestVerdict::Met);
        assert!(missed <= 70 && met <= 70, "{missed} and {met} of {TESTS} verdicts are wrong");
        assert!(missed > 0 && met > 0, "wrong verdicts are possible");
    }

    #[test]
    fn a_truth_far_from_the_threshold_is_found_soon() {
        let (met, trials) = count(TEST, 0.99, TestVerdict::Met);
        assert!(met > 970 && trials < 80.0, "{met} of {TESTS} after {trials} trials");
        let (missed, trials) = count(TEST, 0.5, TestVerdict::Missed);
        assert!(missed > 990 && trials < 15.0, "{missed} of {TESTS} after {trials} trials");
    }

    #[test]
    fn both_sides_are_alike() {
        let mirrored = ProbabilityTest { at_least: 0.1, confidence: 0.95 };
        for of in 0..200_u32 {
            for met in (0..=of).filter(|met| 10 * met != 9 * of) {
                let expected = match TEST.verdict(met, of) {
                    TestVerdict::Met => TestVerdict::Missed,
                    TestVerdict::Missed => TestVerdict::Met,
                    TestVerdict::Undecided => TestVerdict::Undecided,
                };
                assert_eq!(mirrored.verdict(of - met, of), expected, "{met} of {of}");
            }
        }
    }

    #[test]
    fn trials_that_all_pass_decide_after_the_fewest() {
        let fewest = TEST.fewest(1000).expect("it can be decided");
        assert_eq!(TEST.verdict(fewest - 1, fewest - 1), TestVerdict::Undecided);
        assert_eq!(TEST.verdict(fewest, fewest), TestVerdict::Met);
        assert_eq!(TEST.fewest(fewest - 1), None);
        // Certainty against 0.9 alone, which nobody could beat, takes ln 20 / -ln 0.9 = 28.4.
        assert!((29..45).contains(&fewest), "{fewest}");
    }
}
