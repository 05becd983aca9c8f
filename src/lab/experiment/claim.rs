//! What is said of a matter, held against the rows of an experiment.

use serde::Serialize;

use super::file::{ClaimedDifference, StatedClaim};
use super::pairing::PairedRows;
use super::plan::ExperimentPlan;
use crate::lab::statistics::{PairedDifference, compare_pairs};
use crate::rng::{DEFAULT_SEED, Seed};

/// What the rows say of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum ClaimVerdict {
    /// The whole interval of the difference lies on the side that the claim names.
    Held,
    /// The whole interval lies on the other side.
    DidNotHold,
    /// The interval holds 0, or there are too few rows for one.
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
    /// By how much the treatment of the claim has more than the other with the same seeds.
    pub difference: Option<PairedDifference>,
}

/// Judges all claims of a design at a confidence. Each is judged by itself: of twenty claims that are all wrong, one may seem to hold
/// at 95 %.
pub(super) fn judge_claims(plan: &ExperimentPlan, rows: &PairedRows, confidence: f64) -> Vec<JudgedClaim> {
    let judge = |claim: &StatedClaim| {
        let treatments = [&claim.of, &claim.than].map(|levels| plan.file.treatment(levels));
        let difference = match treatments {
            [Some(of), Some(than)] => {
                let pairs = rows.differences([of, than], claim.metric);
                compare_pairs(&pairs, confidence, Seed(DEFAULT_SEED))
            }
            _ => None,
        };
        JudgedClaim { claim: claim.clone(), verdict: verdict(claim.is, difference.as_ref()), difference }
    };
    plan.file.claims.iter().map(judge).collect()
}

/// What a difference says of a claim.
pub(in crate::lab) fn verdict(is: ClaimedDifference, difference: Option<&PairedDifference>) -> ClaimVerdict {
    let Some(interval) = difference.and_then(|difference| difference.interval) else {
        return ClaimVerdict::CannotBeSaid;
    };
    let (less, more) = (interval.high < 0.0, interval.low > 0.0);
    match is {
        ClaimedDifference::Less if less => ClaimVerdict::Held,
        ClaimedDifference::More if more => ClaimVerdict::Held,
        _ if less || more => ClaimVerdict::DidNotHold,
        _ => ClaimVerdict::CannotBeSaid,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(is: ClaimedDifference, differences: &[f64]) -> ClaimVerdict {
        verdict(is, compare_pairs(differences, 0.95, Seed(1)).as_ref())
    }

    #[test]
    fn a_claim_holds_only_where_the_whole_interval_is_on_its_side() {
        use ClaimedDifference::{Less, More};
        let clear = [-1.0, -1.2, -0.8, -1.1, -0.9, -1.3, -0.7, -1.0];
        let unclear = [-1.0, 1.2, -0.8, 1.1, -0.9, 1.3, -0.7, 1.0];
        assert_eq!(judged(Less, &clear), ClaimVerdict::Held);
        assert_eq!(judged(More, &clear), ClaimVerdict::DidNotHold);
        assert_eq!([Less, More].map(|is| judged(is, &unclear)), [ClaimVerdict::CannotBeSaid; 2]);
        assert_eq!(judged(Less, &[]), ClaimVerdict::CannotBeSaid);
        assert_eq!(judged(Less, &[-1.0; 9]), ClaimVerdict::CannotBeSaid, "nothing is known of the spread");
    }
}
