//! A share of trials and how sure it is.

use serde::Serialize;
use statrs::distribution::{Beta, ContinuousCDF};

use super::interval::Interval;
use super::quantiles::{crossing, normal_reach};

/// How many of some trials went one way, with Wilson's interval of 95 % for the share.
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
        let (won_trials, n) = (f64::from(won), f64::from(of));
        let Interval { low, high } = wilson(won_trials, n, CONFIDENCE);
        Share { won, of, share: won_trials / n, low, high }
    }
}

/// Wilson's interval for the share of `won` in `n` trials, more than 0 (E. B. Wilson, *Probable inference, the law of succession, and
/// statistical inference*, 1927). It holds the true share in about this share of cases; a draw may count as half a trial won.
pub fn wilson(won: f64, n: f64, confidence: f64) -> Interval {
    let (p, z) = (won / n, normal_reach(confidence));
    let weight = z * z / n;
    let centre = (p + weight / 2.0) / (1.0 + weight);
    let half = z * (p * (1.0 - p) / n + weight / (4.0 * n)).sqrt() / (1.0 + weight);
    Interval { low: (centre - half).max(0.0), high: (centre + half).min(1.0) }
}

/// The exact interval for the share of `won` in `of` trials: it holds the true share in at least this share of cases, whatever that is
/// (C. J. Clopper and E. S. Pearson, *The use of confidence or fiducial limits illustrated in the case of the binomial*, 1934). From 0
/// to 1 of no trials.
pub fn clopper_pearson(won: u32, of: u32, confidence: f64) -> Interval {
    let tail = 0.5 - confidence / 2.0;
    let quantile = |won: f64, lost: f64, share: f64| {
        Beta::new(won, lost).ok().map(|beta| crossing(|at| beta.cdf(at) - share, 0.0, 1.0))
    };
    let (won, lost) = (f64::from(won), f64::from(of) - f64::from(won));
    Interval {
        low: quantile(won, lost + 1.0, tail).unwrap_or(0.0),
        high: quantile(won + 1.0, lost, 1.0 - tail).unwrap_or(1.0),
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
        assert_eq!(clopper_pearson(0, 0, 0.95), Interval { low: 0.0, high: 1.0 });
    }
}
