//! Ranges with their uncertainty, and how several of one thing are made one.

use crate::ops;

/// A measured range and its standard deviation, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeEstimate {
    pub range: f32,
    pub deviation: f32,
}

impl RangeEstimate {
    /// To a place so much farther, as the middle of a thing is whose near side was measured.
    pub fn beyond(self, depth: f32) -> RangeEstimate {
        RangeEstimate { range: (self.range + depth).max(0.0), ..self }
    }

    /// The same range, less sure.
    pub fn less_sure(self, deviation: f32) -> RangeEstimate {
        RangeEstimate { deviation: ops::hypot(self.deviation, deviation), ..self }
    }
}

/// The estimates as one, each with the weight of its inverse variance; nothing of nothing.
pub fn fuse(estimates: impl IntoIterator<Item = Option<RangeEstimate>>) -> Option<RangeEstimate> {
    let (mut weights, mut weighted) = (0.0, 0.0);
    for RangeEstimate { range, deviation } in estimates.into_iter().flatten() {
        let weight = 1.0 / (deviation * deviation).max(f32::MIN_POSITIVE);
        weights += weight;
        weighted += weight * range;
    }
    (weights > 0.0).then(|| RangeEstimate { range: weighted / weights, deviation: (1.0 / weights).sqrt() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_surer_of_two_estimates_counts_more() {
        let estimate = |range, deviation| Some(RangeEstimate { range, deviation });
        let both = fuse([estimate(1.0, 0.1), None, estimate(2.0, 0.2)]).unwrap();
        assert!((both.range - 1.2).abs() < 1e-6 && both.deviation < 0.1, "{both:?}");
        assert_eq!(fuse([None, None]), None);
    }
}
