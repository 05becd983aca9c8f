//! Kinds of motor schemas, as far as their colour goes: what attracts, what repels, and everything else.

use bevy::prelude::Color;

use crate::strategy::language::Schema;

/// What a schema does to a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SchemaKind {
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

impl SchemaKind {
    #[cfg(test)]
    pub const ALL: [SchemaKind; 5] = [
        SchemaKind::Attraction,
        SchemaKind::Repulsion,
        SchemaKind::Detour,
        SchemaKind::Handling,
        SchemaKind::Unguided,
    ];

    pub fn of(schema: &Schema) -> SchemaKind {
        match schema {
            Schema::GoTo { .. } | Schema::GoToAll { .. } | Schema::AttractNear { .. } => {
                SchemaKind::Attraction
            }
            Schema::Avoid { .. } => SchemaKind::Repulsion,
            Schema::Swirl { .. } | Schema::SwirlLeft { .. } | Schema::GeoField { .. } => SchemaKind::Detour,
            Schema::DockBehind { .. } | Schema::Dribble { .. } => SchemaKind::Handling,
            Schema::Noise { .. } | Schema::Constant(_) => SchemaKind::Unguided,
        }
    }

    /// The colour of its vector: green draws, red repels, ambers do neither.
    pub fn colour(self) -> Color {
        match self {
            SchemaKind::Attraction => Color::srgb_u8(0x5C, 0xD6, 0x5C),
            SchemaKind::Repulsion => Color::srgb_u8(0xF0, 0x52, 0x4F),
            SchemaKind::Detour => Color::srgb_u8(0xF5, 0x9E, 0x1B),
            SchemaKind::Handling => Color::srgb_u8(0xFF, 0xD1, 0x66),
            SchemaKind::Unguided => Color::srgb_u8(0xC8, 0xA2, 0x6B),
        }
    }

    /// For people.
    pub fn words(self) -> &'static str {
        match self {
            SchemaKind::Attraction => "draws the robot to a place",
            SchemaKind::Repulsion => "keeps the robot away from things",
            SchemaKind::Detour => "leads the robot around things",
            SchemaKind::Handling => "works at the ball",
            SchemaKind::Unguided => "heeds nothing around the robot",
        }
    }
}

#[cfg(test)]
mod tests {
    use bevy::prelude::*;

    use super::*;
    use crate::app::view::colours;
    use crate::ids::Team;
    use crate::strategy::language::{Point, Points};

    #[test]
    fn attraction_and_repulsion_are_told_from_the_rest() {
        let go = Schema::GoTo { target: Point::Ball, controlled_zone: 0.0, dead_zone: 0.0 };
        let avoid = Schema::Avoid { of: Points::Walls, sphere: 1.0, safety: 0.5 };
        let swirl = Schema::SwirlLeft { around: Points::Opponents, sphere: 1.0, safety: 0.5 };
        let dribble = Schema::Dribble { ball: Point::Ball, toward: Point::TheirGoal, tight: 25.0 };
        let kinds = [&go, &avoid, &swirl, &dribble, &Schema::Constant(Vec2::X)].map(SchemaKind::of);
        assert_eq!(kinds, SchemaKind::ALL);
    }

    #[test]
    fn every_kind_and_team_has_a_colour_of_its_own() {
        let mut seen: Vec<_> = SchemaKind::ALL.map(|one| colours::egui(one.colour()).to_array()).to_vec();
        seen.extend(Team::BOTH.map(|one| colours::egui(colours::team(one)).to_array()));
        seen.push(colours::egui(colours::SUM).to_array());
        seen.extend((0..8).map(|one| colours::egui(colours::number(one)).to_array()));
        let all = seen.len();
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), all);
    }
}
