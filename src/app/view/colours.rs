//! Every colour of the window, one meaning each: the hall of 2001 with green carpet, white walls and bright markers.

use bevy::prelude::*;
use bevy_egui::egui;

use crate::ids::Team;
use crate::lab::export::palette;
use crate::strategy::MAX_PLAYERS;
use crate::strategy::language::SchemaKind;
use crate::vision::ColourClass;

const fn rgb(hex: u32) -> Color {
    let [_, red, green, blue] = hex.to_be_bytes();
    Color::srgb(red as f32 / 255.0, green as f32 / 255.0, blue as f32 / 255.0)
}

/// Around the pitch.
pub const FLOOR: Color = rgb(palette::FLOOR);
/// The carpet.
pub const CARPET: Color = rgb(palette::CARPET);
/// Every second mowing stripe.
pub const STRIPE: Color = rgb(palette::STRIPE);
/// The fence around a pitch whose lines are painted on the carpet.
pub const FENCE: Color = rgb(palette::FENCE);
/// Lines, walls and penalty spots.
pub const CHALK: Color = rgb(palette::CHALK);
/// The goal in the east, as cameras see it too.
pub const BLUE_GOAL: Color = rgb(palette::BLUE_GOAL);
/// The goal in the west, as cameras see it too.
pub const YELLOW_GOAL: Color = rgb(palette::YELLOW_GOAL);
/// The body of a robot.
pub const ROBOT: Color = rgb(palette::ROBOT);
/// The head of a robot that has a neck: pale, so that one sees where it looks.
pub const HEAD: Color = rgb(palette::HEAD);
/// The line around a robot's parts.
pub const ROBOT_EDGE: Color = rgb(palette::ROBOT_EDGE);
/// The ball.
pub const BALL: Color = rgb(palette::BALL);
/// The edge of the ball.
pub const BALL_EDGE: Color = rgb(palette::BALL_EDGE);
/// A claim of the ball.
pub const CLAIM: Color = BALL;
/// A lock of the role swap.
pub const LOCK: Color = rgb(palette::LOCK);
/// A message that got lost.
pub const LOST: Color = rgb(0x9A_A2_9D);
/// The ring of a robot under a person's hand.
pub const PILOT: Color = rgb(0xFF_FF_FF);

/// What the robot's sensors said.
pub const SENSED: Color = PILOT;
/// The sum of all schemas.
pub const SUM: Color = PILOT;
/// A value that is not the file's.
pub const CHANGED: Color = rgb(0x73_B8_FF);

/// Text on panels.
pub const TEXT: Color = rgb(0xE6_EA_E7);
/// Less important text.
pub const QUIET: Color = rgb(0xA3_AE_A7);
/// What the referee has just decided.
pub const CALL: Color = rgb(0xFF_D1_66);
/// What went well.
pub const GOOD: Color = rgb(0x6F_D8_8C);
/// What went wrong.
pub const TROUBLE: Color = rgb(0x9E_2A_2B);
/// A robot that is off the pitch.
pub const PENALTY: Color = rgb(0xFF_6B_5E);
/// Where a match is to stop, or has stopped.
pub const BREAKPOINT: Color = PENALTY;
/// Behind what is typed or slid on panels.
pub const SUNKEN: Color = rgb(0x12_17_14);
/// Panels.
pub const PANEL: Color = rgb(0x1B_23_1F);
/// Cards and buttons on panels.
pub const RAISED: Color = rgb(0x2A_35_2F);
/// What is switched on or pointed at.
pub const ACCENT: Color = rgb(0x3F_A9_63);

/// The colour of a team's markers.
pub const fn team(team: Team) -> Color {
    rgb(palette::team(team))
}

/// A team's colour as text on a dark panel.
pub const fn team_text(team: Team) -> Color {
    match team {
        Team::Home => rgb(0xF0_7C_C4),
        Team::Away => rgb(0x5F_D5_E6),
    }
}

