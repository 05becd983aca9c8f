//! Whether two strategies differ by no more than matters.

use serde::Serialize;
use statrs::distribution::ContinuousCDF;

use super::average::SampleMoments;
use super::interval::Interval;
use super::quantiles::student;

/// What paired differences say about "no difference larger than a margin".
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Equivalence {
    /// The largest difference that does not matter, in the unit of the differences.
    pub margin: f64,
    /// The error that one risks by saying that the mean difference is smaller than the margin: the larger one of two one-sided t tests.
    pub p: f64,
    /// The mean difference lies in it; the difference is smaller than the margin if all of it is.
    pub interval: Interval,
    /// Whether the difference is said to be smaller than the margin.
    pub holds: bool,
}

/// Two one-sided t tests of paired differences (D. J. Schuirmann, *A comparison of the two one-sided tests procedure and the power
/// approach*, 1987), each with an error of at most 1 - `confidence`; the interval that goes with them is of `2 confidence - 1`, such as 90 %
/// for 0.95. `None` of fewer than two differences, or if all are equal.
pub fn equivalence(differences: &[f64], margin: f64, confidence: f64) -> Option<Equivalence> {
    let spread = SampleMoments::of(differences).filter(|spread| spread.deviation > 0.0)?;
    let student = student(spread.freedom())?;
    let error = spread.standard_error();
    let too_low = student.sf((spread.mean + margin) / error);
    let too_high = student.cdf((spread.mean - margin) / error);
    let p = too_low.max(too_high);
    let interval = spread.interval(2.0 * confidence - 1.0)?;
    Some(Equivalence { margin, p, interval, holds: p <= 1.0 - confidence })
}
