//! The middle of a sample, and how sure it is.

use statrs::statistics::{Data, OrderStatistics, Statistics};

use super::interval::Interval;
use super::quantiles::student_reach;

/// The arithmetic mean; `None` of nothing.
pub fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| mean_of_some(values))
}

/// The arithmetic mean of one value at least: whole numbers in any order have the same.
pub(super) fn mean_of_some(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The value in the middle, or the mean of the two there; `None` of nothing.
pub fn median(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| Data::new(values.to_vec()).median())
}

/// Below which a share of the values lies, linear between the sorted values; `None` of nothing.
pub fn quantile(values: &[f64], share: f64) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    (!sorted.is_empty()).then(|| quantile_of_sorted(&sorted, share))
}

/// The same of one sorted value at least, from the first at 0 to the last at 1.
pub(super) fn quantile_of_sorted(sorted: &[f64], share: f64) -> f64 {
    let at = share * (sorted.len() - 1) as f64;
    let below = sorted[at.floor() as usize];
    below + at.fract() * (sorted[at.ceil() as usize] - below)
}

/// A mean and how far the values lie from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleMoments {
    /// How many values.
    pub count: usize,
    /// Their arithmetic mean.
    pub mean: f64,
    /// Their standard deviation, with one value less than there are for the divisor.
    pub deviation: f64,
}

impl SampleMoments {
    /// Of two values at least.
    pub fn of(values: &[f64]) -> Option<SampleMoments> {
        let count = values.len();
        (count >= 2).then(|| SampleMoments { count, mean: mean_of_some(values), deviation: values.std_dev() })
    }

    /// Degrees of freedom of the deviation.
    pub(super) fn freedom(self) -> f64 {
        self.count as f64 - 1.0
    }

    /// The standard deviation of the mean.
    pub fn standard_error(self) -> f64 {
        self.deviation / (self.count as f64).sqrt()
    }

    /// An interval that holds the true mean in this share of cases if the mean of so many values is normal (Student, *The probable
    /// error of a mean*, 1908).
    pub fn interval(self, confidence: f64) -> Option<Interval> {
        let reach = student_reach(confidence, self.freedom())?;
        Some(Interval::around(self.mean, reach * self.standard_error()))
    }
}

/// As [`SampleMoments::interval`], of two values at least.
pub fn mean_interval(values: &[f64], confidence: f64) -> Option<Interval> {
    SampleMoments::of(values)?.interval(confidence)
}
