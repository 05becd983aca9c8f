//! How far the ball is.

use serde::{Deserialize, Serialize};

/// A distance in millimetres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Distance(pub u32);

impl Distance {
    /// That of a booker that lost the ball: any other distance is smaller, by any threshold.
    pub const INFINITE: Distance = Distance(u32::MAX);

    /// To the nearest millimetre. A negative distance is none at all, and what is no finite number is infinite.
    pub fn from_metres(metres: f32) -> Distance {
        let millimetres = (metres * 1000.0).round();
        let finite = Distance(millimetres.min(4e9) as u32);
        if millimetres.is_finite() { finite } else { Distance::INFINITE }
    }

    /// In metres.
    pub fn metres(self) -> f32 {
        if self == Distance::INFINITE { f32::INFINITY } else { self.0 as f32 / 1000.0 }
    }

    /// Whether the booker cannot reach the ball.
    pub fn is_infinite(self) -> bool {
        self == Distance::INFINITE
    }

    /// Whether this is less than the other by at least the threshold.
    pub fn is_nearer(self, threshold: Distance, than: Distance) -> bool {
        !self.is_infinite() && self.0.saturating_add(threshold.0) <= than.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metres_become_millimetres_and_back() {
        assert_eq!(Distance::from_metres(1.2345), Distance(1235));
        assert_eq!(Distance(1235).metres(), 1.235);
        assert_eq!(Distance::from_metres(0.0), Distance(0));
    }

    #[test]
    fn what_is_no_distance_becomes_one() {
        assert_eq!(Distance::from_metres(-0.4), Distance(0));
        assert_eq!(Distance::from_metres(1e7), Distance(4_000_000_000));
        for metres in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX] {
            assert_eq!(Distance::from_metres(metres), Distance::INFINITE);
        }
        assert_eq!(Distance::INFINITE.metres(), f32::INFINITY);
    }

    #[test]
    fn nearer_is_nearer_by_the_whole_threshold() {
        let threshold = Distance(100);
        assert!(Distance(400).is_nearer(threshold, Distance(500)));
        assert!(!Distance(401).is_nearer(threshold, Distance(500)));
        assert!(Distance(500).is_nearer(Distance(0), Distance(500)));
    }

    #[test]
    fn anything_is_nearer_than_infinity_but_infinity_is_not() {
        assert!(Distance(u32::MAX - 1).is_nearer(Distance::INFINITE, Distance::INFINITE));
        assert!(!Distance::INFINITE.is_nearer(Distance(0), Distance::INFINITE));
        assert!(!Distance::INFINITE.is_nearer(Distance(0), Distance(7)));
    }
}
