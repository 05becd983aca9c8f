//! Where a forward, a floater and a halfback would like to be, given the ball. The paper shows such places in its figures
//! (offensive support in section VI-C) and gives no numbers: these are ours.

use crate::geometry::Vec2;
use serde::{Deserialize, Serialize};

use super::knowledge::{Duty, Knowledge};
use crate::data::{Bound, Fault, Validate, check_all};

/// The places, relative to ball and goals.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Places {
    /// Metres from the ball to the forward, which is on the far side of it as seen from the opponents' goal.
    pub standoff: f32,
    /// Metres by which the floater is farther from the opponents' goal than the ball.
    pub behind: f32,
    /// Metres by which the floater keeps to one side of the ball, on whichever side it is nearer to.
    pub aside: f32,
    /// Share of the way from our goal to the ball at which the halfback waits.
    pub guard: f32,
}

impl Default for Places {
    fn default() -> Places {
        Places { standoff: 0.4, behind: 1.2, aside: 1.0, guard: 0.4 }
    }
}

impl Places {
    /// How far it is from a point to the place of a duty, in metres.
    pub(in crate::protocol) fn distance(&self, from: Vec2, duty: Duty, ball: Vec2, goal: Vec2) -> f32 {
        let ahead = (goal - ball).normalize_or(Vec2::X);
        match duty {
            Duty::Forward => from.distance(ball - ahead * self.standoff),
            Duty::Floater => {
                let spot = |side: f32| ball - ahead * self.behind + ahead.perp() * (side * self.aside);
                from.distance(spot(1.0)).min(from.distance(spot(-1.0)))
            }
            Duty::Halfback => from.distance((-goal).lerp(ball, self.guard)),
        }
    }
}

impl Validate for Places {
    fn validate(&self) -> Result<(), Fault> {
        check_all([
            ("standoff", self.standoff, Bound::LENGTH),
            ("behind", self.behind, Bound::LENGTH),
            ("aside", self.aside, Bound::LENGTH),
            ("guard", self.guard, Bound::SHARE),
        ])
    }
}

/// The value of being so many metres away: 1 at no distance, a half at `half` metres, 0 at infinity.
pub(in crate::protocol) fn nearness(distance: f32, half: f32) -> f32 {
    half / (half + distance)
}

/// The ball, if it is known and somewhere.
pub(super) fn ball(knowledge: &Knowledge) -> Option<Vec2> {
    knowledge.ball.filter(|ball| ball.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACES: Places = Places { standoff: 0.5, behind: 1.0, aside: 0.5, guard: 0.25 };
    const GOAL: Vec2 = Vec2::new(4.5, 0.0);

    #[test]
    fn the_forward_is_behind_the_ball_and_the_halfback_in_front_of_our_goal() {
        let ball = Vec2::new(1.5, 0.0);
        assert_eq!(PLACES.distance(Vec2::new(1.0, 0.0), Duty::Forward, ball, GOAL), 0.0);
        assert_eq!(PLACES.distance(Vec2::new(-3.0, 0.0), Duty::Halfback, ball, GOAL), 0.0);
    }

    #[test]
    fn the_floater_takes_the_nearer_side() {
        let ball = Vec2::new(1.5, 0.0);
        assert_eq!(PLACES.distance(Vec2::new(0.5, 2.5), Duty::Floater, ball, GOAL), 2.0);
        assert_eq!(PLACES.distance(Vec2::new(0.5, -2.5), Duty::Floater, ball, GOAL), 2.0);
    }

    #[test]
    fn nearness_halves_where_it_is_told_to() {
        assert_eq!(nearness(0.0, 1.5), 1.0);
        assert_eq!(nearness(1.5, 1.5), 0.5);
    }

    #[test]
    fn a_ball_in_the_goal_has_its_places_too() {
        assert!(Duty::ALL.into_iter().all(|duty| PLACES.distance(Vec2::ZERO, duty, GOAL, GOAL).is_finite()));
    }
}
