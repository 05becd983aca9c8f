//! Getting behind the ball, facing the goal: the approach that makes a push a shot.
//!
//! Ball and goal are in metres from the robot, on the team frame's axes. Everything is worked out in the
//! frame from ball to goal, so it is the same for every direction of play and for both sides. A result's
//! angle is the course to steer, its length (at most 1) the fraction of full speed.
//!
//! Source: the dock-and-dribble schema of Clay's CyeSoccer domain (SwirlToBall; Emery & Balch on pushing),
//! but the cone has hysteresis, the path goes round the ball, and the output is normalised.

use std::f32::consts::FRAC_PI_2;

use bevy::prelude::*;

use crate::ops;

/// The settings of [`dock_behind`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Docking {
    /// At a smaller misalignment, in radians, the robot closes in on the ball.
    pub enter_cone: f32,
    /// At a larger misalignment, in radians, it goes back to orbiting.
    pub leave_cone: f32,
    /// The radius of the orbit round the ball and the distance behind it to head for, in metres.
    pub standoff: f32,
    /// Nearer to the ball than this, in metres, the robot orbits or closes in.
    pub orbit_enter: f32,
    /// Farther from the ball than this, in metres, it heads for the point behind the ball.
    pub orbit_leave: f32,
}

impl Default for Docking {
    fn default() -> Docking {
        Docking {
            enter_cone: 60f32.to_radians(),
            leave_cone: 75f32.to_radians(),
            standoff: 0.6,
            orbit_enter: 0.8,
            orbit_leave: 1.0,
        }
    }
}

/// The smallest fraction of full speed with which a misaligned robot backs out from a ball that is right at
/// it.
const MIN_PACE: f32 = 0.3;

/// What docking remembers from step to step, so that it does not dither between its phases.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DockLatch {
    in_cone: bool,
    orbiting: bool,
}

/// The angle in radians, 0 to π, between the robot's line to the ball and the ball's line to the goal: 0 when
/// the robot is behind the ball and all three are in line, π when it is between ball and goal. 0 if either
/// line has no direction.
pub fn misalignment(ball: Vec2, goal: Vec2) -> f32 {
    let shot = goal - ball;
    ops::atan2(ball.perp_dot(shot).abs(), ball.dot(shot))
}

/// Steers the robot behind the ball, facing the goal, in three phases. Far off, straight to the point
/// `standoff` behind the ball, or along the tangent of the circle of that radius if the ball is in the way.
/// Near but beside or before the ball, on along that circle by the shorter side, outwards if too near. Near
/// and in the cone, a blend of approach and tangent by the misalignment, which brings the robot round to the
/// line of the shot as it reaches the ball. Full speed but for the bends near the ball.
pub fn dock_behind(ball: Vec2, goal: Vec2, docking: &Docking, latch: &mut DockLatch) -> Vec2 {
    let shot = (goal - ball).normalize_or_zero();
    let towards = ball.normalize_or_zero();
    if towards == Vec2::ZERO || shot == Vec2::ZERO {
        return if towards == Vec2::ZERO { shot } else { towards };
    }
    let distance = ball.length();
    let off = misalignment(ball, goal);
    // A standoff outside `orbit_enter` would leave the robot waiting at the standoff point.
    let enter = docking.orbit_enter.max(1.1 * docking.standoff);
    let leave = docking.orbit_leave.max(enter);
    latch.in_cone = if latch.in_cone { off <= docking.leave_cone } else { off < docking.enter_cone };
    latch.orbiting = if latch.orbiting { distance <= leave } else { distance < enter };

    // Nearer than the standoff the way bends the more: slower with nearness, unless in line with the shot.
    let nearness = (distance / docking.standoff).clamp(MIN_PACE, 1.0);
    let pace = 1.0 - (1.0 - nearness) * (off / docking.enter_cone).min(1.0);

    if ball.dot(shot) >= docking.standoff && !(latch.in_cone && latch.orbiting) {
        // From here the circle round the ball is not in the way.
        return (ball - shot * docking.standoff).normalize_or_zero();
    }
    let parts = if latch.in_cone && latch.orbiting {
        close_in(distance, off, docking)
    } else {
        go_round(distance, docking.standoff)
    };
    // The tangent that leads behind the ball on the side where the robot is; dead ahead of it, the left one.
    let tangent = if shot.perp_dot(ball) <= 0.0 { -towards.perp() } else { towards.perp() };
    (towards * parts.x + tangent * parts.y).normalize_or_zero() * pace
}

/// The course as approach (x) and tangent (y), blended by the misalignment: all tangent at the cone's edge,
/// all approach in line. Misalignment then falls faster than distance. Where the robot is nearer to the ball
/// than its misalignment allows, it backs off.
fn close_in(distance: f32, off: f32, docking: &Docking) -> Vec2 {
    let (along, approach) = ops::sin_cos((off / docking.enter_cone).min(1.0) * FRAC_PI_2);
    let too_near = (along - distance / docking.standoff).max(0.0);
    Vec2::new(approach - too_near, along)
}

