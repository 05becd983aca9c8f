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

use std::fmt;
use std::hash::BuildHasher;
use std::sync::Arc;

use bevy::prelude::*;
use xxhash_rust::xxh3::Xxh3DefaultBuilder;

use crate::ids::Team;
pub use activity::{Activity, Searched, TransitionId, TransitionTaken, played};
pub use desirability::Desirability;
pub use file::StrategyFile;
pub use pieces::{
    Assemblage, Combination, CompositeState, HomebaseRule, Influence, KickOff, Machine, NamedFeatures, Part,
    Play, RoleSpec, State, StateRef, Strategy, SubRole, Term, Transition, Turn,
};
pub use reading::{StrategyReading, StrategyTexts, TeamworkChange};
pub use resolve::MAX_PLAYERS;
pub use role::{Role, RoleRef};

/// The strategies of a match, home first. They change only in the Script stage.
#[derive(Resource, Clone, Debug)]
pub struct Strategies(pub [Arc<Strategy>; 2]);

/// What the strategies of a match were read from, home first.
#[derive(Resource, Clone, Default)]
pub struct StrategySources(pub [Arc<StrategyTexts>; 2]);

/// Texts are long.
impl fmt::Debug for StrategySources {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let hashes = self.0.each_ref().map(|texts| Xxh3DefaultBuilder.hash_one(texts));
        write!(f, "{hashes:x?}")
    }
}

impl Strategies {
    /// A team's strategy.
    pub fn of(&self, team: Team) -> &Strategy {
        &self.0[team.index()]
    }
}
