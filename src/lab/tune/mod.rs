//! Tuning: a search for the numbers of files with which a team does best, and what they are worth on seeds that it did not see.
//!
//! A [`TuningFile`] is what is written in `assets/tunings`; a [`TuningPlan`] plays its matches; [`race`] decides which.

mod file;
mod plan;
mod race;
mod report;
mod row;

pub use file::{BetterValue, TunedNumber, TunedParameter, TuningFile, TuningObjective};
pub use plan::{TuningCandidate, TuningPlan};
pub use race::{ParameterSpace, RaceEnd, RaceEntrant, RaceRules, race};
pub use report::{TunedValue, TuningReport};
pub use row::{KnownMatches, TuningRow};
