//! What a colour-blob camera makes of the truth: field of view, range, occlusion, misses and noise. Pure but for the dice.

use crate::ops;
use crate::robot::range_deviation;
use std::f32::consts::PI;

use bevy::prelude::*;
use smallvec::SmallVec;

use crate::geometry::{Pose, Sighting, wrap_angle};
use crate::rng::Dice;
use crate::robot::Camera;

/// A thing that the camera may see or that may hide another, as seen from the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blob {
    /// m
    pub range: f32,
    /// rad, counter-clockwise from where the camera looks.
    pub bearing: f32,
    /// Half of the angle that it covers, rad.
    pub half_angle: f32,
}

impl Blob {
    /// A disc of this radius in metres, from a pose.
    pub fn of(centre: Vec2, radius: f32, from: Pose) -> Blob {
        let Sighting { range, bearing } = Sighting::of(centre, from);
        let half_angle = if range > radius { ops::asin(radius / range) } else { PI };
        Blob { range, bearing, half_angle }
    }
}

/// The share of a blob that lies in the field of view (degrees) and behind no nearer blob, from 0 to 1, in fifths.
pub fn visible_share(blob: Blob, others: impl Iterator<Item = Blob>, field_of_view: f32) -> f32 {
    const RAYS: [f32; 5] = [-0.8, -0.4, 0.0, 0.4, 0.8];
    let half_view = field_of_view.to_radians() / 2.0;
    let mut nearer = SmallVec::<[Blob; 16]>::new();
    for other in others {
        if other.range < blob.range {
            nearer.push(other);
        }
    }
    let hidden =
        |ray: f32| nearer.iter().any(|other| wrap_angle(ray - other.bearing).abs() < other.half_angle);
    let seen = RAYS.iter().filter(|offset| {
        let ray = wrap_angle(blob.bearing + *offset * blob.half_angle);
        ray.abs() <= half_view && !hidden(ray)
    });
    seen.count() as f32 / RAYS.len() as f32
}

/// The chance that a frame shows a thing in full view at this range, of at most `reach` metres.
pub fn detection(camera: &Camera, range: f32, reach: f32) -> f32 {
    let near = 0.7 * reach;
    if range > reach {
        0.0
    } else if range <= near {
        camera.detection
    } else {
        camera.detection * (1.0 - 0.7 * (range - near) / (reach - near))
    }
}

/// One look at one thing: a noisy sighting, or nothing.
pub fn look(
    camera: &Camera,
    blob: Blob,
    reach: f32,
    others: impl Iterator<Item = Blob>,
    dice: &mut Dice,
) -> Option<Sighting> {
    let chance = detection(camera, blob.range, reach);
    if chance == 0.0
        || wrap_angle(blob.bearing).abs() - blob.half_angle > camera.field_of_view.to_radians() / 2.0
    {
        return None;
    }
    if visible_share(blob, others, camera.field_of_view) < camera.visible_share.max(f32::EPSILON) {
        return None;
    }
    let (range_error, bearing_error) = (dice.normal(1.0), dice.normal(camera.bearing_noise.to_radians()));
    dice.chance(chance).then(|| Sighting {
        range: (blob.range + range_error * range_deviation(camera, blob.range)).max(0.01),
        bearing: wrap_angle(blob.bearing + bearing_error),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;

    const CAMERA: Camera = Camera {
        field_of_view: 80.0,
        frame_hz: 10.0,
        latency: 0.15,
        ball_range: 3.2,
        robot_range: 4.0,
        range_noise: 0.035,
        range_floor: 0.0,
        bearing_noise: 1.5,
        detection: 0.95,
        visible_share: 0.3,
        false_positive: 0.0,
        wrong_team: 0.0,
    };

    fn ahead(range: f32, radius: f32) -> Blob {
        Blob::of(Vec2::new(range, 0.0), radius, Pose::default())
    }

    fn looks(blob: Blob, others: &[Blob]) -> Vec<Sighting> {
        let mut dice = Dice::new(Seed(1), "test", None);
        (0..20_000)
            .filter_map(|_| look(&CAMERA, blob, CAMERA.ball_range, others.iter().copied(), &mut dice))
            .collect()
    }

    #[test]
    fn a_near_ball_is_seen_as_often_as_the_detection_says() {
        let share = looks(ahead(1.0, 0.11), &[]).len() as f32 / 20_000.0;
        assert!((share - 0.95).abs() < 0.01, "{share}");
    }

    #[test]
    fn range_noise_grows_with_the_square_of_the_range() {
        for range in [0.5, 1.0, 2.0] {
            let seen = looks(ahead(range, 0.11), &[]);
            let variance = seen.iter().map(|s| (s.range - range).powi(2)).sum::<f32>() / seen.len() as f32;
            let expected = 0.035 * range * range;
            assert!((variance.sqrt() / expected - 1.0).abs() < 0.05, "{range}: {}", variance.sqrt());
        }
    }

    #[test]
    fn nothing_is_seen_behind_the_robot_or_out_of_range() {
        let behind = Blob::of(Vec2::new(-1.0, 0.0), 0.11, Pose::default());
        assert!(looks(behind, &[]).is_empty());
        assert!(looks(ahead(3.3, 0.11), &[]).is_empty());
    }

    #[test]
    fn a_robot_in_between_hides_the_ball_and_one_behind_it_does_not() {
        let ball = ahead(2.0, 0.11);
        assert!(looks(ball, &[ahead(1.0, 0.2)]).is_empty());
        assert!(!looks(ball, &[ahead(2.5, 0.2)]).is_empty());
    }

    #[test]
    fn half_a_ball_is_recognised_and_a_fifth_is_not() {
        let ball = ahead(2.0, 0.11);
        let beside = |y: f32| Blob::of(Vec2::new(1.0, y), 0.2, Pose::default());
        let half = visible_share(ball, [beside(0.19)].into_iter(), 80.0);
        assert!((0.3..=0.7).contains(&half), "{half}");
        assert!(!looks(ball, &[beside(0.19)]).is_empty());
        let sliver = visible_share(ball, [beside(0.165)].into_iter(), 80.0);
        assert!((sliver - 0.2).abs() < 1e-6, "{sliver}");
        assert!(looks(ball, &[beside(0.165)]).is_empty());
    }
}
