//! Intervals for any statistic, from samples drawn of the sample.

use super::average::quantile_of_sorted;
use super::interval::Interval;
use super::quantiles::{normal_cdf, normal_quantile};
use crate::rng::Dice;

/// So many samples are drawn where nobody says how many: the ends of an interval of 95 % then move by some hundredths of its width.
pub const RESAMPLES: usize = 10_000;

/// A statistic of samples of the same size that are drawn with replacement from a sample.
pub fn resampled(
    values: &[f64],
    statistic: impl Fn(&[f64]) -> f64,
    resamples: usize,
    dice: &mut Dice,
) -> Vec<f64> {
    if values.is_empty() {
        return Vec::new();
    }
    let mut drawn = vec![0.0; values.len()];
    let draw = |_| {
        drawn.fill_with(|| values[dice.below(values.len())]);
        statistic(&drawn)
    };
    (0..resamples).map(draw).collect()
}

/// The bias-corrected and accelerated interval of a statistic, with its values in resamples as [`resampled`] draws them (B. Efron,
/// *Better bootstrap confidence intervals*, 1987).
///
/// `None` where the statistic is the same without any of the values, or lies beyond all resamples: nothing is known of its spread.
pub fn bca_interval(
    values: &[f64],
    statistic: impl Fn(&[f64]) -> f64,
    mut resamples: Vec<f64>,
    confidence: f64,
) -> Option<Interval> {
    if values.len() < 2 || resamples.is_empty() {
        return None;
    }
    let bias = bias(statistic(values), &resamples)?;
    let acceleration = acceleration(values, statistic)?;
    resamples.sort_unstable_by(f64::total_cmp);
    let end = |share: f64| {
        let moved = bias + normal_quantile(share);
        quantile_of_sorted(&resamples, normal_cdf(bias + moved / (1.0 - acceleration * moved)))
    };
    let tail = 0.5 - confidence / 2.0;
    let interval = Interval { low: end(tail), high: end(1.0 - tail) };
    (interval.low.is_finite() && interval.high.is_finite()).then_some(interval)
}

/// From where to where the middle share of resamples reaches (B. Efron, *Bootstrap methods: another look at the jackknife*, 1979): plainer than
/// [`bca_interval`], for statistics that take long. `None` of no resample, or if one is not finite.
pub fn percentile_interval(mut resamples: Vec<f64>, confidence: f64) -> Option<Interval> {
    if resamples.is_empty() || resamples.iter().any(|value| !value.is_finite()) {
        return None;
    }
    resamples.sort_unstable_by(f64::total_cmp);
    let tail = 0.5 - confidence / 2.0;
    Some(Interval {
        low: quantile_of_sorted(&resamples, tail),
        high: quantile_of_sorted(&resamples, 1.0 - tail),
    })
}

/// By how many deviations the statistic lies off the middle of its resamples; those that are equal to it count half.
fn bias(statistic: f64, resamples: &[f64]) -> Option<f64> {
    let below = resamples.iter().filter(|it| **it < statistic).count();
    let up_to = resamples.iter().filter(|it| **it <= statistic).count();
    let bias = normal_quantile((below + up_to) as f64 / (2 * resamples.len()) as f64);
    bias.is_finite().then_some(bias)
}

/// How the deviation of the statistic grows with its value: from the skewness of its values without one value of the sample each.
fn acceleration(values: &[f64], statistic: impl Fn(&[f64]) -> f64) -> Option<f64> {
    let without = |left_out: usize| {
        let others = values.iter().enumerate().filter(|(i, _)| *i != left_out).map(|(_, value)| *value);
        statistic(&others.collect::<Vec<f64>>())
    };
    let jackknife: Vec<f64> = (0..values.len()).map(without).collect();
    let centre = jackknife.iter().sum::<f64>() / jackknife.len() as f64;
    let moment = |power| jackknife.iter().map(|value| (centre - value).powi(power)).sum::<f64>();
    let square = moment(2);
    let is_spread = square > f64::EPSILON * centre * centre;
    is_spread.then(|| moment(3) / (6.0 * square * square.sqrt()))
}
