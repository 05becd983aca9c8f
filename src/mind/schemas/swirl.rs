//! Schemas that lead round obstacles: they steer at right angles to an obstacle, where avoidance would stop
//! in front of it.
//!
//! Obstacles and references are in metres from the robot, on the team frame's axes; of a reference only the
//! direction counts. A result's angle is the course to steer, its length (at most 1) the fraction of full
//! speed. A list takes the direction of the sum and the length of its largest single term.
//!
//! Source: Clay's Swirl, SwirlLeft and GeoField nodes.

use bevy::prelude::*;

use super::avoidance::falloff;
use super::combine::longest_along_sum;

/// How far to the side of the course, in metres, a [`geo_field`] is strongest, and from where on it is zero.
const GEO_PEAK: f32 = 0.1;
const GEO_EDGE: f32 = 0.4;

/// Clay's Swirl round one obstacle: only for one less than 90° off the reference direction, at right angles
/// to it on the side where the reference lies (to the left if dead ahead), with length 1 up to `safety` and 0
/// from `sphere` (metres).
pub fn swirl(obstacle: Vec2, reference: Vec2, sphere: f32, safety: f32) -> Vec2 {
    if obstacle.dot(reference) <= 0.0 {
        return Vec2::ZERO;
    }
    let left = obstacle.normalize_or_zero().perp();
    let side = if obstacle.perp_dot(reference) >= 0.0 { left } else { -left };
    side * falloff(obstacle.length(), sphere, safety)
}

/// Clay's Swirl round a list of obstacles.
pub fn swirl_all(
    obstacles: impl IntoIterator<Item = Vec2>,
    reference: Vec2,
    sphere: f32,
    safety: f32,
) -> Vec2 {
    longest_along_sum(obstacles.into_iter().map(|obstacle| swirl(obstacle, reference, sphere, safety)))
}

/// Clay's SwirlLeft: every obstacle, ahead or behind, is passed with it on the right hand.
pub fn swirl_left(obstacles: impl IntoIterator<Item = Vec2>, sphere: f32, safety: f32) -> Vec2 {
    longest_along_sum(
        obstacles
            .into_iter()
            .map(|obstacle| obstacle.normalize_or_zero().perp() * falloff(obstacle.length(), sphere, safety)),
    )
}

