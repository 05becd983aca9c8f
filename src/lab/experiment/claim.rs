//! What is said of a matter, held against the rows of an experiment.

use serde::Serialize;

use super::figure_words::MeanWithInterval;
use super::file::{ClaimedDifference, StatedClaim};
use super::pairing::PairedRows;
use super::plan::ExperimentPlan;
use crate::lab::statistics::{Interval, PairedDifference, compare_pairs, equivalence};
use crate::rng::{DEFAULT_SEED, Seed};

/// What the rows say of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum ClaimVerdict {
    /// The whole interval lies on the side, or in the range, that the claim names.
    Held,
    /// The whole interval lies where the claim says that it does not.
    DidNotHold,
    /// The interval lies on both sides of what the claim says, or there are too few rows for one.
    CannotBeSaid,
}

impl ClaimVerdict {
    /// As people read it.
    pub const fn words(self) -> &'static str {
        match self {
            ClaimVerdict::Held => "held",
            ClaimVerdict::DidNotHold => "did not hold",
            ClaimVerdict::CannotBeSaid => "cannot be said",
        }
    }
}

/// A claim with its verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JudgedClaim {
    /// What is claimed.
    pub claim: StatedClaim,
    /// What the rows say.
    pub verdict: ClaimVerdict,
    /// By how much the treatment of the claim has more than the other with the same seeds, or than nothing if it is compared with none.
    pub difference: Option<PairedDifference>,
    /// In which the true mean of it lies: that of the bootstrap, or that of two one-sided t tests if the claim says that there is
    /// hardly any. The verdict rests on it.
    pub interval: Option<Interval>,
}

impl JudgedClaim {
    /// Why the verdict is what it is.
    pub fn reason(&self) -> String {
        let Some(difference) = &self.difference else {
            return "no seed was played to a value".into();
        };
        let mean = MeanWithInterval { value: Some(difference.mean), interval: self.interval };
        let unit = self.claim.metric.unit();
        let space = if unit.is_empty() { "" } else { " " };
        let mean = if self.claim.is.compares() { format!("{mean:+}") } else { format!("{mean}") };
        let said = format!("{mean}{space}{unit} with {} seeds", difference.pairs);
        let Some(interval) = self.interval else {
            return format!("{said}: they are too few or too even to tell the spread");
        };
        format!("{said}: {}", where_it_lies(self.claim.is, interval, difference))
    }
}

fn where_it_lies(is: ClaimedDifference, interval: Interval, difference: &PairedDifference) -> String {
    match (is, verdict(is, Some(interval))) {
        (ClaimedDifference::Within(margin), ClaimVerdict::Held) => {
            format!("all of the interval is within {margin} of 0")
        }
        (ClaimedDifference::Within(margin), ClaimVerdict::DidNotHold) => {
            format!("all of the interval is farther than {margin} from 0")
        }
        (ClaimedDifference::Within(margin), ClaimVerdict::CannotBeSaid) => {
            format!("the interval goes beyond {margin}")
        }
        (ClaimedDifference::Between(low, high), ClaimVerdict::Held) => {
            format!("all of the interval is between {low} and {high}")
        }
        (ClaimedDifference::Between(low, high), ClaimVerdict::DidNotHold) => {
            format!("none of the interval is between {low} and {high}")
        }
        (ClaimedDifference::Between(low, high), ClaimVerdict::CannotBeSaid) => {
            format!("a part of the interval is between {low} and {high}")
        }
        _ if interval.high < 0.0 => "all of the interval is below 0".into(),
        _ if interval.low > 0.0 => "all of the interval is above 0".into(),
        _ => match difference.pairs_until_shown {
            Some(pairs) if pairs as usize > difference.pairs => {
                format!("the interval holds 0; if the difference is as it seems, some {pairs} seeds show it")
            }
            _ => "the interval holds 0".into(),
        },
    }
}

/// Judges all claims of a design at a confidence. Each is judged by itself: of twenty claims that are all wrong, one may seem to hold
/// at 95 %.
pub(super) fn judge_claims(plan: &ExperimentPlan, rows: &PairedRows, confidence: f64) -> Vec<JudgedClaim> {
    let judge = |claim: &StatedClaim| {
        let [of, than] = [&claim.of, &claim.than].map(|levels| plan.file.treatment(levels));
        let pairs = match (claim.is, of, than) {
            (ClaimedDifference::Between(..), Some(of), _) => {
                rows.values(of, claim.metric).into_values().collect()
            }
            (_, Some(of), Some(than)) => rows.differences([of, than], claim.metric),
            _ => Vec::new(),
        };
        judged(claim, &pairs, confidence)
    };
    plan.file.claims.iter().map(judge).collect()
}

/// Of fewer pairs nothing is said: with five, differences that all have one sign come up once in sixteen times if there is none.
const FEWEST_PAIRS: usize = 6;

fn judged(claim: &StatedClaim, pairs: &[f64], confidence: f64) -> JudgedClaim {
    let difference = compare_pairs(pairs, confidence, Seed(DEFAULT_SEED));
    let interval = match claim.is {
        ClaimedDifference::Within(margin) => equivalence(pairs, margin, confidence).map(|test| test.interval),
        _ => difference.as_ref().and_then(|difference| difference.interval),
    };
    let interval = telling(pairs.len(), interval);
    JudgedClaim { claim: claim.clone(), verdict: verdict(claim.is, interval), difference, interval }
}

