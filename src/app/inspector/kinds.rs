//! Kinds of motor schemas, as far as their colour goes: what attracts, what repels, and everything else.

use crate::strategy::language::Schema;

/// What a schema does to a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Draws it to a place.
    Attraction,
    /// Keeps it away from things.
    Repulsion,
    /// Leads it around things.
    Detour,
    /// Works at the ball.
    Handling,
    /// Heeds nothing around the robot.
    Unguided,
}

impl Kind {
    #[cfg(test)]
    pub const ALL: [Kind; 5] =
        [Kind::Attraction, Kind::Repulsion, Kind::Detour, Kind::Handling, Kind::Unguided];

    pub fn of(schema: &Schema) -> Kind {
        match schema {
            Schema::GoTo { .. } | Schema::GoToAll { .. } | Schema::AttractNear { .. } => Kind::Attraction,
            Schema::Avoid { .. } => Kind::Repulsion,
            Schema::Swirl { .. } | Schema::SwirlLeft { .. } | Schema::GeoField { .. } => Kind::Detour,
            Schema::DockBehind { .. } | Schema::Dribble { .. } => Kind::Handling,
            Schema::Noise { .. } | Schema::Constant(_) => Kind::Unguided,
        }
    }

    /// For people.
    pub fn words(self) -> &'static str {
        match self {
            Kind::Attraction => "draws the robot to a place",
            Kind::Repulsion => "keeps the robot away from things",
            Kind::Detour => "leads the robot around things",
            Kind::Handling => "works at the ball",
            Kind::Unguided => "heeds nothing around the robot",
        }
    }
}

#[cfg(test)]
mod tests {
    use bevy::prelude::*;

    use super::*;
    use crate::strategy::language::{Point, Points};

    #[test]
    fn attraction_and_repulsion_are_told_from_the_rest() {
        let go = Schema::GoTo { target: Point::Ball, controlled_zone: 0.0, dead_zone: 0.0 };
        let avoid = Schema::Avoid { of: Points::Walls, sphere: 1.0, safety: 0.5 };
        let swirl = Schema::SwirlLeft { around: Points::Opponents, sphere: 1.0, safety: 0.5 };
        let dribble = Schema::Dribble { ball: Point::Ball, toward: Point::TheirGoal, tight: 25.0 };
        let kinds = [&go, &avoid, &swirl, &dribble, &Schema::Constant(Vec2::X)].map(Kind::of);
        assert_eq!(kinds, Kind::ALL);
    }
}
