//! Strategies: what a team's robots know, want and do, as data.
//!
//! A file in `assets/strategies` is parsed into a [`StrategyFile`] and then resolved into the [`Strategy`] that runs: names
//! looked up, numbers checked, nothing half-loaded. See [`language`] for the words of a file.

mod activity;
mod base;
mod desirability;
mod display;
mod file;
pub mod language;
mod mechanism;
mod pieces;
mod reading;
mod resolve;
mod role;
pub mod team_ball;
pub mod teamwork;

use std::sync::Arc;

use bevy::prelude::*;

use crate::ids::Team;
pub use activity::{Activity, Searched, TransitionTaken, played};
pub use desirability::Desirability;
pub use file::StrategyFile;
pub use pieces::{
    Assemblage, Combination, CompositeState, HomebaseRule, Influence, KickOff, Machine, Part, Play, RoleSpec,
    State, Strategy, SubRole, Term, Transition, Turn,
};
pub use reading::{StrategyReading, StrategyTexts, TeamworkChange};
pub use role::{Role, RoleRef};

/// The strategies of a match, home first. They change only in the Script stage.
#[derive(Resource, Clone, Debug)]
pub struct Strategies(pub [Arc<Strategy>; 2]);

impl Strategies {
    /// A team's strategy.
    pub fn of(&self, team: Team) -> &Strategy {
        &self.0[team.index()]
    }
}
