//! Below which values a share of a distribution lies.

use statrs::distribution::{Continuous, ContinuousCDF, Normal, StudentsT};

/// The standard normal distribution's quantile; `share` is between 0 and 1.
pub(super) fn normal_quantile(share: f64) -> f64 {
    Normal::standard().inverse_cdf(share)
}

/// The standard normal distribution's share below a value.
pub(super) fn normal_cdf(value: f64) -> f64 {
    Normal::standard().cdf(value)
}

/// Student's t distribution with so many degrees of freedom, more than 0.
pub(super) fn student(freedom: f64) -> Option<StudentsT> {
    StudentsT::new(0.0, 1.0, freedom).ok()
}

/// How many standard errors an interval of Student's reaches to either side, so that it holds the mean in this share of cases.
pub(super) fn student_reach(confidence: f64, freedom: f64) -> Option<f64> {
    let share = 0.5 + confidence / 2.0;
    let student = student(freedom)?;
    // The library's inverse stops a few digits early with few degrees of freedom; Newton's steps bring the rest.
    let refined = |at: f64, _: u8| at - (student.cdf(at) - share) / student.pdf(at);
    let reach = (0..3).fold(student.inverse_cdf(share), refined);
    reach.is_finite().then_some(reach)
}

/// How many standard errors a normal interval reaches to either side, so that it holds its centre's true value in this share of cases.
pub(super) fn normal_reach(confidence: f64) -> f64 {
    normal_quantile(0.5 + confidence / 2.0)
}

/// Where a rising function crosses 0 between two values, by halving; one of the ends if it does not.
pub(super) fn crossing(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if function(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
