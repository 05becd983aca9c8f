//! How many pairs of matches it takes until a difference shows.

use std::f64::consts::LN_2;

use statrs::function::gamma::ln_gamma;

use super::quantiles::{normal_cdf, normal_quantile, normal_reach, student_reach};
use crate::ops;

/// Nobody plays more pairs than these to see a difference.
pub const MOST_PAIRS: u32 = 1_000_000;

/// The probability that a paired t test of `pairs` normal differences, two-sided with an error of 1 - `confidence`, shows a mean that is `effect`
/// standard deviations off 0 (Cohen's d_z): the tails of the noncentral t distribution. `None` of fewer than two pairs.
pub fn paired_t_power(effect: f64, pairs: u32, confidence: f64) -> Option<f64> {
    let freedom = f64::from(pairs) - 1.0;
    let reach = student_reach(confidence, freedom)?;
    Some(beyond(reach, effect * f64::from(pairs).sqrt(), freedom))
}

/// The fewest pairs with which [`paired_t_power`] is this; `None` if [`MOST_PAIRS`] are too few.
pub fn pairs_until_t_test_shows(effect: f64, power: f64, confidence: f64) -> Option<u32> {
    let shows = |pairs| paired_t_power(effect, pairs, confidence).is_some_and(|found| found >= power);
    let (mut too_few, mut enough) = (1, MOST_PAIRS);
    if !shows(enough) {
        return None;
    }
    while enough - too_few > 1 {
        let middle = too_few + (enough - too_few) / 2;
        if shows(middle) { enough = middle } else { too_few = middle }
    }
    Some(enough)
}

/// The fewest pairs with which Wilcoxon's signed-rank test, two-sided with an error of 1 - `confidence`, shows a difference with the probability
/// `power` (G. E. Noether, *Sample size determination for some common nonparametric tests*, 1987). It needs no normal distribution, only
/// how often the mean of two differences is above 0: [`walsh_share`]. An approximation for more than some ten pairs. `None` if
/// [`MOST_PAIRS`] are too few.
pub fn pairs_until_wilcoxon_shows(walsh_share: f64, power: f64, confidence: f64) -> Option<u32> {
    let reach = normal_reach(confidence) + normal_quantile(power);
    let pairs = (reach * reach / (3.0 * (walsh_share - 0.5).powi(2))).ceil();
    (pairs <= f64::from(MOST_PAIRS)).then_some(pairs as u32)
}

/// In how many of all pairs of two of these differences their mean is above 0, where one that is 0 counts half. `None` of fewer than two.
pub fn walsh_share(differences: &[f64]) -> Option<f64> {
    let n = differences.len();
    let above = |sum: f64| if sum > 0.0 { 1.0 } else { f64::from(u8::from(sum == 0.0)) / 2.0 };
    let of = |i: usize| differences[i + 1..].iter().map(|other| above(differences[i] + other)).sum::<f64>();
    (n >= 2).then(|| (0..n).map(of).sum::<f64>() / (n * (n - 1) / 2) as f64)
}

/// Steps of the integral over the deviation; even.
const STEPS: u32 = 2000;
/// The integral goes to so many deviations of the deviation; what is beyond is less than 1e-12.
const DEVIATIONS: f64 = 9.0;

/// The probability that a noncentral t with so many degrees of freedom is more than `reach` off 0 on either side, for a noncentrality. It is
/// `(Z + noncentrality) / s` with a normal `Z` and the deviation `s` of a normal sample; the integral over `s` is by Simpson's rule.
fn beyond(reach: f64, noncentrality: f64, freedom: f64) -> f64 {
    let half = freedom / 2.0;
    let scale = LN_2 + half * ops::ln_f64(half) - ln_gamma(half);
    let density = |s: f64| {
        if s > 0.0 {
            ops::exp_f64(scale + (freedom - 1.0) * ops::ln_f64(s) - half * s * s)
        } else {
            at_zero(freedom, scale)
        }
    };
    let tails = |s: f64| normal_cdf(noncentrality - reach * s) + normal_cdf(-noncentrality - reach * s);
    let (low, high) = (1.0 - DEVIATIONS / (2.0 * freedom).sqrt(), 1.0 + DEVIATIONS / (2.0 * freedom).sqrt());
    let low = low.max(0.0);
    let step = (high - low) / f64::from(STEPS);
    let term = |i: u32| {
        let s = low + f64::from(i) * step;
        let weight = if i == 0 || i == STEPS { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
        weight * density(s) * tails(s)
    };
    ((0..=STEPS).map(term).sum::<f64>() * step / 3.0).clamp(0.0, 1.0)
}

/// The density of the deviation at 0: only one degree of freedom has any there.
fn at_zero(freedom: f64, scale: f64) -> f64 {
    if freedom == 1.0 { ops::exp_f64(scale) } else { 0.0 }
}
