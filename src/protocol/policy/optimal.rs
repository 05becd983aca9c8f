//! The cheapest distribution of roles by the Kuhn-Munkres algorithm: a yardstick for the other policies, from no paper's team.
//!
//! The cost of a distribution is how far the robots have to travel in all to the places of their roles. All robots would come
//! to much the same answer, so only the one with the lowest number among those that were heard of proposes it.

use pathfinding::kuhn_munkres::kuhn_munkres_min;
use pathfinding::matrix::Matrix;
use serde::{Deserialize, Serialize};

use super::knowledge::{Knowledge, SwapRoles};
use super::members::{Distribution, Member, duties, members, reassignment};
use super::places::{Places, ball};
use crate::data::{Bound, Fault, Validate, check_all};
use crate::protocol::role_swap::Reassignment;

/// The assignment with the least cost in all (Kuhn-Munkres).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Optimal {
    /// Where the roles are best played.
    pub places: Places,
    /// Metres that a swap must save in all. Doubled roles are put right whatever it costs.
    pub min_gain: f32,
    /// Seconds for which no role must have changed.
    pub rest: f32,
}

impl Default for Optimal {
    fn default() -> Optimal {
        Optimal { places: Places::default(), min_gain: 1.0, rest: 2.0 }
    }
}

impl Optimal {
    pub(super) fn decide(&self, cast: &SwapRoles, knowledge: &Knowledge) -> Option<Reassignment> {
        let ball = ball(knowledge)?;
        let members = members(cast, knowledge);
        if members.first()?.number != knowledge.me {
            return None;
        }
        let duties = duties(&members)?;
        let cost = |member: &Member, duty| {
            millimetres(self.places.distance(member.position, duty, ball, knowledge.goal))
        };
        let costs =
            Matrix::from_fn(members.len(), duties.len(), |(row, column)| cost(&members[row], duties[column]));
        let (cheapest, columns) = kuhn_munkres_min(&costs);
        let present: i64 = members.iter().map(|member| cost(member, member.duty)).sum();
        let doubled = duties.iter().any(|duty| members.iter().all(|member| member.duty != *duty));
        if !doubled && present - cheapest <= millimetres(self.min_gain) {
            return None;
        }
        let distribution: Distribution =
            members.iter().zip(columns).map(|(member, column)| (*member, duties[column])).collect();
        reassignment(cast, &distribution)
    }
}

impl Validate for Optimal {
    fn validate(&self) -> Result<(), Fault> {
        self.places.validate_as("places")?;
        check_all([("min_gain", self.min_gain, Bound::LENGTH), ("rest", self.rest, Bound::SECONDS)])
    }
}

/// Whole numbers, which the algorithm adds up without rounding; more than a million metres is as good as that.
fn millimetres(metres: f32) -> i64 {
    (metres * 1000.0).round().min(1e9) as i64
}
