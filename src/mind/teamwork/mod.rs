//! The Teamwork stage: what robots tell each other and arrange among themselves.
//!
//! A robot listens to what came in, takes its part in role swaps, claims the ball if it is its to claim, and says what the
//! others should know. What it wants to say waits in its outbox for the Transmit stage.

mod booking;
mod claims;
mod goalie;
mod listen;
mod reports;
mod swap;
mod talk;
mod team_model;
#[cfg(test)]
mod tests;

use bevy::prelude::*;

pub use booking::Booking;
pub use claims::{Claim, Claims};
pub use goalie::GoalieWhereabouts;
pub use reports::{BallReports, Reported};
pub use swap::Swapping;
pub use team_model::{BookingStatus, LastSent, TeamModel, kick_off_roles};

use crate::schedule::{Tick, TickSystems};

pub(super) fn plugin(app: &mut App) {
    let in_order = (
        listen::hear_news,
        swap::swap_roles,
        talk::claim_ball,
        booking::book_ball,
        talk::send_news,
        listen::take_messages,
    );
    app.add_systems(Tick, in_order.chain().in_set(TickSystems::Teamwork));
}
