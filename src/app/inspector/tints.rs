//! The inspector's colours beside those of the view, one meaning each, on the pitch and in the panel alike.

use bevy::prelude::*;

use super::kinds::Kind;
pub use crate::app::view::colours::{egui, team, team_text as lighter};

/// What the robot's sensors said.
pub const SENSED: Color = Color::srgb(1.0, 1.0, 1.0);
/// The sum of all schemas.
pub const SUM: Color = Color::srgb(1.0, 1.0, 1.0);

/// A weight that is not the file's.
pub const CHANGED: Color = Color::srgb(0.45, 0.72, 1.0);

/// The colour of a schema's vector: green draws, red repels, ambers do neither.
pub fn kind(kind: Kind) -> Color {
    match kind {
        Kind::Attraction => Color::srgb_u8(0x5C, 0xD6, 0x5C),
        Kind::Repulsion => Color::srgb_u8(0xF0, 0x52, 0x4F),
        Kind::Detour => Color::srgb_u8(0xF5, 0x9E, 0x1B),
        Kind::Handling => Color::srgb_u8(0xFF, 0xD1, 0x66),
        Kind::Unguided => Color::srgb_u8(0xC8, 0xA2, 0x6B),
    }
}

/// The colour of a robot's number among its team mates, where it tells who has booked the ball.
pub fn number(number: u8) -> Color {
    const COLOURS: [u32; 8] =
        [0x8E_B8_E5, 0xE6_E0_8A, 0x9C_CF_8E, 0xC9_A2_7E, 0xB7_A3_E0, 0x7F_C9_C0, 0xD7_D7_D2, 0xC9_8F_B4];
    let [_, red, green, blue] = COLOURS[usize::from(number) % COLOURS.len()].to_be_bytes();
    Color::srgb_u8(red, green, blue)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    #[test]
    fn every_kind_and_team_has_a_colour_of_its_own() {
        let mut seen: Vec<_> = Kind::ALL.map(|one| egui(kind(one)).to_array()).to_vec();
        seen.extend(Team::BOTH.map(|one| egui(team(one)).to_array()));
        seen.push(egui(SUM).to_array());
        seen.extend((0..8).map(|one| egui(number(one)).to_array()));
        let all = seen.len();
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), all);
    }
}
