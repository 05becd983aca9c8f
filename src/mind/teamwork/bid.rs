//! What a robot bids for the ball: its distance, as in figure 5, or the time until it can play the ball (TeamChaos, section 4:
//! "if its own position with respect to the ball is better").

use bevy::prelude::*;

use crate::geometry::{Pose, angle, wrap_angle};
use crate::mind::schemas::docking::misalignment;
use crate::strategy::teamwork::BidBy;

/// How fast a robot gets on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// m/s
    pub speed: f32,
    /// rad/s
    pub turn: f32,
}

/// A robot's bid, m. A time is told as the way that the robot goes in it at full speed, so that bids and thresholds have one unit.
pub fn bid(by: BidBy, pose: Pose, ball: Vec2, goal: Vec2, pace: Pace) -> f32 {
    let to_ball = ball - pose.position;
    match by {
        BidBy::Distance => to_ball.length(),
        BidBy::Time { round } => {
            let turn = wrap_angle(angle(to_ball) - pose.heading).abs();
            let turn = if to_ball == Vec2::ZERO || pace.turn <= 0.0 { 0.0 } else { turn / pace.turn };
            let way_round = round * misalignment(to_ball, goal - pose.position);
            to_ball.length() + pace.speed * turn + way_round
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use proptest::prelude::*;

    use super::*;
    use crate::geometry::unit;

    const GOAL: Vec2 = Vec2::new(2.7, 0.0);
    const PACE: Pace = Pace { speed: 0.4, turn: 2.0 };
    const TIME: BidBy = BidBy::Time { round: 0.3 };

    fn bid_of(by: BidBy, x: f32, y: f32, heading: f32) -> f32 {
        bid(by, Pose::new(x, y, heading), Vec2::ZERO, GOAL, PACE)
    }

    #[test]
    fn a_robot_that_faces_ball_and_goal_bids_its_distance() {
        assert!((bid_of(TIME, -0.8, 0.0, 0.0) - 0.8).abs() < 1e-5);
        assert_eq!(bid_of(BidBy::Distance, 0.8, 0.0, 0.0), 0.8);
    }

    #[test]
    fn one_that_looks_away_has_to_turn_first() {
        // Half a turn takes π / 2 s, in which it would walk 0.4 π / 2 m.
        assert!((bid_of(TIME, -0.8, 0.0, PI) - (0.8 + 0.2 * PI)).abs() < 1e-4);
    }

    #[test]
    fn one_that_is_on_the_wrong_side_has_to_go_round() {
        assert!((bid_of(TIME, 0.8, 0.0, PI) - (0.8 + 0.3 * PI)).abs() < 1e-4);
        let grabs = BidBy::Time { round: 0.0 };
        assert!((bid_of(grabs, 0.8, 0.0, PI) - 0.8).abs() < 1e-4);
    }

    #[test]
    fn one_that_stands_in_the_ball_is_there() {
        assert!((bid_of(TIME, 0.0, 0.0, 1.0)).abs() < 1e-5);
    }

    proptest! {
        #[test]
        fn the_time_is_never_less_than_the_way_takes_and_the_same_on_both_sides(
            from in -PI..PI, distance in 0.05f32..4.0, heading in -PI..PI,
        ) {
            let at = unit(from) * distance;
            let time = bid_of(TIME, at.x, at.y, heading);
            prop_assert!(time >= distance - 1e-4 && time <= distance + 0.2 * PI + 0.3 * PI + 1e-3, "{time}");
            prop_assert!((time - bid_of(TIME, at.x, -at.y, -heading)).abs() < 1e-3);
        }
    }
}