/// Clay's GeoField: the opposite side to [`swirl`], so across the obstacle's front, times a window over the
/// lateral offset from the reference course: 0 on the course, 1 at 0.1 m, 0 from 0.4 m; nothing behind.
pub fn geo_field(
    obstacles: impl IntoIterator<Item = Vec2>,
    reference: Vec2,
    sphere: f32,
    safety: f32,
) -> Vec2 {
    let course = reference.normalize_or_zero();
    longest_along_sum(obstacles.into_iter().map(|obstacle| {
        let offset = course.perp_dot(obstacle).abs();
        let window = if offset <= GEO_PEAK {
            offset / GEO_PEAK
        } else {
            ((GEO_EDGE - offset) / (GEO_EDGE - GEO_PEAK)).max(0.0)
        };
        -swirl(obstacle, course, sphere, safety) * window
    }))
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
    fn swirl_passes_on_the_side_where_the_reference_lies() {
        let obstacle = Vec2::new(0.3, 0.0);
        assert_near(swirl(obstacle, Vec2::new(5.0, 1.0), 2.0, 0.5), Vec2::Y);
        assert_near(swirl(obstacle, Vec2::new(5.0, -1.0), 2.0, 0.5), Vec2::NEG_Y);
    }

    #[test]
    fn swirl_turns_left_round_an_obstacle_dead_ahead() {
        assert_near(swirl(Vec2::new(0.3, 0.0), Vec2::new(5.0, 0.0), 2.0, 0.5), Vec2::Y);
        assert_near(swirl(Vec2::new(0.0, -0.3), Vec2::new(0.0, -5.0), 2.0, 0.5), Vec2::X);
    }

    #[test]
    fn swirl_ignores_what_is_abeam_or_behind_the_reference() {
        assert_eq!(swirl(Vec2::new(0.0, 0.3), Vec2::X, 2.0, 0.5), Vec2::ZERO);
        assert_eq!(swirl(Vec2::new(-0.3, 0.1), Vec2::X, 2.0, 0.5), Vec2::ZERO);
        assert_ne!(swirl(Vec2::new(0.001, 0.3), Vec2::X, 2.0, 0.5), Vec2::ZERO);
        assert_eq!(swirl(Vec2::X, Vec2::ZERO, 2.0, 0.5), Vec2::ZERO);
        assert_eq!(swirl(Vec2::ZERO, Vec2::X, 2.0, 0.5), Vec2::ZERO);
    }

    #[test]
    fn swirl_fades_linearly_to_zero_at_the_sphere() {
        assert_near(swirl(Vec2::new(1.25, 0.0), Vec2::X, 2.0, 0.5), Vec2::new(0.0, 0.5));
        assert_eq!(swirl(Vec2::new(2.0, 0.0), Vec2::X, 2.0, 0.5), Vec2::ZERO);
        assert_near(swirl(Vec2::new(0.5, 0.0), Vec2::X, 2.0, 0.5), Vec2::Y);
    }

    #[test]
    fn many_swirls_have_the_direction_of_the_sum_and_the_largest_length() {
        let two = [Vec2::new(1.25, -0.01), Vec2::new(1.55, -0.01)];
        let swirled = swirl_all(two, Vec2::X, 2.0, 0.5);
        assert!((swirled.length() - 0.5).abs() < 1e-4 && swirled.y > 0.49, "{swirled}");
        assert_eq!(swirl_all([], Vec2::X, 2.0, 0.5), Vec2::ZERO);
    }

    #[test]
    fn swirl_left_leaves_obstacles_on_the_right_even_behind() {
        assert_near(swirl_left([Vec2::new(0.0, -0.3)], 2.0, 0.5), Vec2::X);
        assert_near(swirl_left([Vec2::new(-1.25, 0.0)], 2.0, 0.5), Vec2::new(0.0, -0.5));
        assert_eq!(swirl_left([Vec2::ZERO, Vec2::new(9.0, 0.0)], 2.0, 0.5), Vec2::ZERO);
    }

    #[test]
    fn the_geo_field_is_against_the_swirl_and_windowed_by_the_lateral_offset() {
        let at = |y: f32| geo_field([Vec2::new(0.4, y)], Vec2::new(3.0, 0.0), 2.0, 1.0);
        assert_eq!(at(0.0), Vec2::ZERO);
        for (y, length) in [(0.05, 0.5), (0.1, 1.0), (0.25, 0.5), (0.4, 0.0), (0.6, 0.0)] {
            assert!((at(y).length() - length).abs() < 1e-4, "{y}: {}", at(y));
            assert!((at(-y).length() - length).abs() < 1e-4, "-{y}: {}", at(-y));
        }
        assert!(at(0.1).y > 0.9 && at(-0.1).y < -0.9);
        assert!(at(0.1).dot(swirl(Vec2::new(0.4, 0.1), Vec2::X, 2.0, 1.0)) < 0.0);
    }

    #[test]
    fn the_geo_field_is_zero_behind_and_beyond_the_sphere() {
        assert_eq!(geo_field([Vec2::new(-0.4, 0.1)], Vec2::X, 2.0, 1.0), Vec2::ZERO);
        assert_eq!(geo_field([Vec2::new(2.0, 0.1)], Vec2::X, 2.0, 1.0), Vec2::ZERO);
        let half = geo_field([Vec2::new(1.5, 0.1)], Vec2::X, 2.0, 1.0).length();
        assert!((half - 0.5).abs() < 0.01, "{half}");
    }

    proptest! {
        #[test]
        fn turning_or_mirroring_the_scene_turns_or_mirrors_the_swirl(
            x in -2.0f32..2.0, y in -2.0f32..2.0, rx in -2.0f32..2.0, ry in -2.0f32..2.0, turn in -3.0f32..3.0,
        ) {
            let (obstacle, reference) = (Vec2::new(x, y), Vec2::new(rx, ry));
            // Off the ties: dead ahead and abeam.
            prop_assume!(obstacle.perp_dot(reference).abs() > 1e-3 && obstacle.dot(reference).abs() > 1e-3);
            let swirled = swirl(obstacle, reference, 2.0, 0.5);
            prop_assert!(swirled.dot(obstacle).abs() < 1e-4);
            let by = |v: Vec2| unit(turn).rotate(v);
            prop_assert!((swirl(by(obstacle), by(reference), 2.0, 0.5) - by(swirled)).length() < 1e-4);
            let mirror = |v: Vec2| Vec2::new(v.x, -v.y);
            prop_assert_eq!(swirl(mirror(obstacle), mirror(reference), 2.0, 0.5), mirror(swirled));
            let field = geo_field([obstacle], reference, 2.0, 0.5);
            prop_assert!((geo_field([by(obstacle)], by(reference), 2.0, 0.5) - by(field)).length() < 1e-3);
            let left = swirl_left([obstacle], 2.0, 0.5);
            prop_assert!((swirl_left([by(obstacle)], 2.0, 0.5) - by(left)).length() < 1e-4);
        }
    }
}
