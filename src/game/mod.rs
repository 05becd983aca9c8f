//! A match: read as a [`MatchPlan`], started in a world, played tick by tick.

mod carry;
mod files;
mod line_up;
pub mod net;
mod plan;
mod play;
pub mod record;
pub mod requests;
mod situation;
mod spawn;
mod start;
mod team;

use bevy::prelude::*;

pub(crate) use files::{checked, file_named, read_addresses};
pub use plan::{Choice, DEFAULT_MATCH, MatchFile, MatchPlan};
pub use play::Match;
pub use situation::{Placed, Situation};
pub use start::{start_match, start_mind};
pub(crate) use team::read_strategy_alone;
pub use team::{Senses, TeamFile, TeamPlan};

use crate::{comms, mind, pitch, robot, schedule, world};

/// Everything that a match needs, without a window.
pub fn simulation(app: &mut App) {
    let game = (carry::plugin, requests::plugin, net::plugin, record::plugin);
    let contract = (schedule::plugin, pitch::plugin, robot::plugin);
    app.add_plugins((contract, world::plugin, comms::plugin, mind::plugin, game));
}
