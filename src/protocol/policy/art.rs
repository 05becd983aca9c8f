//! After ART 2000, as the Hammerheads paper (section II) describes it: two utility functions, whose values all robots tell
//! each other, and two thresholds on a robot's value relative to the others'.
//!
//! The first function says how well the robot can reach the ball and is for the forward, the second how well it can defend and
//! is for the halfback; the floater is who is left. A value is divided by the mean of all robots', so that 1 is average. The
//! robot with the highest value takes the role once it is at least at `enter` and the one that has the role has fallen to
//! `leave`; what lies in between keeps a role from changing hands again and again. A forward defends only after it has fallen
//! to `leave` on the ball. The robot that takes a role proposes the exchange. The functions themselves are ours.

use serde::{Deserialize, Serialize};
use smallvec::smallvec;

use super::knowledge::{ColumnValues, Duty, Knowledge, SwapRoles};
use super::members::{Bidder, bidders, exchange, highest, is_given_up, me, members};
use super::places::{Places, ball, nearness};
use crate::data::{Bound, Fault, Validate, check_all, ensure};
use crate::geometry::{angle, wrap_angle};
use crate::ids::PlayerNumber;
use crate::protocol::role_swap::Reassignment;

/// Columns: reaching the ball, defending.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Art {
    /// Where the roles are best played.
    pub places: Places,
    /// Distance at which a utility is a half, m.
    pub half: f32,
    /// Metres that a radian between the robot's heading and the ball counts for.
    pub turning: f32,
    /// Share of the average at which a robot may take a role over.
    pub enter: f32,
    /// Share of the average at which it gives the role up; less than `enter`.
    pub leave: f32,
    /// Age from which values no longer count, s.
    pub max_age: f32,
    /// Seconds for which no role must have changed.
    pub rest: f32,
}

impl Default for Art {
    fn default() -> Art {
        Art {
            places: Places::default(),
            half: 1.5,
            turning: 0.2,
            enter: 1.2,
            leave: 0.8,
            max_age: 1.0,
            rest: 2.0,
        }
    }
}

const REACH: usize = 0;
const DEFEND: usize = 1;

impl Art {
    pub(super) fn decide(&self, cast: &SwapRoles, knowledge: &Knowledge) -> Option<Reassignment> {
        let bidders = bidders(cast, knowledge, (self.values(cast, knowledge)?, None), self.max_age);
        let members = members(cast, knowledge);
        let me = me(&members, knowledge)?;
        let gives_up =
            |number, column| relative(&bidders, number, column).is_some_and(|share| share <= self.leave);
        if me.duty == Duty::Forward && !gives_up(me.number, REACH) {
            return None;
        }
        let mut roles = [(REACH, Duty::Forward), (DEFEND, Duty::Halfback)].into_iter();
        let takes = |column| {
            highest(&bidders, column).is_some_and(|best| best.number == me.number)
                && relative(&bidders, me.number, column).is_some_and(|share| share >= self.enter)
        };
        let (_, duty) = roles.find(|(column, duty)| {
            me.duty != *duty
                && takes(*column)
                && is_given_up(&members, *duty, |holder| gives_up(holder, *column))
        })?;
        exchange(cast, me, duty, &members)
    }

    pub(super) fn values(&self, cast: &SwapRoles, knowledge: &Knowledge) -> Option<ColumnValues> {
        let me = me(&members(cast, knowledge), knowledge)?;
        let ball = ball(knowledge)?;
        let reach = if knowledge.tight_control {
            1.0
        } else {
            let turn = wrap_angle(angle(ball - me.position) - me.heading).abs();
            nearness(me.position.distance(ball) + self.turning * turn, self.half)
        };
        let way_home = self.places.distance(me.position, Duty::Halfback, ball, knowledge.goal);
        Some(smallvec![reach, nearness(way_home, self.half)])
    }
}

impl Validate for Art {
    fn validate(&self) -> Result<(), Fault> {
        self.places.validate_as("places")?;
        check_all([
            ("half", self.half, Bound::LENGTH.positive()),
            ("turning", self.turning, Bound::FACTOR),
            ("enter", self.enter, Bound::FACTOR.positive()),
            ("leave", self.leave, Bound::FACTOR),
            ("max_age", self.max_age, Bound::SECONDS.positive()),
            ("rest", self.rest, Bound::SECONDS),
        ])?;
        let (enter, leave) = (self.enter, self.leave);
        ensure(leave < enter, "leave", || format!("must be less than enter, {enter}, not {leave}"))
    }
}

/// A robot's value in a column as a share of the mean of all bidders.
fn relative(bidders: &[Bidder], number: PlayerNumber, column: usize) -> Option<f32> {
    let value = |bidder: &Bidder| bidder.values[column].max(0.0);
    let own = value(bidders.iter().find(|bidder| bidder.member.number == number)?);
    let mean = bidders.iter().map(value).sum::<f32>() / bidders.len() as f32;
    Some(if mean > 0.0 { own / mean } else { 1.0 })
}
