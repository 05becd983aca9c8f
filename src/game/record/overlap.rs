//! Solid bodies do not share a place: how deep the ball has sunk into robots and walls.

use serde::Serialize;

/// How far a match was from keeping the ball out of robots and walls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct BallOverlap {
    /// How often, once for each body and tick, the ball was deeper than [`TOLERANCE`] in a body.
    pub body_ticks: u64,
    /// The deepest of all, m.
    pub deepest: f32,
}

/// The contacts of the physics are springs; a ball may press them in so far, m.
pub const TOLERANCE: f32 = 0.002;

impl BallOverlap {
    pub(super) fn add(&mut self, depth: f32) {
        self.body_ticks += u64::from(depth > TOLERANCE);
        self.deepest = self.deepest.max(depth);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_deeper_than_the_tolerance_is_counted_and_the_deepest_of_all_is_kept() {
        let mut overlap = BallOverlap::default();
        for depth in [0.001, 0.0021, 0.03, 0.002, 0.004] {
            overlap.add(depth);
        }
        assert_eq!(overlap, BallOverlap { body_ticks: 3, deepest: 0.03 });
    }
}
