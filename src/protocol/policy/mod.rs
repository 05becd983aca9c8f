//! When to swap roles, and how: policies after the teams that the Hammerheads paper describes (sections II and VII-B).
//!
//! A policy only looks and decides, without memory but for a small [`PolicyState`]; carrying a decision out over a bad radio
//! is left to [`crate::protocol::role_swap`], with which any of them works. Italian Golem, the fourth team of section II, gives
//! out single actions and no roles: [`crate::protocol::arbitration`]. Only the robots of a [`SwapRoles`] swap, never the
//! goalie. Positions are metres in the team frame, times seconds, and ties go to the lower number.
//!
//! | policy | who proposes a swap |
//! |---|---|
//! | case based | the halfback that has just lost the ball |
//! | CS Freiburg, ART | the robot that wants another role, for itself |
//! | RMIT | the robot that gains the most important role that changes hands |
//! | optimal | the robot with the lowest number |

mod art;
mod case_based;
mod cs_freiburg;
mod knowledge;
mod members;
mod optimal;
mod places;
mod rmit;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use crate::data::{Fault, Validate};
use crate::protocol::role_swap::Reassignment;
pub use art::Art;
pub use case_based::{CaseBased, ClosestBecomesForward};
pub use cs_freiburg::CsFreiburg;
pub(in crate::protocol) use knowledge::Duty;
pub use knowledge::{ColumnValues, Knowledge, Player, PolicyState, SwapRoles, Valued};
pub use optimal::Optimal;
pub use places::Places;
pub(in crate::protocol) use places::nearness;
pub use rmit::Rmit;

/// How a team decides that roles should be swapped, with the constants of the rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Policy {
    /// The paper's rule: the halfback has lost the ball up the field.
    CaseBased(CaseBased),
    /// The paper's refinement: the closest to the ball becomes the forward.
    ClosestBecomesForward(ClosestBecomesForward),
    /// As CS Freiburg did.
    CsFreiburg(CsFreiburg),
    /// As the Azzurra Robot Team did.
    Art(Art),
    /// As RMIT United did.
    Rmit(Rmit),
    /// The assignment with the least cost in all.
    Optimal(Optimal),
}

impl Policy {
    /// How roles should be swapped now, if at all. To be asked again and again, for what changes in between counts too.
    pub fn decide(
        &self,
        cast: &SwapRoles,
        knowledge: &Knowledge,
        state: &mut PolicyState,
    ) -> Option<Reassignment> {
        let lost_control = state.had_control && !knowledge.tight_control;
        state.observe(knowledge);
        if !state.has_rested(knowledge.now, self.rest()) {
            return None;
        }
        let proposal = match self {
            Policy::CaseBased(policy) => policy.decide(cast, knowledge, lost_control),
            Policy::ClosestBecomesForward(policy) => policy.decide(cast, knowledge, lost_control),
            Policy::CsFreiburg(policy) => policy.decide(cast, knowledge),
            Policy::Art(policy) => policy.decide(cast, knowledge),
            Policy::Rmit(policy) => policy.decide(cast, knowledge),
            Policy::Optimal(policy) => policy.decide(cast, knowledge),
        }?;
        state.unrest = Some(knowledge.now);
        Some(proposal)
    }

    /// What this robot should broadcast: a value for each column, and the column that it would rather have. `None` for a
    /// policy that exchanges no values, and while the ball is not known.
    pub fn values(&self, cast: &SwapRoles, knowledge: &Knowledge) -> Option<(ColumnValues, Option<u8>)> {
        match self {
            Policy::CsFreiburg(policy) => policy.values(cast, knowledge),
            Policy::Art(policy) => Some((policy.values(cast, knowledge)?, None)),
            Policy::CaseBased(_)
            | Policy::ClosestBecomesForward(_)
            | Policy::Rmit(_)
            | Policy::Optimal(_) => None,
        }
    }

    /// Seconds for which nothing must have changed before a swap is proposed.
    fn rest(&self) -> f32 {
        match self {
            Policy::CaseBased(_) | Policy::ClosestBecomesForward(_) => 0.0,
            Policy::CsFreiburg(policy) => policy.rest,
            Policy::Art(policy) => policy.rest,
            Policy::Rmit(policy) => policy.rest,
            Policy::Optimal(policy) => policy.rest,
        }
    }
}

impl Validate for Policy {
    fn validate(&self) -> Result<(), Fault> {
        match self {
            Policy::CaseBased(policy) => policy.validate(),
            Policy::ClosestBecomesForward(policy) => policy.validate(),
            Policy::CsFreiburg(policy) => policy.validate(),
            Policy::Art(policy) => policy.validate(),
            Policy::Rmit(policy) => policy.validate(),
            Policy::Optimal(policy) => policy.validate(),
        }
    }
}