/// The interval of the difference of so many pairs, if they are enough to say something of a claim.
pub(in crate::lab) fn telling(pairs: usize, interval: Option<Interval>) -> Option<Interval> {
    interval.filter(|_| pairs >= FEWEST_PAIRS)
}

/// What the interval of a difference says of a claim.
pub(in crate::lab) fn verdict(is: ClaimedDifference, interval: Option<Interval>) -> ClaimVerdict {
    let Some(interval) = interval else { return ClaimVerdict::CannotBeSaid };
    let (less, more) = (interval.high < 0.0, interval.low > 0.0);
    let is_within = |low: f64, high: f64| low < interval.low && interval.high < high;
    let is_outside = |low: f64, high: f64| interval.high < low || high < interval.low;
    match is {
        ClaimedDifference::Less if less => ClaimVerdict::Held,
        ClaimedDifference::More if more => ClaimVerdict::Held,
        ClaimedDifference::Less | ClaimedDifference::More if less || more => ClaimVerdict::DidNotHold,
        ClaimedDifference::Within(margin) if is_within(-margin, margin) => ClaimVerdict::Held,
        ClaimedDifference::Within(margin) if is_outside(-margin, margin) => ClaimVerdict::DidNotHold,
        ClaimedDifference::Between(low, high) if is_within(low, high) => ClaimVerdict::Held,
        ClaimedDifference::Between(low, high) if is_outside(low, high) => ClaimVerdict::DidNotHold,
        _ => ClaimVerdict::CannotBeSaid,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::experiment::metric::Metric;

    const CLEAR: [f64; 8] = [-1.0, -1.2, -0.8, -1.1, -0.9, -1.3, -0.7, -1.0];
    const UNCLEAR: [f64; 8] = [-1.0, 1.2, -0.8, 1.1, -0.9, 1.3, -0.7, 1.0];

    fn judge(is: ClaimedDifference, differences: &[f64]) -> JudgedClaim {
        let claim = StatedClaim {
            says: "It rains less".into(),
            source: "ours".into(),
            metric: Metric::Driven,
            of: Vec::new(),
            than: Vec::new(),
            is,
        };
        judged(&claim, differences, 0.95)
    }

    fn verdict_on(is: ClaimedDifference, differences: &[f64]) -> ClaimVerdict {
        judge(is, differences).verdict
    }

    #[test]
    fn a_claim_holds_only_where_the_whole_interval_is_on_its_side() {
        use ClaimedDifference::{Less, More};
        assert_eq!(verdict_on(Less, &CLEAR), ClaimVerdict::Held);
        assert_eq!(verdict_on(More, &CLEAR), ClaimVerdict::DidNotHold);
        assert_eq!([Less, More].map(|is| verdict_on(is, &UNCLEAR)), [ClaimVerdict::CannotBeSaid; 2]);
        assert_eq!(verdict_on(Less, &[]), ClaimVerdict::CannotBeSaid);
        assert_eq!(verdict_on(Less, &CLEAR[..6]), ClaimVerdict::Held);
        assert_eq!(verdict_on(Less, &CLEAR[..5]), ClaimVerdict::CannotBeSaid, "they are too few");
        assert_eq!(
            verdict_on(Less, &[-1.0; 9]),
            ClaimVerdict::CannotBeSaid,
            "nothing is known of the spread"
        );
    }

    #[test]
    fn two_treatments_are_as_good_as_equal_only_where_the_margin_holds_the_interval() {
        use ClaimedDifference::Within;
        assert_eq!(verdict_on(Within(1.5), &CLEAR), ClaimVerdict::Held);
        assert_eq!(verdict_on(Within(0.5), &CLEAR), ClaimVerdict::DidNotHold);
        assert_eq!(verdict_on(Within(1.0), &CLEAR), ClaimVerdict::CannotBeSaid);
        assert_eq!(verdict_on(Within(0.1), &UNCLEAR), ClaimVerdict::CannotBeSaid);
        assert!(judge(Within(1.5), &CLEAR).reason().ends_with("all of the interval is within 1.5 of 0"));
    }

    #[test]
    fn a_mean_is_between_two_numbers_only_where_all_of_its_interval_is() {
        use ClaimedDifference::Between;
        assert_eq!(verdict_on(Between(-1.5, -0.5), &CLEAR), ClaimVerdict::Held);
        assert_eq!(verdict_on(Between(0.5, 1.5), &CLEAR), ClaimVerdict::DidNotHold);
        assert_eq!(verdict_on(Between(-1.0, 1.0), &CLEAR), ClaimVerdict::CannotBeSaid);
        let reason = judge(Between(-1.5, -0.5), &CLEAR).reason();
        assert!(reason.ends_with("all of the interval is between -1.5 and -0.5"), "{reason}");
    }

    #[test]
    fn a_verdict_says_why() {
        use ClaimedDifference::Less;
        let held = judge(Less, &CLEAR).reason();
        assert!(held.starts_with("-1.000 [-1.1"), "{held}");
        assert!(held.ends_with(" m/min with 8 seeds: all of the interval is below 0"), "{held}");
        let unclear = judge(Less, &UNCLEAR).reason();
        assert!(
            unclear.contains("the interval holds 0; if the difference is as it seems, some "),
            "{unclear}"
        );
        assert!(judge(Less, &[-1.0; 9]).reason().ends_with("too even to tell the spread"));
        assert_eq!(judge(Less, &[]).reason(), "no seed was played to a value");
    }
}
