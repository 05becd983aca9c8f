//! The Hammerheads' own rule (section VII-B), and the refinement of it that the paper suggests.
//!
//! A halfback that loses the ball far up the field would have a long way home, and the floater a long way up. So at this
//! moment, and only then, the halfback proposes that it becomes the forward, the forward the floater and the floater the
//! halfback. Nobody else ever proposes anything.

use serde::{Deserialize, Serialize};
use smallvec::smallvec;

use super::knowledge::{Duty, Knowledge, SwapRoles};
use super::members::{Distribution, Member, me, members, reassignment};
use crate::data::{Bound, Fault, Validate};
use crate::protocol::role_swap::Reassignment;

/// The rule as it was played: who becomes what depends on the roles alone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CaseBased {
    /// Share of the offensive zone that the halfback must have behind it, 0 at the centre line and 1 at the opponents' goal
    /// line; a half in the paper.
    pub beyond: f32,
}

/// The refinement: the team mate closest to the halfback becomes the forward. Of the other two, the one farther back becomes
/// the halfback and the other the floater, so that the whole cast has to be heard of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ClosestBecomesForward {
    /// As for [`CaseBased`].
    pub beyond: f32,
}

impl Default for CaseBased {
    fn default() -> CaseBased {
        CaseBased { beyond: 0.5 }
    }
}

impl Default for ClosestBecomesForward {
    fn default() -> ClosestBecomesForward {
        ClosestBecomesForward { beyond: 0.5 }
    }
}

impl CaseBased {
    pub(super) fn decide(
        &self,
        cast: &SwapRoles,
        knowledge: &Knowledge,
        lost_control: bool,
    ) -> Option<Reassignment> {
        stranded_halfback(cast, knowledge, lost_control, self.beyond)?;
        let SwapRoles { halfback, floater, forward } = *cast;
        Some(Reassignment::Roles(smallvec![(halfback, forward), (forward, floater), (floater, halfback)]))
    }
}

impl Validate for CaseBased {
    fn validate(&self) -> Result<(), Fault> {
        Bound::SHARE.check("beyond", self.beyond)
    }
}

impl ClosestBecomesForward {
    pub(super) fn decide(
        &self,
        cast: &SwapRoles,
        knowledge: &Knowledge,
        lost_control: bool,
    ) -> Option<Reassignment> {
        let halfback = stranded_halfback(cast, knowledge, lost_control, self.beyond)?;
        let members = members(cast, knowledge);
        let mates = members.iter().copied().filter(|member| member.number != halfback.number);
        let distance = |mate: &Member| mate.position.distance_squared(halfback.position);
        let closest = mates.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let mut others = members.iter().copied().filter(|member| member.number != closest.number);
        let (Some(a), Some(b), None) = (others.next(), others.next(), others.next()) else { return None };
        let (back, middle) = if b.position.x < a.position.x { (b, a) } else { (a, b) };
        let distribution: Distribution =
            smallvec![(closest, Duty::Forward), (middle, Duty::Floater), (back, Duty::Halfback)];
        reassignment(cast, &distribution)
    }
}

impl Validate for ClosestBecomesForward {
    fn validate(&self) -> Result<(), Fault> {
        Bound::SHARE.check("beyond", self.beyond)
    }
}

/// This robot, if it is a halfback that has lost the ball so far up the field.
fn stranded_halfback(
    cast: &SwapRoles,
    knowledge: &Knowledge,
    lost_control: bool,
    beyond: f32,
) -> Option<Member> {
    let me = me(&members(cast, knowledge), knowledge)?;
    let far_up = me.position.x > knowledge.half_length * beyond;
    (lost_control && far_up && me.duty == Duty::Halfback).then_some(me)
}
