//! Jam: the worst radio. Which few messages of a scenario, lost or late, do the most harm?
//!
//! Sets of packets are tried, one packet first, then two, and so on: each loss is of a packet that is sent after the one before, so that
//! every set is tried once, and none that the earlier losses have made impossible. The least number that does harm, less one, is how
//! many losses protocol and situation bear.

mod harm;
mod plan;
mod report;
mod search;

pub use harm::Harm;
pub use plan::{JamChoice, JamPlan};
pub use report::JamReport;
pub use search::{Interfered, JamEnd};
