//! Solid bodies do not share a place: how deep the ball has sunk into robots and walls.

use serde::Serialize;

/// How far a match was from keeping the ball out of robots and walls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct BallOverlap {
    /// How often, once for each body and tick, the ball was deeper than [`TOLERANCE`] in a body.
    pub body_ticks: u64,
    /// The deepest of all, m.
    pub deepest: f32,
    /// The deepest of the last tick, m.
    #[serde(skip)]
    pub(super) now: f32,
}

/// The contacts of the physics are springs; a ball may press them in so far, m.
pub const TOLERANCE: f32 = 0.002;

impl BallOverlap {
    /// How deep the ball is in each body that it touches in this tick.
    pub(super) fn update(&mut self, depths: impl Iterator<Item = f32>) {
        self.now = 0.0;
        for depth in depths {
            self.add(depth);
        }
    }

    fn add(&mut self, depth: f32) {
        self.now = self.now.max(depth);
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
        for depths in [[0.001, 0.0021], [0.03, 0.002], [0.004, 0.0]] {
            overlap.update(depths.into_iter());
        }
        assert_eq!(overlap, BallOverlap { body_ticks: 3, deepest: 0.03, now: 0.004 });
    }
}
