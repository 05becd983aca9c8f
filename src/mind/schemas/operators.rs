//! Perceptual operators: what lies between the sensed points and the motor schemas. They choose, shift and
//! merge points and work out new ones; none keeps a state (those are in `memory`) and none allocates.
//!
//! Points are in metres from the robot, on the team frame's axes. What may not exist is an `Option`, never a
//! zero vector.
//!
//! Source: Clay's Closest, Average, Subtract, Filter, Merge and Intercept nodes, and SchemaDemo's sweet spot.

use bevy::prelude::*;

/// The point nearest to the robot, the first of them in a tie (Clay's Closest).
pub fn closest(points: impl IntoIterator<Item = Vec2>) -> Option<Vec2> {
    points.into_iter().reduce(
        |best, point| {
            if point.length_squared() < best.length_squared() { point } else { best }
        },
    )
}

/// The mean of the points (Clay's Average of a list).
pub fn average(points: impl IntoIterator<Item = Vec2>) -> Option<Vec2> {
    let (sum, count) =
        points.into_iter().fold((Vec2::ZERO, 0.0_f32), |(sum, count), point| (sum + point, count + 1.0));
    (count > 0.0).then(|| sum / count)
}

/// The point half-way between two (Clay's Average of two).
pub fn midpoint(a: Vec2, b: Vec2) -> Vec2 {
    (a + b) * 0.5
}

/// a − b: where a is, as seen from b (Clay's Subtract).
pub fn difference(a: Vec2, b: Vec2) -> Vec2 {
    a - b
}

/// The points at most `radius` metres from the robot (Clay's FilterClose).
pub fn within(points: impl IntoIterator<Item = Vec2>, radius: f32) -> impl Iterator<Item = Vec2> {
    points.into_iter().filter(move |point| point.length() <= radius)
}

/// The points at most `radius` metres from the robot, or if there are none the nearest one (Clay's
/// FilterClose1).
pub fn within_or_closest(
    points: impl IntoIterator<Item = Vec2, IntoIter: Clone>,
    radius: f32,
) -> impl Iterator<Item = Vec2> {
    let points = points.into_iter();
    let fallback = closest(points.clone()).filter(|nearest| nearest.length() > radius);
    within(points, radius).chain(fallback)
}

/// The points more than `radius` metres from the point `from` (Clay's FilterOutClose).
pub fn farther_than(
    points: impl IntoIterator<Item = Vec2>,
    radius: f32,
    from: Vec2,
) -> impl Iterator<Item = Vec2> {
    points.into_iter().filter(move |point| point.distance(from) > radius)
}

/// One list after the other (Clay's Merge).
pub fn merge(
    first: impl IntoIterator<Item = Vec2>,
    second: impl IntoIterator<Item = Vec2>,
) -> impl Iterator<Item = Vec2> {
    first.into_iter().chain(second)
}

/// All points moved by one vector in metres (Clay's Add of a vector to a list).
pub fn shifted(points: impl IntoIterator<Item = Vec2>, by: Vec2) -> impl Iterator<Item = Vec2> {
    points.into_iter().map(move |point| point + by)
}

/// The point `offset` metres behind the ball as seen from `away_from`: where to stand to play the ball there
/// (SchemaDemo's sweet spot). The ball itself if it lies at that very point.
pub fn sweet_spot(ball: Vec2, away_from: Vec2, offset: f32) -> Vec2 {
    ball + (ball - away_from).normalize_or_zero() * offset
}

