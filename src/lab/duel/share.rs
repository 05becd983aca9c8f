//! A share of trials and how sure it is.

use serde::Serialize;
use statrs::distribution::{ContinuousCDF, Normal};

/// How many of some trials went one way, with Wilson's interval of 95 % for the share (E. B. Wilson, *Probable inference, the law of
/// succession, and statistical inference*, 1927).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Share {
    /// The trials that did.
    pub won: u32,
    /// All trials that count.
    pub of: u32,
    /// `won` / `of`; a half if no trial counts.
    pub share: f64,
    /// The lower end of the interval.
    pub low: f64,
    /// The upper end of the interval.
    pub high: f64,
}

/// The interval holds the share in so many cases.
const CONFIDENCE: f64 = 0.95;

impl Share {
    /// The share of `won` in `of` trials.
    pub fn new(won: u32, of: u32) -> Share {
        if of == 0 {
            return Share { won, of, share: 0.5, low: 0.0, high: 1.0 };
        }
        let (n, p) = (f64::from(of), f64::from(won) / f64::from(of));
        let z = Normal::standard().inverse_cdf(0.5 + CONFIDENCE / 2.0);
        let weight = z * z / n;
        let centre = (p + weight / 2.0) / (1.0 + weight);
        let half = z * (p * (1.0 - p) / n + weight / (4.0 * n)).sqrt() / (1.0 + weight);
        Share { won, of, share: p, low: (centre - half).max(0.0), high: (centre + half).min(1.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn assert_interval(share: Share, low: f64, high: f64) {
        assert!((share.low - low).abs() < 5e-5 && (share.high - high).abs() < 5e-5, "{share:?}");
    }

    /// The limits by Newcombe, *Two-sided confidence intervals for the single proportion*, 1998, table I, method 3.
    #[test]
    fn the_interval_is_that_of_published_examples() {
        assert_interval(Share::new(81, 263), 0.2553, 0.3662);
        assert_interval(Share::new(15, 148), 0.0624, 0.1605);
        assert_interval(Share::new(0, 20), 0.0, 0.1611);
        assert_interval(Share::new(1, 29), 0.0061, 0.1718);
    }

    #[test]
    fn of_no_trials_nothing_is_known() {
        let share = Share::new(0, 0);
        assert_eq!((share.share, share.low, share.high), (0.5, 0.0, 1.0));
    }
}
