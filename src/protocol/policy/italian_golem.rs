//! After the Italian Golem team of 2000, as the Hammerheads paper (section II) describes it: each robot has a value for each
//! action, all are broadcast, and the robot with the highest value for an action may do it.
//!
//! Here the actions are to acquire the ball, to support and to defend, given out in this order; they make a robot the forward,
//! the floater or the halfback. The robot with the ball has priority over it by a bonus. Who gains the first action that
//! changes hands proposes the swap. The functions are ours, and so is the lead, without which equals would swap all the time.

use serde::{Deserialize, Serialize};

use super::knowledge::{ColumnValues, Duty, Knowledge, SwapRoles};
use super::members::{Members, bidders, by_importance, first_to_gain, me, members, reassignment};
use super::places::{Places, ball, nearness};
use crate::data::{Bound, Fault, Validate, check_all};
use crate::protocol::role_swap::Reassignment;

/// Columns: acquire, support, defend.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ItalianGolem {
    /// Where the roles are best played.
    pub places: Places,
    /// Distance at which a value is a half, m.
    pub half: f32,
    /// Added to the first value of the robot with the ball in its scoop; values are at most 1 without it.
    pub possession: f32,
    /// By how much another robot's value must be higher than that of the robot that does the action already.
    pub lead: f32,
    /// Age from which values no longer count, s.
    pub max_age: f32,
    /// Seconds for which no role must have changed.
    pub rest: f32,
}

impl Default for ItalianGolem {
    fn default() -> ItalianGolem {
        ItalianGolem {
            places: Places::default(),
            half: 1.5,
            possession: 1.0,
            lead: 0.1,
            max_age: 1.0,
            rest: 2.0,
        }
    }
}

impl ItalianGolem {
    pub(super) fn decide(&self, cast: &SwapRoles, knowledge: &Knowledge) -> Option<Reassignment> {
        let bidders = bidders(cast, knowledge, (self.values(cast, knowledge)?, None), self.max_age);
        let members: Members = bidders.iter().map(|bidder| bidder.member).collect();
        let value = |index: usize, duty: Duty| {
            let lead = if members[index].duty == duty { self.lead } else { 0.0 };
            bidders[index].values[duty.column()] + lead
        };
        let distribution = by_importance(&members, Duty::ALL, value)?;
        if first_to_gain(&distribution)? == knowledge.me { reassignment(cast, &distribution) } else { None }
    }

    pub(super) fn values(&self, cast: &SwapRoles, knowledge: &Knowledge) -> Option<ColumnValues> {
        let me = me(&members(cast, knowledge), knowledge)?;
        let ball = ball(knowledge)?;
        let value = |duty| {
            let near = nearness(self.places.distance(me.position, duty, ball, knowledge.goal), self.half);
            if duty == Duty::Forward && knowledge.tight_control { near + self.possession } else { near }
        };
        Some(Duty::ALL.into_iter().map(value).collect())
    }
}

impl Validate for ItalianGolem {
    fn validate(&self) -> Result<(), Fault> {
        self.places.validate_as("places")?;
        check_all([
            ("half", self.half, Bound::LENGTH.positive()),
            ("possession", self.possession, Bound::FACTOR),
            ("lead", self.lead, Bound::FACTOR),
            ("max_age", self.max_age, Bound::SECONDS.positive()),
            ("rest", self.rest, Bound::SECONDS),
        ])
    }
}
