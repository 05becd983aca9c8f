//! The inspector's colours, one meaning each, on the pitch and in the panel alike.

use bevy::prelude::*;
use bevy_egui::egui;

use super::kinds::Kind;
use crate::ids::Team;

/// What the robot's sensors said.
pub const SENSED: Color = Color::srgb(1.0, 1.0, 1.0);
/// What became of all schemas together.
pub const SUM: Color = Color::srgb(1.0, 1.0, 1.0);

/// The colour of a team's markers, of what it believes, and of its zones.
pub fn team(team: Team) -> Color {
    match team {
        Team::Home => Color::srgb_u8(0xD6, 0x40, 0x9F),
        Team::Away => Color::srgb_u8(0x22, 0xB8, 0xCF),
    }
}

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

/// The same colour for egui.
pub fn egui(colour: Color) -> egui::Color32 {
    let [r, g, b, a] = colour.to_srgba().to_u8_array();
    egui::Color32::from_rgba_unmultiplied(r, g, b, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_and_team_has_a_colour_of_its_own() {
        let mut seen: Vec<_> = Kind::ALL.map(|one| egui(kind(one)).to_array()).to_vec();
        seen.extend(Team::BOTH.map(|one| egui(team(one)).to_array()));
        seen.push(egui(SUM).to_array());
        let all = seen.len();
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), all);
    }
}
