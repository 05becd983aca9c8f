//! Taking the ball in the scoop to the goal without losing it.
//!
//! Ball and goal are in metres from the robot, on the team frame's axes; headings in radians from +x. The
//! result is a unit vector: its angle is the course to steer.
//!
//! Source: the second half of Clay's dock-and-dribble schema (SwirlToBall); the limit on the turn is ours.

use bevy::prelude::*;

use crate::geometry::{angle, unit, wrap_angle};

/// Takes a ball in the scoop to the goal: a unit vector towards the goal, at most `tight` radians off the
/// present `heading` so that the ball does not roll out of the turn. A ball off the middle of the scoop is
/// recentred by steering towards it, which outweighs the goal: the robot stays behind its ball.
pub fn dribble(ball: Vec2, goal: Vec2, heading: f32, tight: f32) -> Vec2 {
    let off_course = |point: Vec2| if point == Vec2::ZERO { 0.0 } else { wrap_angle(angle(point) - heading) };
    let wanted = off_course(goal).clamp(-tight, tight);
    let turn = (wanted + off_course(ball)).clamp(-tight, tight);
    unit(heading + turn)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const GOAL: Vec2 = Vec2::new(6.0, 0.0);

    #[test]
    fn a_centred_ball_goes_straight_to_a_goal_ahead() {
        assert!((dribble(Vec2::new(0.25, 0.0), GOAL, 0.0, 0.3) - Vec2::X).length() < 1e-6);
    }

    #[test]
    fn dribbling_turns_to_the_goal_but_no_tighter_than_asked() {
        let gentle = dribble(Vec2::new(0.25, 0.0), unit(0.2) * 4.0, 0.0, 0.3);
        assert!((angle(gentle) - 0.2).abs() < 1e-5, "{gentle}");
        let sharp = dribble(Vec2::new(0.25, 0.0), unit(-2.0) * 4.0, 0.0, 0.3);
        assert!((angle(sharp) + 0.3).abs() < 1e-5, "{sharp}");
    }

    #[test]
    fn a_ball_off_the_middle_is_recentred_before_the_goal_counts() {
        let ball = unit(-0.4) * 0.25;
        assert!((angle(dribble(ball, unit(1.5) * 4.0, 0.0, 0.3)) + 0.1).abs() < 1e-5);
        assert!((angle(dribble(unit(0.1) * 0.25, GOAL, 0.0, 0.3)) - 0.1).abs() < 1e-5);
    }

    #[test]
    fn a_ball_or_goal_at_zero_distance_does_not_turn_the_robot() {
        assert!((dribble(Vec2::ZERO, Vec2::ZERO, 0.7, 0.3) - unit(0.7)).length() < 1e-6);
    }

    #[test]
    fn a_robot_that_follows_its_dribble_comes_to_face_the_goal() {
        let (mut robot, mut heading) = (Vec2::ZERO, 2.5);
        for _ in 0..200 {
            let course = dribble(unit(heading) * 0.25, GOAL - robot, heading, 0.3);
            heading += wrap_angle(angle(course) - heading).clamp(-0.05, 0.05);
            robot += unit(heading) * 0.02;
        }
        assert!(wrap_angle(angle(GOAL - robot) - heading).abs() < 0.02, "{heading} at {robot}");
    }

    proptest! {
        #[test]
        fn dribbling_never_turns_tighter_than_asked_and_turns_with_the_scene(
            bearing in -1.0f32..1.0, goal_at in -3.0f32..3.0, heading in -3.0f32..3.0, tight in 0.05f32..0.6,
        ) {
            let (ball, goal) = (unit(bearing) * 0.25, unit(goal_at) * 3.0);
            let still = dribble(ball, goal, 0.0, tight);
            prop_assert!(angle(still).abs() <= tight + 1e-5);
            let by = |v: Vec2| unit(heading).rotate(v);
            prop_assert!((dribble(by(ball), by(goal), heading, tight) - by(still)).length() < 1e-4);
            let mirrored = |v: Vec2| Vec2::new(v.x, -v.y);
            prop_assert!((dribble(mirrored(ball), mirrored(goal), 0.0, tight) - mirrored(still)).length() < 1e-5);
        }
    }
}