/// The course as approach (x) and tangent (y): the tangent of the circle of radius `standoff` from outside; from
/// inside more and more outwards, and straight away from the ball at two thirds of the radius.
fn go_round(distance: f32, standoff: f32) -> Vec2 {
    if distance >= standoff {
        let along = standoff / distance;
        return Vec2::new((1.0 - along * along).sqrt(), along);
    }
    let outwards = (3.0 * (1.0 - distance / standoff)).min(1.0);
    Vec2::new(-outwards, (1.0 - outwards * outwards).sqrt())
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use proptest::prelude::*;

    use super::*;
    use crate::geometry::{angle, unit, wrap_angle};

    const GOAL: Vec2 = Vec2::new(6.0, 0.0);

    /// The ball and goal as a robot at `robot` has them, with the ball in the origin.
    fn seen_from(robot: Vec2) -> (Vec2, Vec2) {
        (-robot, GOAL - robot)
    }

    fn dock_from(robot: Vec2, latch: &mut DockLatch) -> Vec2 {
        let (ball, goal) = seen_from(robot);
        dock_behind(ball, goal, &Docking::default(), latch)
    }

    #[test]
    fn misalignment_is_zero_behind_and_pi_before_the_ball() {
        let off = |x: f32, y: f32| {
            let (ball, goal) = seen_from(Vec2::new(x, y));
            misalignment(ball, goal)
        };
        assert_eq!(off(-1.0, 0.0), 0.0);
        assert!((off(1.0, 0.0) - PI).abs() < 1e-6);
        assert!((off(0.0, 2.0) - FRAC_PI_2).abs() < 1e-6 && (off(0.0, -2.0) - FRAC_PI_2).abs() < 1e-6);
        assert!((off(-1.0, 1.0) - PI / 4.0).abs() < 1e-6);
        assert_eq!(misalignment(Vec2::ZERO, GOAL), 0.0);
    }

    #[test]
    fn behind_and_in_line_the_course_is_straight_through_the_ball() {
        for distance in [0.25, 0.5, 0.9, 3.0] {
            let course = dock_from(Vec2::new(-distance, 0.0), &mut DockLatch::default());
            assert!((course - Vec2::X).length() < 1e-5, "{distance}: {course}");
        }
    }

    #[test]
    fn far_behind_the_course_is_to_the_standoff_point() {
        let course = dock_from(Vec2::new(-2.6, 2.0), &mut DockLatch::default());
        assert!((course - Vec2::new(2.0, -2.0).normalize()).length() < 1e-5, "{course}");
    }

    #[test]
    fn far_before_or_beside_the_ball_the_course_is_a_tangent_of_the_standoff_circle() {
        for robot in [Vec2::new(2.0, 0.5), unit(PI - 55f32.to_radians()) * 0.9] {
            let course = dock_from(robot, &mut DockLatch::default());
            assert!((robot.perp_dot(course) - 0.6).abs() < 1e-5, "by the left, the shorter side: {course}");
        }
    }

    #[test]
    fn beside_the_ball_the_course_is_along_the_orbit_to_its_back() {
        assert!((dock_from(Vec2::new(0.0, 0.6), &mut DockLatch::default()) - Vec2::NEG_X).length() < 1e-5);
        assert!((dock_from(Vec2::new(0.0, -0.6), &mut DockLatch::default()) - Vec2::NEG_X).length() < 1e-5);
    }

    #[test]
    fn nearer_than_the_standoff_the_orbit_leads_outwards() {
        let course = dock_from(Vec2::new(0.0, 0.45), &mut DockLatch::default());
        assert!((course.normalize().y - 0.75).abs() < 1e-5 && course.x < 0.0, "{course}");
        let course = dock_from(Vec2::new(0.0, 0.3), &mut DockLatch::default());
        assert!((course - Vec2::new(0.0, 0.5)).length() < 1e-5, "{course}");
    }

    #[test]
    fn near_the_ball_a_misaligned_robot_is_slow_but_never_stands() {
        let pace = |x: f32, y: f32| dock_from(Vec2::new(x, y), &mut DockLatch::default()).length();
        assert!((pace(0.0, 0.45) - 0.75).abs() < 1e-5 && (pace(0.0, 0.7) - 1.0).abs() < 1e-5);
        assert!((pace(0.0, 0.001) - MIN_PACE).abs() < 1e-5);
        assert!((pace(-0.2, 0.0) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn in_the_cone_but_too_near_for_its_misalignment_the_robot_closes_in_more_slowly() {
        let approach = |distance: f32| {
            let away = unit(PI - 30f32.to_radians());
            dock_from(away * distance, &mut DockLatch::default()).normalize().dot(-away)
        };
        assert!((approach(0.5) - 0.5f32.sqrt()).abs() < 1e-3 && (approach(0.25) - 0.5077).abs() < 1e-3);
    }

    #[test]
    fn a_standoff_outside_the_orbit_does_not_leave_the_robot_waiting_there() {
        let docking = Docking { standoff: 1.0, ..default() };
        let course = dock_behind(Vec2::X, GOAL, &docking, &mut DockLatch::default());
        assert_eq!(course, Vec2::X);
    }

    #[test]
    fn the_cone_and_the_orbit_have_hysteresis() {
        let mut latch = DockLatch::default();
        let at = |degrees: f32, distance: f32| unit(PI - degrees.to_radians()) * distance;
        let mut phase = |degrees: f32, distance: f32| {
            dock_from(at(degrees, distance), &mut latch);
            (latch.in_cone, latch.orbiting)
        };
        assert_eq!(phase(65.0, 0.9), (false, false));
        assert_eq!(phase(59.0, 0.79), (true, true));
        assert_eq!(phase(74.0, 0.99), (true, true));
        assert_eq!(phase(76.0, 1.01), (false, false));
        assert_eq!(phase(61.0, 0.81), (false, false));
    }

    #[test]
    fn missing_directions_give_the_other_one_or_zero() {
        let docking = Docking::default();
        assert_eq!(dock_behind(Vec2::ZERO, GOAL, &docking, &mut DockLatch::default()), Vec2::X);
        assert_eq!(dock_behind(Vec2::Y, Vec2::Y, &docking, &mut DockLatch::default()), Vec2::Y);
        assert_eq!(dock_behind(Vec2::ZERO, Vec2::ZERO, &docking, &mut DockLatch::default()), Vec2::ZERO);
    }

    /// A unicycle that runs at up to 0.6 m/s even while it turns, at up to 2.5 rad/s, at 20 Hz, round a ball
    /// that lies still: the time until it is docked, or why it did not.
    fn run(start: Vec2, heading: f32, goal: Vec2) -> Result<f32, String> {
        let (mut robot, mut heading, mut latch) = (start, heading, DockLatch::default());
        for step in 0..300 {
            let (ball, to_goal) = (-robot, goal - robot);
            let course = dock_behind(ball, to_goal, &Docking::default(), &mut latch);
            if ball.length() < 0.2 && !latch.in_cone {
                return Err(format!("touched the ball from {robot} after {step} steps"));
            }
            if ball.length() < 0.35 && misalignment(ball, to_goal) < 20f32.to_radians() {
                return Ok(step as f32 * 0.05);
            }
            heading += (wrap_angle(angle(course) - heading) * 6.0).clamp(-2.5, 2.5) * 0.05;
            robot += unit(heading) * course.length() * 0.6 * 0.05;
        }
        Err(format!("still at {robot} after 15 s"))
    }

    proptest! {
        #[test]
        fn from_anywhere_and_any_heading_a_robot_docks_within_fifteen_seconds(
            at in -PI..PI, distance in 0.5f32..3.0, heading in -PI..PI, goal_at in -PI..PI, goal in 1.0f32..8.0,
        ) {
            let time = run(unit(at) * distance, heading, unit(goal_at) * goal);
            prop_assert!(time.is_ok(), "{time:?}");
        }

        #[test]
        fn turning_or_mirroring_the_scene_turns_or_mirrors_the_course(
            x in -2.0f32..2.0, y in -2.0f32..2.0, gx in -5.0f32..5.0, gy in -5.0f32..5.0, turn in -3.0f32..3.0,
            in_cone: bool, orbiting: bool,
        ) {
            let (ball, goal) = (Vec2::new(x, y), Vec2::new(gx, gy));
            let docking = Docking::default();
            // Off the tie dead ahead and off the edges between the phases, where rounding alone decides.
            let (off, distance) = (misalignment(ball, goal), ball.length());
            let behind = ball.dot((goal - ball).normalize_or_zero());
            prop_assume!(distance > 0.05 && (goal - ball).length() > 0.05 && off < PI - 1e-3);
            let edges = [docking.enter_cone - off, docking.leave_cone - off, docking.orbit_enter - distance,
                docking.orbit_leave - distance, docking.standoff - behind];
            prop_assume!(edges.iter().all(|edge| edge.abs() > 1e-3));
            // The far course has no direction at the standoff point itself.
            prop_assume!((ball - (goal - ball).normalize_or_zero() * docking.standoff).length() > 0.02);

            let dock = |ball, goal| {
                let mut latch = DockLatch { in_cone, orbiting };
                (dock_behind(ball, goal, &docking, &mut latch), latch)
            };
            let (course, latch) = dock(ball, goal);
            prop_assert!((MIN_PACE - 1e-4..1.0 + 1e-4).contains(&course.length()));
            let turned = |v: Vec2| unit(turn).rotate(v);
            let (got, turned_latch) = dock(turned(ball), turned(goal));
            prop_assert!((got - turned(course)).length() < 5e-3, "{got} {}", turned(course));
            let mirrored = |v: Vec2| Vec2::new(v.x, -v.y);
            let (got, mirrored_latch) = dock(mirrored(ball), mirrored(goal));
            prop_assert!((got - mirrored(course)).length() < 1e-4, "{got} {}", mirrored(course));
            prop_assert!(turned_latch == latch && mirrored_latch == latch);
        }
    }
}
