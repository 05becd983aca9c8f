//! How long something lasted, in all and at a stretch.

use serde::Serialize;

/// How long something lasted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Span {
    /// In all, s.
    pub total: f64,
    /// At a stretch, s.
    pub longest: f64,
    /// For how long it holds by now, s.
    #[serde(skip)]
    pub now: f64,
}

impl Span {
    /// Whether it holds for the next `dt` seconds.
    pub(super) fn update(&mut self, holds: bool, dt: f64) {
        if holds {
            self.total += dt;
            self.now += dt;
            self.longest = self.longest.max(self.now);
        } else {
            self.now = 0.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_stretch_is_kept() {
        let mut span = Span::default();
        for holds in [true, true, false, true, true, true, false, true] {
            span.update(holds, 0.5);
        }
        assert_eq!((span.total, span.longest), (3.0, 1.5));
    }
}
