//! Everything that paired matches say about a difference, at once.

use serde::Serialize;

use super::average::{mean_of_some, median};
use super::bootstrap::{RESAMPLES, bca_interval, resampled};
use super::effect::{cohens_d_z, rank_biserial};
use super::improvement::{Improvement, improvement_of_pairs};
use super::interval::Interval;
use super::power::{pairs_until_wilcoxon_shows, walsh_share};
use super::signed_rank::{SignedRank, signed_rank};
use crate::rng::{Dice, Seed};

/// What is known of a difference, first less second, in the unit of its metric. What cannot be said is `None`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PairedDifference {
    /// How many pairs.
    pub pairs: usize,
    /// The mean difference.
    pub mean: f64,
    /// The bias-corrected and accelerated bootstrap interval of the mean difference.
    pub interval: Option<Interval>,
    /// The difference in the middle.
    pub median: f64,
    /// Whether the differences lie about 0.
    pub signed_rank: Option<SignedRank>,
    /// The mean difference in standard deviations.
    pub cohens_d_z: Option<f64>,
    /// The share of ranks above 0 less the share below.
    pub rank_biserial: Option<f64>,
    /// How likely the first does better.
    pub improvement: Improvement,
    /// If the truth is as these differences, so many pairs show it by Wilcoxon's test in nine cases of ten.
    pub pairs_until_shown: Option<u32>,
}

/// Of [`PairedDifference::pairs_until_shown`].
const POWER: f64 = 0.9;

/// Compares by differences, first less second, of pairs of matches that have one seed each; `None` of no pair. The seed is that of
/// the bootstrap's dice: the same differences and seed give the same interval.
pub fn compare_pairs(differences: &[f64], confidence: f64, seed: Seed) -> Option<PairedDifference> {
    let improvement = improvement_of_pairs(differences, confidence)?;
    let mut dice = Dice::new(seed, "bootstrap", None);
    let resamples = resampled(differences, mean_of_some, RESAMPLES, &mut dice);
    Some(PairedDifference {
        pairs: differences.len(),
        mean: mean_of_some(differences),
        interval: bca_interval(differences, mean_of_some, resamples, confidence),
        median: median(differences)?,
        signed_rank: signed_rank(differences),
        cohens_d_z: cohens_d_z(differences),
        rank_biserial: rank_biserial(differences),
        improvement,
        pairs_until_shown: pairs_until_shown(differences, confidence),
    })
}

/// How many pairs show a difference by Wilcoxon's test in nine cases of ten, if the truth is as these differences.
pub fn pairs_until_shown(differences: &[f64], confidence: f64) -> Option<u32> {
    walsh_share(differences).and_then(|share| pairs_until_wilcoxon_shows(share, POWER, confidence))
}
