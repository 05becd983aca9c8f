//! The pitch and the ball as data: sizes, goals, penalty areas and penalty spots.
//!
//! Everything is in metres in the pitch frame. A pitch is symmetric, so one goal and one penalty area describe both.

mod ball_kind;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

pub use ball_kind::BallKind;

use crate::data::{Bound, Fault, Validate, check_all, check_count, ensure};
use crate::geometry::Zone;
use crate::state::RegisterState;

pub(crate) fn plugin(app: &mut App) {
    app.match_resource::<Pitch>();
    app.match_resource::<BallKind>();
}

/// A pitch, read from `assets/pitches/*.ron`.
#[derive(Resource, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pitch {
    /// Its name for people.
    pub name: String,
    /// Inner length between the goal lines, along x.
    pub length: f32,
    /// Inner width between the side walls, along y.
    pub width: f32,
    /// Both goals.
    pub goal: Goal,
    /// Both penalty areas.
    pub penalty_area: PenaltyArea,
    /// m.
    pub centre_circle_radius: f32,
    /// Where the referee puts a ball that makes no progress, in reading order from west to east.
    pub penalty_spots: Vec<Vec2>,
    /// Coloured posts beside the pitch that robots find their place by. Nothing runs into them.
    #[serde(default)]
    pub beacons: Vec<Vec2>,
    /// The walls.
    pub walls: Walls,
}

/// A goal mouth on the goal line, centred on y = 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Goal {
    /// Between the posts, m.
    pub width: f32,
    /// Behind the goal line, m.
    pub depth: f32,
}

/// A penalty area in front of the goal line, centred on y = 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PenaltyArea {
    /// Along x, from the goal line.
    pub depth: f32,
    /// Along y.
    pub width: f32,
}

/// The walls around the pitch and behind the goals.
///
/// With a margin the lines are only painted: the walls around the pitch become a fence, so far away that the ball rolls
/// over the lines and robots step across them, and the goals stand free with walls of their own at their sides and back.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Walls {
    /// m.
    pub thickness: f32,
    /// The coefficient of friction.
    pub friction: f32,
    /// Share of the normal speed that is kept, 0 to 1.
    pub restitution: f32,
    /// Carpet between the lines and the inside of the fence, on all four sides; 0 where the walls are the lines.
    #[serde(default)]
    pub margin: f32,
}

impl Pitch {
    /// The painted lines but for the centre circle, or the feet of the walls, from end to end.
    pub fn lines(&self) -> [(Vec2, Vec2); 11] {
        let half = self.half_size();
        let (front, side) = (half.x - self.penalty_area.depth, self.penalty_area.width / 2.0);
        let across = |x: f32, y: f32| (Vec2::new(x, -y), Vec2::new(x, y));
        let along = |from: f32, to: f32, y: f32| (Vec2::new(from, y), Vec2::new(to, y));
        [
            across(-half.x, half.y),
            across(0.0, half.y),
            across(half.x, half.y),
            along(-half.x, half.x, -half.y),
            along(-half.x, half.x, half.y),
            across(-front, side),
            across(front, side),
            along(-half.x, -front, -side),
            along(-half.x, -front, side),
            along(front, half.x, -side),
            along(front, half.x, side),
        ]
    }

    /// Half the length and half the width.
    pub fn half_size(&self) -> Vec2 {
        Vec2::new(self.length / 2.0, self.width / 2.0)
    }

    /// Carpet beyond the lines, up to the fence; 0 on a pitch whose lines are walls.
    pub fn margin(&self) -> f32 {
        self.walls.margin
    }

    /// The centre of the eastern goal mouth; the western one is its mirror image.
    pub fn goal_centre(&self) -> Vec2 {
        Vec2::new(self.length / 2.0, 0.0)
    }

    /// The western penalty area, which is a team's own in its team frame.
    pub fn own_penalty_area(&self) -> Zone {
        let (x, y) = (self.length / 2.0, self.penalty_area.width / 2.0);
        Zone { min: Vec2::new(-x, -y), max: Vec2::new(-x + self.penalty_area.depth, y) }
    }

