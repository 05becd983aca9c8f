//! What a robot knows beforehand of the things that its pictures show.

use crate::pitch::{BallKind, Pitch};
use crate::vision::paint::{PitchPaint, RobotPaint};

/// Sizes and paints of everything that is recognised. Lengths are metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnownObjects {
    /// Of the ball.
    pub ball_radius: f32,
    /// Of the robots of each team, home first.
    pub robots: [RobotPaint; 2],
    /// Of goals, lines and walls.
    pub paint: PitchPaint,
    /// Between the posts.
    pub goal_width: f32,
    /// Behind the goal line.
    pub goal_depth: f32,
    /// Whether the pitch has beacons.
    pub has_beacons: bool,
    /// Nothing is farther away.
    pub farthest: f32,
}

impl KnownObjects {
    /// Of a match on a pitch, with a ball and the robots of both teams, home first.
    pub fn new(pitch: &Pitch, ball: &BallKind, robots: [RobotPaint; 2]) -> KnownObjects {
        KnownObjects {
            ball_radius: ball.radius,
            robots,
            paint: PitchPaint::of(pitch),
            goal_width: pitch.goal.width,
            goal_depth: pitch.goal.depth,
            has_beacons: !pitch.beacons.is_empty(),
            farthest: 2.0 * (pitch.half_size() + pitch.margin()).length(),
        }
    }
}