/// Where a robot of `max_speed` meets a target of constant `velocity` (m/s) soonest: A + V·τ for the smallest
/// τ > 0 with |A + V·τ| = `max_speed`·τ. The target's present place if it cannot be caught. Clay's Intercept,
/// whose own root is wrong: this solves (|V|² − s²)τ² + 2(A·V)τ + |A|² = 0.
pub fn intercept(target: Vec2, velocity: Vec2, max_speed: f32) -> Vec2 {
    let a = velocity.length_squared() - max_speed * max_speed;
    let half_b = target.dot(velocity);
    let c = target.length_squared();
    let discriminant = half_b * half_b - a * c;
    if discriminant < 0.0 || max_speed <= 0.0 {
        return target;
    }
    // Of the two forms of the root take the one that does not subtract nearly equal numbers; both hold for a
    // = 0.
    let root = discriminant.sqrt();
    let time = if half_b > 0.0 { (half_b + root) / -a } else { c / (root - half_b) };
    if time > 0.0 && time.is_finite() { target + velocity * time } else { target }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::unit;

    const POINTS: [Vec2; 3] = [Vec2::new(3.0, 0.0), Vec2::new(0.0, 1.0), Vec2::new(-1.0, 0.0)];

    #[test]
    fn closest_is_the_nearest_and_the_first_in_a_tie() {
        assert_eq!(closest(POINTS), Some(Vec2::Y));
        assert_eq!(closest([POINTS[2], POINTS[1]]), Some(Vec2::NEG_X));
        assert_eq!(closest([]), None);
    }

    #[test]
    fn average_is_the_mean_and_nothing_has_none() {
        assert_eq!(
            average([Vec2::new(2.0, 0.0), Vec2::new(1.0, 3.0), Vec2::ZERO]),
            Some(Vec2::new(1.0, 1.0))
        );
        assert_eq!(average([]), None);
    }

    #[test]
    fn midpoint_and_difference_of_two_points() {
        assert_eq!(midpoint(Vec2::new(1.0, 4.0), Vec2::new(3.0, -2.0)), Vec2::new(2.0, 1.0));
        assert_eq!(difference(Vec2::new(1.0, 4.0), Vec2::new(3.0, -2.0)), Vec2::new(-2.0, 6.0));
    }

    #[test]
    fn within_keeps_the_edge_and_the_order() {
        assert!(within(POINTS, 1.0).eq([Vec2::Y, Vec2::NEG_X]));
        assert_eq!(within(POINTS, 0.99).count(), 0);
    }

    #[test]
    fn within_or_closest_falls_back_to_one_point_only_when_empty() {
        assert!(within_or_closest(POINTS, 0.5).eq([Vec2::Y]));
        assert!(within_or_closest(POINTS, 1.0).eq([Vec2::Y, Vec2::NEG_X]));
        assert_eq!(within_or_closest([], 1.0).count(), 0);
    }

    #[test]
    fn farther_than_drops_what_is_near_the_given_point_and_its_edge() {
        assert!(farther_than(POINTS, 1.0, Vec2::new(0.0, 2.0)).eq([POINTS[0], POINTS[2]]));
        assert!(farther_than(POINTS, 2.99, Vec2::ZERO).eq([POINTS[0]]));
    }

    #[test]
    fn merge_keeps_both_lists_in_order_and_shifted_moves_all() {
        assert!(merge([Vec2::X], [Vec2::Y, Vec2::X]).eq([Vec2::X, Vec2::Y, Vec2::X]));
        assert!(
            shifted([Vec2::X, Vec2::ZERO], Vec2::new(1.0, -1.0))
                .eq([Vec2::new(2.0, -1.0), Vec2::new(1.0, -1.0)])
        );
    }

    #[test]
    fn the_sweet_spot_is_behind_the_ball() {
        let spot = sweet_spot(Vec2::new(1.0, 1.0), Vec2::new(4.0, 1.0), 0.3);
        assert!((spot - Vec2::new(0.7, 1.0)).length() < 1e-6, "{spot}");
        assert_eq!(sweet_spot(Vec2::X, Vec2::X, 0.3), Vec2::X);
    }

    #[test]
    fn a_still_target_is_met_where_it_is() {
        assert_eq!(intercept(Vec2::new(2.0, 1.0), Vec2::ZERO, 0.6), Vec2::new(2.0, 1.0));
        assert_eq!(intercept(Vec2::ZERO, Vec2::new(0.3, 0.0), 0.6), Vec2::ZERO);
    }

    #[test]
    fn a_crossing_target_is_met_ahead_of_it() {
        // 3-4-5: after 1 s the target is at (0.4, 0.3), which a robot of 0.5 m/s reaches in that second.
        let meeting = intercept(Vec2::new(0.4, 0.0), Vec2::new(0.0, 0.3), 0.5);
        assert!((meeting - Vec2::new(0.4, 0.3)).length() < 1e-5, "{meeting}");
    }

    #[test]
    fn of_two_meetings_with_a_faster_target_the_sooner_counts() {
        // On the x axis at 2 m/s towards a robot of 1 m/s: 3 − 2τ = ±τ, so τ = 1 at x = 1, later τ = 3 at x =
        // −3.
        let meeting = intercept(Vec2::new(3.0, 0.0), Vec2::new(-2.0, 0.0), 1.0);
        assert!((meeting - Vec2::new(1.0, 0.0)).length() < 1e-5, "{meeting}");
    }

    #[test]
    fn an_equally_fast_target_is_met_only_if_it_comes_nearer() {
        let meeting = intercept(Vec2::new(2.0, 0.0), Vec2::new(-0.6, 0.0), 0.6);
        assert!((meeting - Vec2::new(1.0, 0.0)).length() < 1e-5, "{meeting}");
        assert_eq!(intercept(Vec2::new(2.0, 0.0), Vec2::new(0.6, 0.0), 0.6), Vec2::new(2.0, 0.0));
    }

    #[test]
    fn a_target_that_escapes_is_taken_where_it_is() {
        assert_eq!(intercept(Vec2::new(2.0, 0.0), Vec2::new(1.0, 0.2), 0.6), Vec2::new(2.0, 0.0));
        assert_eq!(intercept(Vec2::new(2.0, 0.0), Vec2::new(0.0, 3.0), 0.6), Vec2::new(2.0, 0.0));
        assert_eq!(intercept(Vec2::new(2.0, 0.0), Vec2::new(-0.3, 0.0), 0.0), Vec2::new(2.0, 0.0));
    }

    proptest! {
        #[test]
        fn a_slower_target_is_met_by_both_at_the_same_time(
            x in 0.2f32..4.0, heading in -3.0f32..3.0, speed in 0.05f32..0.5, turn in -3.0f32..3.0,
        ) {
            let (target, velocity) = (unit(turn) * x, unit(heading) * speed);
            let meeting = intercept(target, velocity, 0.6);
            let (ours, its) = (meeting.length() / 0.6, (meeting - target).length() / speed);
            prop_assert!((ours - its).abs() < 1e-2 * (1.0 + ours), "{ours} s and {its} s");
            prop_assert!((meeting - target).dot(velocity) >= 0.0);
        }

        #[test]
        fn turning_the_scene_turns_the_meeting(
            x in 0.2f32..4.0, vx in -0.4f32..0.4, vy in -0.4f32..0.4, turn in -3.0f32..3.0,
        ) {
            let (target, velocity) = (Vec2::new(x, 0.0), Vec2::new(vx, vy));
            let expected = unit(turn).rotate(intercept(target, velocity, 0.7));
            let got = intercept(unit(turn).rotate(target), unit(turn).rotate(velocity), 0.7);
            prop_assert!((got - expected).length() < 1e-2, "{got} {expected}");
        }
    }
}
