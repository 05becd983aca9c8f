//! Coverage: how often the robots of some matches were in each state of their strategies and took each transition. What is never
//! reached is dead, or was not tried.
//!
//! A [`MatchCoverage`] looks at a match after each tick and changes nothing; a [`Coverage`] is the sum over matches.

mod counts;
mod table;
mod watcher;

pub use counts::MatchCoverage;
pub use table::{Coverage, MachineCoverage, StateCoverage, StrategyCoverage, TransitionCoverage};
pub use watcher::CoverageWatcher;