/// The colour of a schema's vector: green draws, red repels, ambers do neither.
pub const fn schema(kind: SchemaKind) -> Color {
    match kind {
        SchemaKind::Attraction => rgb(0x5C_D6_5C),
        SchemaKind::Repulsion => rgb(0xF0_52_4F),
        SchemaKind::Detour => rgb(0xF5_9E_1B),
        SchemaKind::Handling => rgb(0xFF_D1_66),
        SchemaKind::Unguided => rgb(0xC8_A2_6B),
        SchemaKind::Blended => rgb(0x7F_C8_F8),
    }
}

/// The colour of a class of pixels in a picture that is cut by colour.
pub const fn class(class: ColourClass) -> Color {
    match class {
        ColourClass::Orange => BALL,
        ColourClass::Yellow => YELLOW_GOAL,
        ColourClass::SkyBlue => rgb(0x56_B4_F2),
        ColourClass::Pink => rgb(0xFF_7F_BF),
        ColourClass::Red => rgb(0xD8_2F_2F),
        ColourClass::DarkBlue => rgb(0x34_44_C8),
        ColourClass::White => CHALK,
        ColourClass::Green => CARPET,
    }
}

/// What never happened.
pub const NEVER: Color = LOST;

/// How often something happened, from 0 for seldom to 1 for most often: cold blue to hot orange.
pub fn heat(share: f32) -> Color {
    let (cold, hot) = (Oklcha::from(rgb(0x3F_7F_C4)), Oklcha::from(rgb(0xFF_8A_3C)));
    // By way of magenta, which no team wears, as on a chart of temperatures.
    let share = share.clamp(0.0, 1.0);
    let hue = cold.hue + share * (hot.hue + 360.0 - cold.hue);
    let mixed = |of: fn(Oklcha) -> f32| of(cold) + share * (of(hot) - of(cold));
    Oklcha::new(mixed(|colour| colour.lightness), mixed(|colour| colour.chroma), hue.rem_euclid(360.0), 1.0)
        .into()
}

/// The colour of a robot's number among its team mates, where it tells who has booked the ball.
pub fn number(number: u8) -> Color {
    const COLOURS: [u32; MAX_PLAYERS] = [
        0x8E_B8_E5, 0xE6_E0_8A, 0x9C_CF_8E, 0xC9_A2_7E, 0xB7_A3_E0, 0x7F_C9_C0, 0xD7_D7_D2, 0xC9_8F_B4,
        0xB9_C4_6A, 0x8C_9B_A8, 0xE8_B3_9E,
    ];
    rgb(COLOURS[usize::from(number) % COLOURS.len()])
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
    fn colours_reach_the_interface_unchanged() {
        assert_eq!(egui(team(Team::Home)), egui::Color32::from_rgb(0xD6, 0x40, 0x9F));
        assert_eq!(egui(CARPET), egui::Color32::from_rgb(0x2E, 0x7D, 0x46));
    }

    #[test]
    fn the_teams_differ_in_lightness_as_well() {
        let lightness = |of: Team| Oklcha::from(team(of)).lightness;
        assert!(lightness(Team::Away) - lightness(Team::Home) > 0.08);
    }

    #[test]
    fn what_happened_more_often_is_lighter_and_warmer() {
        let at = |share| Oklcha::from(heat(share));
        assert!(at(0.0).lightness < at(0.5).lightness && at(0.5).lightness < at(1.0).lightness);
        assert!(Srgba::from(heat(0.0)).blue > 0.7 && Srgba::from(heat(1.0)).red > 0.95);
    }

    #[test]
    fn every_class_of_pixels_has_a_colour_of_its_own() {
        let mut seen: Vec<_> = ColourClass::ALL.map(|of| egui(class(of)).to_array()).to_vec();
        seen.push(egui(SUNKEN).to_array());
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), 9);
    }

    #[test]
    fn every_kind_of_schema_every_team_and_every_number_has_a_colour_of_its_own() {
        use SchemaKind::{Attraction, Blended, Detour, Handling, Repulsion, Unguided};
        let mut seen = [Attraction, Repulsion, Detour, Handling, Unguided, Blended].map(schema).to_vec();
        seen.extend(Team::BOTH.map(team));
        seen.push(SUM);
        seen.extend((1..=MAX_PLAYERS as u8).map(number));
        let mut seen: Vec<_> = seen.into_iter().map(|colour| egui(colour).to_array()).collect();
        let all = seen.len();
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), all);
    }
}
