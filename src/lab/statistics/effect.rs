//! How large a difference is, without a unit.

use super::average::SampleMoments;
use super::signed_rank::signed_rank;

/// The mean of paired differences in standard deviations of these differences (J. Cohen, *Statistical power analysis for the behavioral
/// sciences*, 1988, there d_z). `None` of fewer than two differences, or if all are equal.
pub fn cohens_d_z(differences: &[f64]) -> Option<f64> {
    let spread = SampleMoments::of(differences)?;
    (spread.deviation > 0.0).then(|| spread.mean / spread.deviation)
}

/// The rank-biserial correlation of paired differences, from -1 (all below 0) to 1 (all above): by how much the share of the ranks that is
/// above 0 exceeds the share below (D. S. Kerby, *The simple difference formula*, 2014). Differences of 0 do not count; `None` if no other
/// is there.
pub fn rank_biserial(differences: &[f64]) -> Option<f64> {
    let ranks = signed_rank(differences)?;
    Some((ranks.above - ranks.below) / (ranks.above + ranks.below))
}
