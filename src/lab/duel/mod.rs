//! Duels at a free ball: a few robots of two strategies begin at mirrored places around a ball that lies still, and the side that
//! brings it out its own way wins. Each start is played twice, with the strategies on either side.
//!
//! A [`DuelPlan`] says what is played, a [`DuelJudge`] when a trial is over, and a [`DuelReport`] what came out.

mod choice;
mod judge;
mod plan;
mod report;

mod start;

pub use choice::{DuelChoice, DuelTeams};
pub use judge::{DuelJudge, OUT, TrialOutcome, TrialResult};
pub use plan::DuelPlan;
pub use report::{DuelReport, SideReport};
