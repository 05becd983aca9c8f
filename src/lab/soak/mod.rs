//! Soak: matches in which everything goes wrong, over and over, until something breaks that must not.
//!
//! A match is a [scenario](crate::lab::scenario) that is drawn by a seed: strategies, a radio, and a script of faults. In its first phase
//! robots crash, come back with or without their memory, are carried off, cut off, driven by somebody, and jammed, and teams change their
//! strategy; only safety is asked for. Then the
//! faults end, some robots stay off, and roles, locks and bookings must settle. What fails is made as small as it gets.

mod case;
mod plan;
mod pool;
mod shrink;
mod trouble;

pub use plan::{SoakChoice, SoakFinding, SoakPlan, SoakTally};
