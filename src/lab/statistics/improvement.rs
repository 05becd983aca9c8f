//! How likely one strategy does better than another: P(A > B) + ½ P(A = B).

use serde::Serialize;

use super::interval::Interval;
use super::quantiles::{crossing, normal_reach};
use super::share::wilson;

/// The probability of improvement (R. Agarwal and others, *Deep reinforcement learning at the edge of the statistical precipice*, 2021): ½ if
/// neither does better, 1 if the first always does. Draws count half.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Improvement {
    /// The probability.
    pub probability: f64,
    /// In which it lies.
    pub interval: Interval,
}

/// From differences, first less second, of matches in pairs with one seed each: with how many seeds the first does better.
///
/// The interval is Wilson's, with a draw as half a win. Draws vary less than wins and losses, so with many of them it is wider than it
/// need be. `None` of no pair.
pub fn improvement_of_pairs(differences: &[f64], confidence: f64) -> Option<Improvement> {
    let score: f64 = differences.iter().map(|difference| score(*difference, 0.0)).sum();
    let n = differences.len() as f64;
    (n > 0.0).then(|| Improvement { probability: score / n, interval: wilson(score, n, confidence) })
}

/// From two samples that have nothing to do with each other: in how many of all pairs of a match of the first and a match of the second
/// the first does better, which is Mann and Whitney's U by the number of pairs.
///
/// The interval is by the variance that belongs to each probability, so it is sound also near 0 and 1 (R. G. Newcombe, *Confidence
/// intervals for an effect size measure based on the Mann-Whitney statistic, part 2*, 2006, method 5). `None` if a sample is empty.
pub fn improvement_of_samples(first: &[f64], second: &[f64], confidence: f64) -> Option<Improvement> {
    let (m, n) = (first.len() as f64, second.len() as f64);
    if m * n == 0.0 {
        return None;
    }
    let score: f64 = first.iter().map(|a| second.iter().map(|b| score(*a, *b)).sum::<f64>()).sum();
    let probability = score / (m * n);
    let reach = normal_reach(confidence);
    let half = |at: f64| reach * newcombe_variance(at, m, n).sqrt();
    let low = crossing(|at| at + half(at) - probability, 0.0, probability);
    let high = crossing(|at| at - half(at) - probability, probability, 1.0);
    Some(Improvement { probability, interval: Interval { low, high } })
}

fn score(a: f64, b: f64) -> f64 {
    if a > b {
        1.0
    } else if a == b {
        0.5
    } else {
        0.0
    }
}

/// The variance of the share of won pairs if this is its true value, for samples of `m` and `n`.
fn newcombe_variance(share: f64, m: f64, n: f64) -> f64 {
    let others = (m + n) / 2.0 - 1.0;
    let dependence = (1.0 - share) / (2.0 - share) + share / (1.0 + share);
    share * (1.0 - share) * (1.0 + others * dependence) / (m * n)
}
