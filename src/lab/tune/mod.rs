//! Tuning: a search for the numbers of files with which a team does best, and what they are worth on seeds that it did not see.
//!
//! A [`TuningFile`] is what is written in `assets/tunings`; a [`TuningPlan`] plays the matches of one of its teams; [`search`] asks for
//! them, as the candidates [`race`].

mod file;
mod plan;
mod race;
mod report;
mod row;
mod search;
mod teams;

pub use file::{BetterValue, TunedNumber, TunedParameter, TuningFile, TuningObjective};
pub use plan::{TuningCandidate, TuningPlan, WantedMatches};
pub use race::{ParameterSpace, RaceEnd, RaceEntrant, RaceRules, race};
pub use report::{TunedValue, TuningReport};
pub use row::{KnownMatches, TuningRow};
pub use search::search;
pub use teams::teams_beside_each_other;
