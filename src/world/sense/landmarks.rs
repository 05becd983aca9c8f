//! Which landmarks a camera has in view, and how good a fix they give: goal posts, beacons and lines. Pure.

use bevy::prelude::*;
use smallvec::SmallVec;

use super::camera::Blob;
use crate::geometry::{Pose, Sighting, unit, wrap_angle};
use crate::ops;
use crate::pitch::Pitch;
use crate::robot::Landmarks;

/// What a camera looks at.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// The camera, looking along its heading, in the pitch frame.
    pub from: Pose,
    /// Degrees, from edge to edge.
    pub field_of_view: f32,
    /// The ball that the frame shows, if it shows one.
    pub ball: Option<Sighting>,
    /// Robots hide lines. Posts and beacons rise above them.
    pub robots: &'a [Blob],
}

/// How much of a full fix the landmarks in view give, 0 to 1. A head that looks down at a near ball sees lines at most.
pub fn fix_share(landmarks: &Landmarks, pitch: &Pitch, view: &View) -> f32 {
    let looks_down = view.ball.is_some_and(|ball| ball.range < landmarks.looks_down);
    let high = if looks_down { 0 } else { high_landmarks(landmarks, pitch, view) };
    let of_high = match high {
        0 => 0.0,
        1 => landmarks.one,
        _ => return 1.0,
    };
    let of_lines =
        if landmarks.line > 0.0 && sees_a_line(landmarks, pitch, view) { landmarks.line } else { 0.0 };
    (of_high + of_lines).min(1.0)
}

/// The number of goal posts and beacons in view, as far as it matters.
fn high_landmarks(landmarks: &Landmarks, pitch: &Pitch, view: &View) -> usize {
    let goal = Vec2::new(pitch.length / 2.0, pitch.goal.width / 2.0);
    let posts = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].map(|(x, y)| goal * Vec2::new(x, y));
    let posts = posts.into_iter().map(|post| (post, landmarks.posts));
    let beacons = pitch.beacons.iter().map(|beacon| (*beacon, landmarks.beacons));
    let half_view = view.field_of_view.to_radians() / 2.0;
    let (forward, edge) = (view.from.forward(), ops::cos(half_view) - ROUNDING);
    let is_seen = |(at, reach): &(Vec2, f32)| {
        let offset = *at - view.from.position;
        let range = offset.length();
        // Most are out of range or behind; of the others alone the bearing is worked out.
        range <= *reach
            && offset.dot(forward) >= range * edge
            && Sighting::of(*at, view.from).bearing.abs() <= half_view
    };
    posts.chain(beacons).filter(is_seen).take(ENOUGH).count()
}

/// More landmarks than this give no better fix.
const ENOUGH: usize = 2;
/// By which cosines and lengths, m, may miss their true values.
const ROUNDING: f32 = 1e-3;

/// Directions in which lines are looked for, in shares of half the field of view.
const RAYS: [f32; 5] = [-0.8, -0.4, 0.0, 0.4, 0.8];

fn sees_a_line(landmarks: &Landmarks, pitch: &Pitch, view: &View) -> bool {
    let half_view = view.field_of_view.to_radians() / 2.0;
    let lines: SmallVec<[_; 11]> = pitch
        .lines()
        .into_iter()
        .filter(|line| is_within(landmarks.lines, *line, view.from.position))
        .collect();
    RAYS.iter().any(|ray| {
        let bearing = ray * half_view;
        let way = unit(view.from.heading + bearing) * landmarks.lines;
        let nearest = lines.iter().filter_map(|line| crossing(view.from.position, way, *line));
        let Some(share) = nearest.min_by(f32::total_cmp) else { return false };
        let range = share * landmarks.lines;
        !view
            .robots
            .iter()
            .any(|robot| robot.range < range && wrap_angle(bearing - robot.bearing).abs() < robot.half_angle)
    })
}

/// Whether a line along or across the pitch comes this near to a place, m.
fn is_within(reach: f32, (start, end): (Vec2, Vec2), place: Vec2) -> bool {
    place.clamp(start.min(end), start.max(end)).distance(place) <= reach + ROUNDING
}

