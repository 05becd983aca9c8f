//! What the matches of a soak are drawn from.

use bevy::prelude::Vec2;

/// The faults of a match end after this time, s.
pub(super) const FAULTS: f32 = 40.0;

/// A side that can be drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SoakSide {
    pub strategy: String,
    pub robot: String,
    pub sensing: String,
    /// The roles of its players, by number.
    pub roles: Vec<String>,
    pub swaps: bool,
    /// Where its players stand for their own kick-off and for the other team's, by number, m in the team frame.
    pub places: [Vec<Vec2>; 2],
}

/// What can be drawn on one pitch.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SoakPool {
    /// The match whose pitch, ball and rules there are.
    pub game: String,
    /// Half of the field, m.
    pub half_size: Vec2,
    pub sides: Vec<SoakSide>,
    pub radios: Vec<String>,
}
