//! Jam: the worst radio. Which few messages of a scenario or of a recorded match, lost, late or come twice, do the most harm?
//!
//! Sets of packets are tried, one packet first, then two, and so on: each next one is sent after the one before, so that every set is
//! tried once, and none that the earlier ones have made impossible. The least number that does harm, less one, is how much
//! interference protocol and situation bear.

mod harm;
mod plan;
mod play;
mod report;
mod search;
mod worst;

pub use harm::Harm;
pub use plan::{JamChoice, JamPlan, JamStart};
pub use report::JamReport;
pub use search::{Interfered, JamEnd};
pub use worst::WorstCase;