/// The share of a way, 0 to 1, after which it crosses a line, if it does.
fn crossing(from: Vec2, way: Vec2, (start, end): (Vec2, Vec2)) -> Option<f32> {
    let along = end - start;
    let slope = way.perp_dot(along);
    if slope == 0.0 {
        return None;
    }
    let gap = start - from;
    let (share, place) = (gap.perp_dot(along) / slope, gap.perp_dot(way) / slope);
    ((0.0..=1.0).contains(&share) && (0.0..=1.0).contains(&place)).then_some(share)
}

#[cfg(test)]
mod tests {
    use std::f32::consts::{FRAC_PI_2, PI};

    use super::*;

    const LANDMARKS: Landmarks = Landmarks {
        posts: 5.0,
        beacons: 3.0,
        lines: 0.8,
        one: 0.5,
        line: 0.25,
        looks_down: 0.4,
        settle: 1.0,
    };

    /// The middle-size pitch, 9 m by 5 m with goals of 2 m, and two beacons.
    fn pitch() -> Pitch {
        Pitch { beacons: vec![Vec2::new(-1.0, 2.7), Vec2::new(1.0, 2.7)], ..crate::testing::pitch() }
    }

    fn share(from: Pose, ball: Option<f32>, robots: &[Blob]) -> f32 {
        let ball = ball.map(|range| Sighting { range, bearing: 0.0 });
        fix_share(&LANDMARKS, &pitch(), &View { from, field_of_view: 60.0, ball, robots })
    }

    #[test]
    fn a_whole_goal_gives_a_full_fix_and_one_post_half_of_one() {
        assert_eq!(share(Pose::new(1.0, 0.0, 0.0), None, &[]), 1.0);
        // The left post is 26.6° to the left of a robot two metres before the goal.
        assert_eq!(share(Pose::new(2.5, 0.0, 0.2), None, &[]), 0.5);
    }

    #[test]
    fn a_goal_behind_the_head_or_out_of_range_gives_nothing() {
        assert_eq!(share(Pose::new(1.0, 0.0, -FRAC_PI_2 - 0.3), None, &[]), 0.0);
        assert_eq!(share(Pose::new(-1.0, 0.0, 0.0), None, &[]), 0.0);
        assert_eq!(share(Pose::new(-1.0, 0.0, PI), None, &[]), 1.0, "the own goal is a landmark, too");
    }

    #[test]
    fn the_direction_of_the_head_decides() {
        let body = Pose::new(1.5, 0.0, FRAC_PI_2);
        let with_pan = |pan: f32| share(Pose { heading: body.heading + pan, ..body }, None, &[]);
        assert_eq!(
            [with_pan(0.0), with_pan(-FRAC_PI_2)],
            [0.5, 1.0],
            "a beacon ahead, the goal to the right"
        );
    }

    #[test]
    fn two_beacons_give_a_full_fix_and_far_ones_nothing() {
        assert_eq!(share(Pose::new(0.0, 0.2, FRAC_PI_2), None, &[]), 1.0);
        assert_eq!(share(Pose::new(1.0, 1.0, FRAC_PI_2), None, &[]), 0.5, "the other one is beside the view");
        assert_eq!(share(Pose::new(0.9, -0.6, FRAC_PI_2), None, &[]), 0.0, "both are too far");
    }

    #[test]
    fn a_head_that_looks_down_at_a_near_ball_sees_no_goal() {
        let before_the_goal = Pose::new(1.0, 0.0, 0.0);
        assert_eq!(share(before_the_goal, Some(0.5), &[]), 1.0);
        assert_eq!(share(before_the_goal, Some(0.3), &[]), 0.0);
    }

    #[test]
    fn lines_within_reach_give_a_little_unless_robots_hide_them() {
        let beside_the_half_way_line = Pose::new(-0.7, -1.0, 0.0);
        assert_eq!(share(beside_the_half_way_line, None, &[]), 0.25);
        assert_eq!(share(Pose::new(-0.9, -1.0, 0.0), None, &[]), 0.0, "too far");
        let wide = Blob { range: 0.3, bearing: 0.0, half_angle: 0.5 };
        assert_eq!(share(beside_the_half_way_line, None, &[wide]), 0.0);
        let behind = Blob { range: 0.75, ..wide };
        assert_eq!(share(beside_the_half_way_line, None, &[behind]), 0.25);
        let narrow = Blob { half_angle: 0.1, ..wide };
        assert_eq!(share(beside_the_half_way_line, None, &[narrow]), 0.25, "it looks past a robot");
    }
}
