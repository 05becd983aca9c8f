//! Resection, as surveyors call it: one's own place from landmarks with known places, without any idea of it before. Pure.

use bevy::math::Vec2;

use crate::geometry::{Pose, angle, wrap_angle};

/// A landmark: where it stands, where it was seen in a frame of the robot's own, m, and how far that may be wrong, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bearings {
    pub place: Vec2,
    pub seen: Vec2,
    pub deviation: f32,
}

/// Landmarks nearer to each other than this give no direction, m.
const NEAREST: f32 = 0.4;
/// A landmark farther from where it should be than this many deviations is another one.
const FAR: f32 = 3.0;

/// The pose of the robot's own frame in the field, with the landmarks that agree on it, by their indices: of all pairs that one with
/// which most agree, and best. Nothing, if no two do, or only half of all.
pub(super) fn locate(seen: &[Bearings]) -> Option<(Pose, Vec<usize>)> {
    let pairs = (0..seen.len()).flat_map(|i| (i + 1..seen.len()).map(move |j| (i, j)));
    let poses = pairs.filter_map(|(i, j)| of_two(&seen[i], &seen[j]));
    let judged = poses.map(|pose| {
        let errors = seen.iter().map(|one| one.error(pose)).enumerate();
        let fitting: Vec<(usize, f32)> = errors.filter(|(_, error)| *error <= FAR).collect();
        let misfit: f32 = fitting.iter().map(|(_, error)| error * error).sum();
        (pose, misfit, fitting.into_iter().map(|(index, _)| index).collect::<Vec<_>>())
    });
    let best = judged.max_by(|a, b| (a.2.len().cmp(&b.2.len())).then(b.1.total_cmp(&a.1)));
    best.filter(|(_, _, fitting)| fitting.len() >= 2 && 2 * fitting.len() > seen.len())
        .map(|(pose, _, fitting)| (pose, fitting))
}

fn of_two(a: &Bearings, b: &Bearings) -> Option<Pose> {
    let (places, seen) = (b.place - a.place, b.seen - a.seen);
    let tolerance = FAR * (a.deviation + b.deviation);
    let is_clear = places.length() >= NEAREST
        && seen.length() >= NEAREST / 2.0
        && (places.length() - seen.length()).abs() <= tolerance;
    let heading = wrap_angle(angle(places) - angle(seen));
    let turned = Pose { position: Vec2::ZERO, heading };
    let middle = |one: Vec2, other: Vec2| (one + other) / 2.0;
    let position = middle(a.place, b.place) - turned.to_field(middle(a.seen, b.seen));
    is_clear.then_some(Pose { position, heading })
}

impl Bearings {
    /// How far the landmark is from where it should be, in deviations.
    fn error(&self, pose: Pose) -> f32 {
        pose.to_field(self.seen).distance(self.place) / self.deviation
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Sighting;

    const PLACES: [Vec2; 4] =
        [Vec2::new(4.5, 1.0), Vec2::new(4.5, -1.0), Vec2::new(-4.5, 1.0), Vec2::new(0.0, 2.7)];

    fn seen_from(pose: Pose, places: &[Vec2]) -> Vec<Bearings> {
        let one = |place: &Vec2| Bearings {
            place: *place,
            seen: Sighting::of(*place, pose).placed(Pose::default()),
            deviation: 0.1,
        };
        places.iter().map(one).collect()
    }

    fn assert_near(got: Pose, want: Pose) {
        assert!(got.position.distance(want.position) < 1e-3, "{got:?} {want:?}");
        assert!(wrap_angle(got.heading - want.heading).abs() < 1e-3, "{got:?} {want:?}");
    }

    #[test]
    fn two_landmarks_give_the_place_wherever_it_is() {
        for pose in [Pose::new(1.0, -0.5, 0.3), Pose::new(-3.0, 2.0, -2.9), Pose::default()] {
            let (got, fitting) = locate(&seen_from(pose, &PLACES[..2])).unwrap();
            assert_near(got, pose);
            assert_eq!(fitting, [0, 1]);
        }
    }

    #[test]
    fn one_landmark_or_two_at_a_wrong_distance_of_each_other_give_none() {
        let mut seen = seen_from(Pose::new(1.0, -0.5, 0.3), &PLACES[..2]);
        assert!(locate(&seen[..1]).is_none() && locate(&[]).is_none());
        seen[0].seen.x += 1.0;
        seen[0].seen.y += 1.0;
        assert!(locate(&seen).is_none());
    }

    #[test]
    fn a_landmark_that_is_taken_for_another_is_outvoted() {
        let pose = Pose::new(0.5, 0.5, 1.0);
        for wrong in 0..4 {
            let mut seen = seen_from(pose, &PLACES);
            seen[wrong].place = Vec2::new(-4.5, -1.0);
            let (got, fitting) = locate(&seen).unwrap();
            assert_near(got, pose);
            assert!(fitting.len() == 3 && !fitting.contains(&wrong), "{fitting:?}");
        }
    }
}
