//! Why a match has come to where it is at a tick: the stretch before it is played again with one thing changed each time, and what
//! then comes otherwise is ranked.
//!
//! What can be changed ([`Candidate`]): a message that was lost arrives, a message of a protocol that arrived is lost, a lock, a
//! claim or a booking goes unheard, a crash does not happen. Each is a change of the requests of the match and of nothing else, so each
//! [`WhyFinding`] is a match of its own, which can be recorded. Whether a difference is more than chance is asked by playing both,
//! with the change and without, with the dice stirred alike at the moment of the change.

mod candidates;
mod finding;
mod plan;
mod play;
mod standing;
#[cfg(test)]
mod tests;

pub use candidates::{Candidate, Meddling};
pub use finding::{WhyFinding, WhyReport};
pub use plan::{WhyChoice, WhyPlan};
pub use standing::{MatchStanding, StandingDifference};
