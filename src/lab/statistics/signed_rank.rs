//! Wilcoxon's signed-rank test: whether paired differences lie about 0.

use serde::Serialize;

use super::quantiles::normal_cdf;

/// What the ranks of differences say (F. Wilcoxon, *Individual comparisons by ranking methods*, 1945).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SignedRank {
    /// The differences that are not 0: only these count.
    pub count: usize,
    /// The sum of the ranks of those above 0.
    pub above: f64,
    /// The sum of the ranks of those below 0.
    pub below: f64,
    /// How likely sums so far apart are, in either direction, if each difference might as well have had the other sign.
    pub p: f64,
    /// How `p` was found.
    pub method: TailMethod,
}

/// How the tail of a test's distribution was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum TailMethod {
    /// All ways to give the ranks their signs were counted; ties are no matter.
    Exact,
    /// By a normal distribution, with the corrections for ties and for continuity.
    Normal,
}

/// Up to so many differences are counted exactly.
const MOST_EXACT: usize = 50;

/// Wilcoxon's test of paired differences, two-sided. Differences of 0 are left out, and equal ones have the mean of their ranks.
///
/// Up to 50 differences the distribution is exact, with ties as without, where scipy takes it for normal from 14 on if there are ties or
/// zeros; beyond 50 it is normal, as in scipy. `None` if no difference is left.
pub fn signed_rank(differences: &[f64]) -> Option<SignedRank> {
    let method =
        if counting(differences).count() > MOST_EXACT { TailMethod::Normal } else { TailMethod::Exact };
    signed_rank_by(method, differences)
}

/// As [`signed_rank`], by this method.
pub(super) fn signed_rank_by(method: TailMethod, differences: &[f64]) -> Option<SignedRank> {
    let kept: Vec<f64> = counting(differences).collect();
    if kept.is_empty() {
        return None;
    }
    let ranks = ranks_of_sizes(&kept);
    let sum = |is_above| {
        let of = kept.iter().zip(&ranks).filter(|(value, _)| (**value > 0.0) == is_above);
        of.map(|(_, rank)| rank).sum::<f64>()
    };
    let (above, below) = (sum(true), sum(false));
    let p = match method {
        TailMethod::Exact => exact_p(&ranks, above.min(below)),
        TailMethod::Normal => normal_p(&ranks, above),
    };
    Some(SignedRank { count: kept.len(), above, below, p, method })
}

fn counting(differences: &[f64]) -> impl Iterator<Item = f64> {
    differences.iter().copied().filter(|value| value.is_finite() && *value != 0.0)
}

/// The ranks of values by their size, from 1; equal ones share the mean of theirs.
fn ranks_of_sizes(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_unstable_by(|a, b| values[*a].abs().total_cmp(&values[*b].abs()));
    let mut ranks = vec![0.0; values.len()];
    let mut before = 0;
    for equal in order.chunk_by(|a, b| values[*a].abs() == values[*b].abs()) {
        let rank = before as f64 + (equal.len() as f64 + 1.0) / 2.0;
        equal.iter().for_each(|index| ranks[*index] = rank);
        before += equal.len();
    }
    ranks
}

/// Twice the share of all choices of signs whose sum of positive ranks is at most this one.
fn exact_p(ranks: &[f64], sum: f64) -> f64 {
    // A mean of ranks may end in a half, so twice the ranks are whole. `ways[s]` counts the choices whose doubled sum is `s`.
    let doubled = |rank: f64| (2.0 * rank).round() as usize;
    let mut ways = vec![0.0; ranks.iter().map(|rank| doubled(*rank)).sum::<usize>() + 1];
    ways[0] = 1.0;
    for rank in ranks {
        let rank = doubled(*rank);
        for s in (rank..ways.len()).rev() {
            ways[s] += ways[s - rank];
        }
    }
    let all = 2.0_f64.powi(ranks.len() as i32);
    (2.0 * ways[..=doubled(sum)].iter().sum::<f64>() / all).min(1.0)
}

fn normal_p(ranks: &[f64], above: f64) -> f64 {
    let n = ranks.len() as f64;
    let off = above - n * (n + 1.0) / 4.0;
    let variance = (n * (n + 1.0) * (2.0 * n + 1.0) - ties(ranks) / 2.0) / 24.0;
    let corrected = if off == 0.0 { 0.0 } else { off.abs() - 0.5 };
    (2.0 * normal_cdf(-corrected / variance.sqrt())).min(1.0)
}

/// The sum of `t³ - t` over all groups of `t` equal ranks.
fn ties(ranks: &[f64]) -> f64 {
    let mut sorted = ranks.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let sizes = sorted.chunk_by(|a, b| a == b).map(|group| group.len() as f64);
    sizes.map(|size| size.powi(3) - size).sum()
}
