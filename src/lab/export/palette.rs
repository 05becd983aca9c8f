//! Colours as they are shown everywhere, in the window and in what is exported: red, green and blue in the three lower bytes.

use crate::ids::Team;

/// Around the pitch.
pub const FLOOR: u32 = 0x36_3D_3A;
/// The carpet.
pub const CARPET: u32 = 0x2E_7D_46;
/// Every second mowing stripe.
pub const STRIPE: u32 = 0x33_86_4C;
/// The fence around a pitch whose lines are painted on the carpet.
pub const FENCE: u32 = 0x6E_76_72;
/// Lines, walls and penalty spots.
pub const CHALK: u32 = 0xF1_F1_EA;
/// The goal in the east.
pub const BLUE_GOAL: u32 = 0x2F_6F_DE;
/// The goal in the west.
pub const YELLOW_GOAL: u32 = 0xF2_C2_30;
/// The body of a robot.
pub const ROBOT: u32 = 0x1B_1D_22;
/// The head of a robot that has a neck.
pub const HEAD: u32 = 0xC9_D0_D6;
/// The line around a robot's parts.
pub const ROBOT_EDGE: u32 = 0x5A_61_6B;
/// The ball.
pub const BALL: u32 = 0xFF_8A_1F;
/// The edge of the ball.
pub const BALL_EDGE: u32 = 0x6B_30_00;
/// A lock of the role swap.
pub const LOCK: u32 = 0xFF_B3_00;

/// The colour of a team's markers.
pub const fn team(team: Team) -> u32 {
    match team {
        Team::Home => 0xD6_40_9F,
        Team::Away => 0x22_B8_CF,
    }
}

/// A colour as the web writes it.
pub fn hex(colour: u32) -> String {
    format!("#{colour:06X}")
}
