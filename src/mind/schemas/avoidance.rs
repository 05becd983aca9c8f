//! Schemas that push away from obstacles, and the linear falloff with distance that the other reactive
//! schemas share.
//!
//! Obstacles are their nearest points in metres from the robot, on the team frame's axes. A result's angle is
//! the course to steer and its length the fraction of full speed. Inside the safety radius the push is
//! finite, so that it outvotes the other schemas of an assemblage instead of erasing them.
//!
//! Source: Clay's Avoid node, after Arkin's avoid-static-obstacle schema.

use bevy::prelude::*;

use super::combine::capped_sum;

/// The push inside the safety radius, in fractions of full speed. Clay has 1e14, beside which every other
/// term vanishes; 3 beats any two full-speed schemas of weight 1 and still lets them choose the way out.
pub const INSIDE_SAFETY: f32 = 3.0;

/// 1 nearer than `safety`, 0 from `sphere` outwards, linear between (all in metres). A sphere that is not
/// larger than the safety radius makes a step at the sphere. Clay's and Arkin's obstacle magnitude, without
/// the infinity.
pub fn falloff(distance: f32, sphere: f32, safety: f32) -> f32 {
    if distance >= sphere {
        0.0
    } else if distance < safety {
        1.0
    } else {
        (sphere - distance) / (sphere - safety)
    }
}

/// Clay's Avoid of one obstacle: straight away from it, from 0 at `sphere` up to 1 at `safety` (metres), and
/// [`INSIDE_SAFETY`] nearer than that. An obstacle at exactly zero distance has no direction and gives zero.
pub fn avoid(obstacle: Vec2, sphere: f32, safety: f32) -> Vec2 {
    let distance = obstacle.length();
    let magnitude =
        if distance < safety.min(sphere) { INSIDE_SAFETY } else { falloff(distance, sphere, safety) };
    -obstacle.normalize_or_zero() * magnitude
}

/// Clay's Avoid of a list: the sum of the single pushes; longer than 1, it takes the largest single length,
/// so at most 1 while all obstacles are outside the safety radius and at most [`INSIDE_SAFETY`] at any time.
pub fn avoid_all(obstacles: impl IntoIterator<Item = Vec2>, sphere: f32, safety: f32) -> Vec2 {
    capped_sum(obstacles.into_iter().map(|obstacle| avoid(obstacle, sphere, safety)))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::unit;

    fn assert_near(got: Vec2, want: Vec2) {
        assert!((got - want).length() < 1e-5, "got {got}, want {want}");
    }

    #[test]
    fn avoid_is_zero_beyond_the_sphere_and_at_its_edge() {
        assert_eq!(avoid(Vec2::new(1.5, 0.0), 1.5, 0.5), Vec2::ZERO);
        assert_eq!(avoid(Vec2::new(0.0, 7.0), 1.5, 0.5), Vec2::ZERO);
    }

    #[test]
    fn avoid_grows_linearly_to_one_at_the_safety_radius() {
        assert_near(avoid(Vec2::new(1.25, 0.0), 1.5, 0.5), Vec2::new(-0.25, 0.0));
        assert_near(avoid(Vec2::new(0.0, -0.75), 1.5, 0.5), Vec2::new(0.0, 0.75));
        assert_near(avoid(Vec2::new(0.5, 0.0), 1.5, 0.5), Vec2::NEG_X);
    }

    #[test]
    fn inside_safety_the_push_is_finite_and_outvotes_two_schemas() {
        let push = avoid(Vec2::new(0.3, 0.4), 1.5, 0.51);
        assert_near(push, Vec2::new(-0.6, -0.8) * INSIDE_SAFETY);
        assert!((push + Vec2::new(0.6, 0.8) * 2.0).dot(Vec2::new(0.6, 0.8)) < 0.0);
    }

    #[test]
    fn an_obstacle_at_zero_distance_has_no_direction() {
        assert_eq!(avoid(Vec2::ZERO, 1.5, 0.5), Vec2::ZERO);
        assert_eq!(avoid_all([Vec2::ZERO], 1.5, 0.5), Vec2::ZERO);
    }

    #[test]
    fn a_sphere_smaller_than_the_safety_radius_still_bounds_the_push() {
        assert_eq!(avoid(Vec2::new(0.6, 0.0), 0.5, 0.8), Vec2::ZERO);
        assert_near(avoid(Vec2::new(0.4, 0.0), 0.5, 0.8), Vec2::new(-INSIDE_SAFETY, 0.0));
        assert_eq!(falloff(0.5, 0.5, 0.5), 0.0);
        assert_eq!(falloff(0.49, 0.5, 0.5), 1.0);
    }

    #[test]
    fn a_wall_of_points_pushes_no_harder_than_its_nearest_point() {
        let wall = [Vec2::new(0.7, -0.2), Vec2::new(0.7, 0.0), Vec2::new(0.7, 0.2)];
        assert_near(avoid_all(wall, 1.5, 0.5), Vec2::new(-0.8, 0.0));
    }

    #[test]
    fn one_obstacle_inside_safety_sets_the_length_for_all() {
        let push = avoid_all([Vec2::new(0.3, 0.0), Vec2::new(0.0, 1.0)], 1.5, 0.5);
        assert!((push.length() - INSIDE_SAFETY).abs() < 1e-5, "{push}");
        assert!((push.y / push.x - 0.5 / INSIDE_SAFETY).abs() < 1e-5, "{push}");
    }

    #[test]
    fn the_middle_of_a_corridor_is_at_rest() {
        assert_near(avoid_all([Vec2::new(0.0, 1.0), Vec2::new(0.0, -1.0)], 1.5, 0.5), Vec2::ZERO);
        assert_eq!(avoid_all([], 1.5, 0.5), Vec2::ZERO);
    }

    proptest! {
        #[test]
        fn avoid_points_away_and_turns_with_the_obstacle(
            x in -2.0f32..2.0, y in -2.0f32..2.0, turn in -3.0f32..3.0, s in 0.0f32..0.5,
        ) {
            let obstacle = Vec2::new(x, y);
            // Off the step at the safety radius, where rounding alone decides.
            prop_assume!((obstacle.length() - s).abs() > 1e-4 && obstacle.length() > 1e-3);
            let push = avoid(obstacle, 1.5, s);
            prop_assert!(push.dot(obstacle) <= 0.0 && push.perp_dot(obstacle).abs() < 1e-4);
            prop_assert!((avoid(unit(turn).rotate(obstacle), 1.5, s) - unit(turn).rotate(push)).length() < 1e-4);
        }

        #[test]
        fn many_obstacles_never_push_harder_than_the_largest_single_push_or_one(
            points in prop::collection::vec((-2.0f32..2.0, -2.0f32..2.0), 0..8),
        ) {
            let points: Vec<Vec2> = points.into_iter().map(|(x, y)| Vec2::new(x, y)).collect();
            let largest = points.iter().map(|&p| avoid(p, 1.5, 0.5).length()).fold(1.0, f32::max);
            prop_assert!(avoid_all(points, 1.5, 0.5).length() <= largest + 1e-5);
        }
    }
}
