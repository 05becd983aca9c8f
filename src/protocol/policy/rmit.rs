//! After RMIT United 2000, as the Hammerheads paper (section II) describes it: every robot judges all the players of its own
//! world model, again and again, and the present holder of a role gets a bonus for it.
//!
//! The best on the ball is the forward, the farthest back of the others the halfback, and the last one the floater. No values
//! are exchanged. Since every robot comes to much the same view, only the one that gains the most important role that changes
//! hands proposes the swap. The heuristics are ours.

use serde::{Deserialize, Serialize};

use super::knowledge::{Duty, Knowledge, SwapRoles};
use super::members::{by_importance, first_to_gain, members, reassignment};
use super::places::ball;
use crate::data::{Bound, Fault, Validate, check_all};
use crate::protocol::role_swap::Reassignment;

/// Roles by position and orientation, again and again, as RMIT United did.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Rmit {
    /// Metres by which another robot must be better placed than the one that has a role.
    pub bonus: f32,
    /// Extra metres for each metre that a robot is nearer to the opponents' end than the ball, on the wrong side of it.
    pub wrong_side: f32,
    /// Seconds for which no role must have changed.
    pub rest: f32,
}

impl Default for Rmit {
    fn default() -> Rmit {
        Rmit { bonus: 0.5, wrong_side: 1.0, rest: 2.0 }
    }
}

impl Rmit {
    pub(super) fn decide(&self, cast: &SwapRoles, knowledge: &Knowledge) -> Option<Reassignment> {
        let ball = ball(knowledge)?;
        let members = members(cast, knowledge);
        let score = |index: usize, duty: Duty| {
            let member = members[index];
            let offset = member.position - ball;
            let metres = match duty {
                Duty::Forward => offset.length() + self.wrong_side * offset.x.max(0.0),
                Duty::Halfback => member.position.x,
                Duty::Floater => 0.0,
            };
            if member.duty == duty { self.bonus - metres } else { -metres }
        };
        let distribution = by_importance(&members, [Duty::Forward, Duty::Halfback, Duty::Floater], score)?;
        if first_to_gain(&distribution)? == knowledge.me { reassignment(cast, &distribution) } else { None }
    }
}

impl Validate for Rmit {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("bonus", self.bonus, Bound::LENGTH),
            ("wrong_side", self.wrong_side, Bound::FACTOR),
            ("rest", self.rest, Bound::SECONDS),
        ])
    }
}
