//! Things on a pitch whose place a robot knows beforehand, as pictures show them.

use bevy::math::Vec2;

use crate::geometry::Sighting;
use crate::pitch::Pitch;

/// Something whose place is known. East and north are those of the pitch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Landmark {
    /// An end of a goal's mouth.
    GoalPost {
        /// Of the eastern goal.
        east: bool,
        /// The end with the greater y.
        north: bool,
    },
    /// A beacon; each is the only one of its quarter of the pitch.
    Beacon {
        /// At positive x.
        east: bool,
        /// At positive y.
        north: bool,
    },
    /// A point of some painted line: the near edge of one.
    Line,
    /// A point at the foot of some white wall.
    Wall,
}

impl Landmark {
    /// Where on the pitch it is, if it is one point that the pitch has.
    pub fn place(self, pitch: &Pitch) -> Option<Vec2> {
        let side = |positive: bool| if positive { 1.0 } else { -1.0 };
        match self {
            Landmark::GoalPost { east, north } => {
                Some(Vec2::new(side(east) * pitch.length / 2.0, side(north) * pitch.goal.width / 2.0))
            }
            Landmark::Beacon { east, north } => (pitch.beacons.iter().copied())
                .find(|beacon| beacon.x * side(east) > 0.0 && beacon.y * side(north) > 0.0),
            Landmark::Line | Landmark::Wall => None,
        }
    }
}

/// What a picture says of one landmark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LandmarkSighting {
    /// Which one it is taken for.
    pub landmark: Landmark,
    /// From the robot.
    pub sighting: Sighting,
    /// Standard deviation of the range, m, as the size of a pixel and the sway of the camera make it. Bearings are about as good
    /// as a pixel and the robot's own knowledge of where its camera looks.
    pub range_deviation: f32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn landmarks_are_where_the_pitch_has_them() {
        let pitch =
            Pitch { beacons: vec![Vec2::new(-1.0, 2.7), Vec2::new(1.0, -2.7)], ..crate::testing::pitch() };
        let post = Landmark::GoalPost { east: false, north: true };
        assert_eq!(post.place(&pitch), Some(Vec2::new(-4.5, 1.0)));
        let beacon = |east, north| Landmark::Beacon { east, north }.place(&pitch);
        assert_eq!(beacon(true, false), Some(Vec2::new(1.0, -2.7)));
        assert_eq!(beacon(true, true), None, "the pitch has none there");
        assert_eq!(Landmark::Line.place(&pitch), None);
    }
}
