//! What numbers from many matches say, and how sure that is. Everything here is pure: numbers and dice in, numbers out.
//!
//! A sample is a slice with one value a match, in the unit of its metric and in the order of the seeds. What a sample is too small or
//! too even for is `None`, never a number. `statrs` has the distributions; a test compares everything here with scipy.

mod average;
mod bootstrap;
mod compare;
mod effect;
mod equivalence;
mod improvement;
mod interval;
mod power;
mod probability;
mod quantiles;
mod share;
mod signed_rank;
#[cfg(test)]
mod tests;
mod until_width;

pub use average::{SampleMoments, mean, mean_interval, median, quantile};
pub use bootstrap::{RESAMPLES, bca_interval, percentile_interval, resampled};
pub use compare::{PairedDifference, compare_pairs, pairs_until_shown};
pub use effect::{cohens_d_z, rank_biserial};
pub use equivalence::{Equivalence, equivalence};
pub use improvement::{Improvement, improvement_of_pairs, improvement_of_samples};
pub use interval::Interval;
pub use power::{
    MOST_PAIRS, paired_t_power, pairs_until_t_test_shows, pairs_until_wilcoxon_shows, walsh_share,
};
pub use probability::{ProbabilityTest, TestCount, TestVerdict};
pub use share::{Share, clopper_pearson, wilson};
pub use signed_rank::{SignedRank, TailMethod, signed_rank};
pub use until_width::{FIRST_LOOK, LOOK_EVERY, UntilWidth, WidthVerdict};
