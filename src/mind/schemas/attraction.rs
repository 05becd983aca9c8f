//! Schemas that pull: towards one point, towards many, and towards things that matter only when near.
//!
//! Targets are in metres from the robot, on the team frame's axes. A result's angle is the course to steer
//! and its length the fraction of full speed. An unknown target is the caller's: it adds no term. A target at
//! exactly zero distance has no direction and gives zero.
//!
//! Source: Clay's LinearAttraction and Attract nodes, after Arkin's move-to-goal schema.

use bevy::prelude::*;

use super::avoidance::falloff;
use super::combine::capped_sum;

/// Clay's LinearAttraction, Arkin's move-to-goal with a ballistic and a controlled region: full speed from
/// `controlled_zone` outwards, falling linearly to 0 at `dead_zone` (both metres) and 0 inside that. With
/// both zones 0 it is always at full speed.
pub fn linear_attraction(target: Vec2, controlled_zone: f32, dead_zone: f32) -> Vec2 {
    let distance = target.length();
    let magnitude = if distance < dead_zone {
        0.0
    } else if distance < controlled_zone {
        (distance - dead_zone) / (controlled_zone - dead_zone)
    } else {
        1.0
    };
    target.normalize_or_zero() * magnitude
}

/// Clay's LinearAttraction to a list: the sum of the single pulls; longer than 1, it takes the largest single
/// length.
pub fn linear_attraction_all(
    targets: impl IntoIterator<Item = Vec2>,
    controlled_zone: f32,
    dead_zone: f32,
) -> Vec2 {
    capped_sum(targets.into_iter().map(|target| linear_attraction(target, controlled_zone, dead_zone)))
}

/// Clay's Attract: a pull that grows as the target gets nearer, from 0 at `sphere` to 1 at `safety` (metres)
/// and inside it. Summed over a list with the same cap as [`linear_attraction_all`].
pub fn attract_near(targets: impl IntoIterator<Item = Vec2>, sphere: f32, safety: f32) -> Vec2 {
    capped_sum(
        targets
            .into_iter()
            .map(|target| target.normalize_or_zero() * falloff(target.length(), sphere, safety)),
    )
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
    fn attraction_is_full_from_the_controlled_zone_outwards() {
        assert_near(linear_attraction(Vec2::new(0.0, 1.5), 1.5, 0.5), Vec2::Y);
        assert_near(linear_attraction(Vec2::new(-30.0, 40.0), 1.5, 0.5), Vec2::new(-0.6, 0.8));
    }

    #[test]
    fn attraction_falls_linearly_between_the_zones() {
        assert_near(linear_attraction(Vec2::new(0.75, 0.0), 1.5, 0.5), Vec2::new(0.25, 0.0));
        assert_near(linear_attraction(Vec2::new(0.0, -1.25), 1.5, 0.5), Vec2::new(0.0, -0.75));
    }

    #[test]
    fn attraction_is_zero_in_the_dead_zone_and_at_its_edge() {
        assert_eq!(linear_attraction(Vec2::new(0.49, 0.0), 1.5, 0.5), Vec2::ZERO);
        assert_eq!(linear_attraction(Vec2::new(0.5, 0.0), 1.5, 0.5), Vec2::ZERO);
    }

    #[test]
    fn without_zones_attraction_is_full_everywhere_but_at_the_target() {
        assert_near(linear_attraction(Vec2::new(0.001, 0.0), 0.0, 0.0), Vec2::X);
        assert_eq!(linear_attraction(Vec2::ZERO, 0.0, 0.0), Vec2::ZERO);
    }

    #[test]
    fn equal_zones_make_a_step() {
        assert_eq!(linear_attraction(Vec2::new(0.39, 0.0), 0.4, 0.4), Vec2::ZERO);
        assert_near(linear_attraction(Vec2::new(0.4, 0.0), 0.4, 0.4), Vec2::X);
    }

    #[test]
    fn two_targets_on_one_side_pull_no_harder_than_the_harder_one() {
        let both = linear_attraction_all([Vec2::new(0.9, 0.0), Vec2::new(0.8, 0.0)], 1.0, 0.0);
        assert_near(both, Vec2::new(0.9, 0.0));
        let gentle = linear_attraction_all([Vec2::new(0.3, 0.0), Vec2::new(0.0, 0.4)], 1.0, 0.0);
        assert_near(gentle, Vec2::new(0.3, 0.4));
        assert_eq!(linear_attraction_all([], 1.0, 0.0), Vec2::ZERO);
    }

    #[test]
    fn opposite_targets_cancel() {
        assert_eq!(linear_attraction_all([Vec2::X, Vec2::NEG_X], 0.5, 0.0), Vec2::ZERO);
    }

    #[test]
    fn near_attraction_grows_as_the_target_comes_nearer() {
        assert_eq!(attract_near([Vec2::new(2.0, 0.0)], 2.0, 0.5), Vec2::ZERO);
        assert_near(attract_near([Vec2::new(1.25, 0.0)], 2.0, 0.5), Vec2::new(0.5, 0.0));
        assert_near(attract_near([Vec2::new(0.0, 0.5)], 2.0, 0.5), Vec2::Y);
        assert_near(attract_near([Vec2::new(0.0, -0.1)], 2.0, 0.5), Vec2::NEG_Y);
        assert_near(attract_near([Vec2::new(0.1, 0.0), Vec2::new(0.2, 0.0)], 2.0, 0.5), Vec2::X);
    }

    proptest! {
        #[test]
        fn turning_the_target_turns_the_attraction(
            x in -3.0f32..3.0, y in -3.0f32..3.0, turn in -3.0f32..3.0, c in 0.6f32..2.0, d in 0.0f32..0.5,
        ) {
            let target = Vec2::new(x, y);
            let turned = linear_attraction(unit(turn).rotate(target), c, d);
            prop_assert!((turned - unit(turn).rotate(linear_attraction(target, c, d))).length() < 1e-4);
            prop_assert!(turned.length() <= 1.0 + 1e-6);
            let turned = attract_near([unit(turn).rotate(target)], c, d);
            prop_assert!((turned - unit(turn).rotate(attract_near([target], c, d))).length() < 1e-4);
        }
    }
}
