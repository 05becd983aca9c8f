//! When to swap roles, and how: policies after the teams that the Hammerheads paper describes (sections II and VII-B).
//!
//! A policy only looks and decides, without memory but for a small [`PolicyState`]; carrying a decision out over a bad radio
//! is left to [`crate::protocol::role_swap`], with which any of them works. Only the robots of a [`Cast`] swap, never the
//! goalie. Positions are metres in the team frame, times seconds, and ties go to the lower number.
//!
//! | policy | who proposes a swap |
//! |---|---|
//! | case based | the halfback that has just lost the ball |
//! | CS Freiburg, ART | the robot that wants another role, for itself |
//! | RMIT, Italian Golem | the robot that gains the most important role that changes hands |
//! | optimal | the robot with the lowest number |

mod art;
mod case_based;
mod cs_freiburg;
mod italian_golem;
mod members;
mod optimal;
mod places;
mod rmit;
#[cfg(test)]
mod tests;

use bevy::prelude::Vec2;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

use crate::data::Fault;
use crate::ids::PlayerNumber;
use crate::protocol::role_swap::{Reassignment, RoleIndex};
pub use art::Art;
pub use case_based::{CaseBased, ClosestBecomesForward};
pub use cs_freiburg::CsFreiburg;
pub use italian_golem::ItalianGolem;
pub use optimal::Optimal;
pub use places::Places;
pub use rmit::Rmit;

/// How a team decides that roles should be swapped, with the constants of the rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Policy {
    CaseBased(CaseBased),
    ClosestBecomesForward(ClosestBecomesForward),
    CsFreiburg(CsFreiburg),
    Art(Art),
    Rmit(Rmit),
    ItalianGolem(ItalianGolem),
    Optimal(Optimal),
}

/// The three roles that may be swapped, all different. In the words of CS Freiburg: defender, helping attacker and main
/// attacker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cast {
    pub halfback: RoleIndex,
    pub floater: RoleIndex,
    pub forward: RoleIndex,
}

/// What a role of the cast is for. Also the columns of broadcast values, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Duty {
    Forward,
    Floater,
    Halfback,
}

impl Duty {
    const ALL: [Duty; 3] = [Duty::Forward, Duty::Floater, Duty::Halfback];

    fn column(self) -> usize {
        self as usize
    }
}

impl Cast {
    fn role(&self, duty: Duty) -> RoleIndex {
        match duty {
            Duty::Forward => self.forward,
            Duty::Floater => self.floater,
            Duty::Halfback => self.halfback,
        }
    }

    fn duty(&self, role: RoleIndex) -> Option<Duty> {
        Duty::ALL.into_iter().find(|duty| self.role(*duty) == role)
    }
}

/// What a robot knows when it decides.
#[derive(Clone, Debug, PartialEq)]
pub struct Knowledge<'a> {
    pub me: PlayerNumber,
    /// The players that were heard of lately, this one included, in order of their numbers.
    pub players: &'a [Player],
    /// m in the team frame.
    pub ball: Option<Vec2>,
    /// Whether the ball is in this robot's scoop.
    pub tight_control: bool,
    /// Half the length of the pitch, m.
    pub half_length: f32,
    /// The middle of the opponents' goal line, m in the team frame; ours is its mirror image.
    pub goal: Vec2,
    /// Seconds on this robot's clock.
    pub now: f32,
}

/// A player as this robot knows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Player {
    pub number: PlayerNumber,
    /// The role it is believed to have.
    pub role: RoleIndex,
    /// m in the team frame.
    pub position: Vec2,
    /// rad in the team frame.
    pub heading: f32,
    /// The values that it broadcast last.
    pub values: Option<Valued>,
}

/// Values as they were broadcast.
#[derive(Clone, Debug, PartialEq)]
pub struct Valued {
    /// One for each column of the policy.
    pub values: ColumnValues,
    /// The column that the sender would rather have than its own.
    pub wish: Option<u8>,
    /// Seconds since they were sent.
    pub age: f32,
}

/// What each role, or each action, would be worth in one robot's hands.
pub type ColumnValues = SmallVec<[f32; 4]>;

/// What a robot remembers from one decision to the next.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolicyState {
    /// Whether it had tight control of the ball at the last decision.
    had_control: bool,
    /// The role that each robot was last believed to have.
    roles: SmallVec<[(PlayerNumber, RoleIndex); 4]>,
    /// When this robot last proposed a swap or saw a role change, s.
    unrest: Option<f32>,
}

impl PolicyState {
    fn observe(&mut self, knowledge: &Knowledge) {
        self.had_control = knowledge.tight_control;
        for player in knowledge.players {
            match self.roles.iter_mut().find(|(number, _)| *number == player.number) {
                Some((_, role)) if *role == player.role => {}
                Some((_, role)) => {
                    *role = player.role;
                    self.unrest = Some(knowledge.now);
                }
                None => self.roles.push((player.number, player.role)),
            }
        }
    }

    fn has_rested(&self, now: f32, seconds: f32) -> bool {
        self.unrest.is_none_or(|unrest| now - unrest >= seconds)
    }
}

impl Policy {
    /// How roles should be swapped now, if at all. To be asked again and again, for what changes in between counts too.
    pub fn decide(
        &self,
        cast: &Cast,
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
            Policy::ItalianGolem(policy) => policy.decide(cast, knowledge),
            Policy::Optimal(policy) => policy.decide(cast, knowledge),
        }?;
        state.unrest = Some(knowledge.now);
        Some(proposal)
    }

    /// What this robot should broadcast: a value for each column, and the column that it would rather have. `None` for a
    /// policy that exchanges no values, and while the ball is not known.
    pub fn values(&self, cast: &Cast, knowledge: &Knowledge) -> Option<(ColumnValues, Option<u8>)> {
        match self {
            Policy::CsFreiburg(policy) => policy.values(cast, knowledge),
            Policy::Art(policy) => Some((policy.values(cast, knowledge)?, None)),
            Policy::ItalianGolem(policy) => Some((policy.values(cast, knowledge)?, None)),
            Policy::CaseBased(_)
            | Policy::ClosestBecomesForward(_)
            | Policy::Rmit(_)
            | Policy::Optimal(_) => None,
        }
    }

    /// What is wrong with the numbers, as the field's path and a reason.
    pub fn fault(&self) -> Option<Fault> {
        match self {
            Policy::CaseBased(policy) => policy.fault(),
            Policy::ClosestBecomesForward(policy) => policy.fault(),
            Policy::CsFreiburg(policy) => policy.fault(),
            Policy::Art(policy) => policy.fault(),
            Policy::Rmit(policy) => policy.fault(),
            Policy::ItalianGolem(policy) => policy.fault(),
            Policy::Optimal(policy) => policy.fault(),
        }
    }

    /// Seconds for which nothing must have changed before a swap is proposed.
    fn rest(&self) -> f32 {
        match self {
            Policy::CaseBased(_) | Policy::ClosestBecomesForward(_) => 0.0,
            Policy::CsFreiburg(policy) => policy.rest,
            Policy::Art(policy) => policy.rest,
            Policy::Rmit(policy) => policy.rest,
            Policy::ItalianGolem(policy) => policy.rest,
            Policy::Optimal(policy) => policy.rest,
        }
    }
}