    /// Whether a point is on the field or inside a goal, with some room beyond the lines in metres.
    pub fn holds(&self, point: Vec2, room: f32) -> bool {
        let half = self.half_size() + room;
        let inside = point.abs().cmple(half).all();
        let in_goal =
            point.x.abs() <= half.x + self.goal.depth && point.y.abs() <= self.goal.width / 2.0 + room;
        inside || in_goal
    }
}

impl Validate for Pitch {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("length", self.length, Bound::PITCH),
            ("width", self.width, Bound::PITCH),
            ("goal.width", self.goal.width, Bound::LENGTH.positive()),
            ("goal.depth", self.goal.depth, Bound::LENGTH.positive()),
            ("penalty_area.depth", self.penalty_area.depth, Bound::LENGTH.positive()),
            ("penalty_area.width", self.penalty_area.width, Bound::LENGTH.positive()),
            ("centre_circle_radius", self.centre_circle_radius, Bound::LENGTH.positive()),
            ("walls.thickness", self.walls.thickness, Bound::SIZE.positive()),
            ("walls.friction", self.walls.friction, Bound::COEFFICIENT),
            ("walls.restitution", self.walls.restitution, Bound::SHARE),
            ("walls.margin", self.walls.margin, Bound::LENGTH),
        ])?;
        for (field, own, room) in [
            ("goal.width", self.goal.width, self.width),
            ("penalty_area.width", self.penalty_area.width, self.width),
            ("penalty_area.depth", self.penalty_area.depth, self.length / 2.0),
            ("centre_circle_radius", self.centre_circle_radius, self.half_size().min_element()),
        ] {
            ensure(own < room, field, || format!("{own} m does not fit into {room} m"))?;
        }
        let (goals_end, margin) = (self.goal.depth + self.walls.thickness, self.walls.margin);
        ensure(margin == 0.0 || margin > goals_end, "walls.margin", || {
            format!("must be 0, or more than goals and their walls need, {goals_end} m, not {margin}")
        })?;
        check_count("penalty_spots", "the number of spots", self.penalty_spots.len(), 1..=MOST_SPOTS)?;
        Bound::PLACE.check_points("penalty_spots", &self.penalty_spots)?;
        check_count("beacons", "the number of beacons", self.beacons.len(), 0..=MOST_SPOTS)?;
        Bound::PLACE.check_points("beacons", &self.beacons)?;
        self.penalty_spots.iter().enumerate().try_for_each(|(number, spot)| {
            let is_inside = spot.abs().cmplt(self.half_size()).all();
            let message = || format!("({}, {}) is outside the pitch", spot.x, spot.y);
            ensure(is_inside, &format!("penalty_spots.{number}"), message)
        })
    }
}

/// Penalty spots of a pitch.
const MOST_SPOTS: usize = 1000;

#[cfg(test)]
mod tests {
    use super::*;

    const WALLS: Walls = Walls { thickness: 0.05, friction: 0.2, restitution: 0.6, margin: 0.0 };

    fn pitch(walls: Walls) -> Pitch {
        Pitch {
            name: "Test".into(),
            length: 5.4,
            width: 4.0,
            goal: Goal { width: 0.8, depth: 0.3 },
            penalty_area: PenaltyArea { depth: 0.65, width: 1.3 },
            centre_circle_radius: 0.18,
            penalty_spots: vec![Vec2::ZERO],
            beacons: Vec::new(),
            walls,
        }
    }

    #[test]
    fn a_margin_has_room_for_the_goals() {
        assert_eq!(pitch(WALLS).validate(), Ok(()));
        assert_eq!(pitch(Walls { margin: 1.0, ..WALLS }).validate(), Ok(()));
        for margin in [-1.0, 0.3, 0.35, f32::NAN, f32::INFINITY] {
            let fault = pitch(Walls { margin, ..WALLS }).validate().unwrap_err();
            assert_eq!(fault.field.to_string(), "walls.margin", "{margin}");
        }
    }

    #[test]
    fn the_field_is_within_its_lines_with_a_margin_and_without() {
        for margin in [0.0, 1.0] {
            let pitch = pitch(Walls { margin, ..WALLS });
            assert!(pitch.holds(Vec2::new(2.9, 0.0), 0.0), "in the goal");
            assert!(!pitch.holds(Vec2::new(2.9, 1.0), 0.0) && !pitch.holds(Vec2::new(0.0, 2.1), 0.0));
            assert_eq!(pitch.margin(), margin);
        }
    }
}
