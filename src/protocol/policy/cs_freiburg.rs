//! After CS Freiburg 2000, as the Hammerheads paper (section II) describes it: each robot works out what it would be worth in
//! each role and tells the others.
//!
//! A robot takes a role if it would rather have it than its own, if nobody is worth more in it, and if the robot that has it
//! would rather have another one too. It proposes the exchange itself. The utility functions are ours: how near the robot is
//! to the place of the role, and 1 for the forward with the ball in its scoop.

use serde::{Deserialize, Serialize};

use super::knowledge::{ColumnValues, Duty, Knowledge, SwapRoles};
use super::members::{Member, bidders, exchange, highest, is_given_up, me, members};
use super::places::{Places, ball, nearness};
use crate::data::{Bound, Fault, Validate, check_all};
use crate::protocol::role_swap::Reassignment;

/// Columns: forward (the main attacker), floater (the helping one), halfback (the defender).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CsFreiburg {
    /// Where the roles are best played.
    pub places: Places,
    /// Distance at which a utility is a half, m.
    pub half: f32,
    /// By how much another role must be worth more to a robot than its own before it wishes for it.
    pub margin: f32,
    /// Age from which values no longer count, s.
    pub max_age: f32,
    /// Seconds for which no role must have changed.
    pub rest: f32,
}

impl Default for CsFreiburg {
    fn default() -> CsFreiburg {
        CsFreiburg { places: Places::default(), half: 1.5, margin: 0.1, max_age: 1.0, rest: 2.0 }
    }
}

impl CsFreiburg {
    pub(super) fn decide(&self, cast: &SwapRoles, knowledge: &Knowledge) -> Option<Reassignment> {
        let (values, wish) = self.values(cast, knowledge)?;
        let wished = Duty::ALL.into_iter().find(|duty| wish == Some(duty.column() as u8))?;
        let bidders = bidders(cast, knowledge, (values, wish), self.max_age);
        let best = highest(&bidders, wished.column())?;
        if best.number != knowledge.me {
            return None;
        }
        let wishes_another = |number| {
            let holder = bidders.iter().find(|bidder| bidder.member.number == number);
            let wish = holder.and_then(|holder| holder.wish);
            wish.is_some_and(|wish| usize::from(wish) != wished.column())
        };
        let members = members(cast, knowledge);
        if is_given_up(&members, wished, wishes_another) {
            exchange(cast, best, wished, &members)
        } else {
            None
        }
    }

    pub(super) fn values(
        &self,
        cast: &SwapRoles,
        knowledge: &Knowledge,
    ) -> Option<(ColumnValues, Option<u8>)> {
        let me = me(&members(cast, knowledge), knowledge)?;
        let ball = ball(knowledge)?;
        let utility = |duty| match duty {
            Duty::Forward if knowledge.tight_control => 1.0,
            _ => nearness(self.places.distance(me.position, duty, ball, knowledge.goal), self.half),
        };
        let values: ColumnValues = Duty::ALL.into_iter().map(utility).collect();
        let wish = self.wish(me, &values);
        Some((values, wish))
    }

    fn wish(&self, me: Member, values: &[f32]) -> Option<u8> {
        let own = me.duty.column();
        let best = (0..values.len()).reduce(|a, b| if values[b] > values[a] { b } else { a })?;
        (best != own && values[best] > values[own] + self.margin).then_some(best as u8)
    }
}

impl Validate for CsFreiburg {
    fn validate(&self) -> Result<(), Fault> {
        self.places.validate_as("places")?;
        check_all([
            ("half", self.half, Bound::LENGTH.positive()),
            ("margin", self.margin, Bound::FACTOR),
            ("max_age", self.max_age, Bound::SECONDS.positive()),
            ("rest", self.rest, Bound::SECONDS),
        ])
    }
}
