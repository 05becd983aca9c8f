//! Where robots stand when a duel begins. Pure but for the dice.

use std::f32::consts::{PI, TAU};

use bevy::prelude::Vec2;

use crate::geometry::{Attacking, Pose, unit, wrap_angle};
use crate::rng::Dice;
use crate::world::physics::Footprint;

/// How far from the ball robots begin, m: from and to.
const DISTANCE: (f32, f32) = (0.8, 1.5);

/// Draws of places for one start before it is given up. Robots of half a metre find room at once.
const DRAWS: usize = 1000;

/// The poses of two sides around a ball in the centre, in the frame of the first side; all robots look at the ball. The robots that
/// both sides have stand opposite each other: what one side sees is what the other sees, turned by half a turn. `None` if so many robots
/// find no room.
pub(super) fn mirrored_start(
    counts: [usize; 2],
    footprints: [&Footprint; 2],
    dice: &mut Dice,
) -> Option<[Vec<Pose>; 2]> {
    (0..DRAWS).find_map(|_| {
        let poses = draw(counts, dice);
        stand_apart(&poses, footprints).then_some(poses)
    })
}

fn draw(counts: [usize; 2], dice: &mut Dice) -> [Vec<Pose>; 2] {
    let mut poses = [Vec::new(), Vec::new()];
    for i in 0..counts[0].max(counts[1]) {
        let bearing = dice.uniform() * TAU;
        let distance = DISTANCE.0 + dice.uniform() * (DISTANCE.1 - DISTANCE.0);
        let pose = Pose { position: unit(bearing) * distance, heading: wrap_angle(bearing + PI) };
        let mirrored = [pose, Attacking::West.turn_pose(pose)];
        for side in 0..2 {
            if i < counts[side] {
                poses[side].push(mirrored[side]);
            }
        }
    }
    poses
}

fn stand_apart(poses: &[Vec<Pose>; 2], footprints: [&Footprint; 2]) -> bool {
    let of_side = |side: usize| poses[side].iter().map(move |pose| (pose, footprints[side]));
    let all: Vec<_> = of_side(0).chain(of_side(1)).collect();
    all.iter().enumerate().all(|(i, (pose, footprint))| {
        all[..i].iter().all(|(other, there)| !footprint.overlaps(**pose, there, **other))
    })
}

/// The poses of the side that is home and of the side that is away, in the pitch frame, when the first side is home or away.
pub(super) fn on_pitch([first, second]: [Vec<Pose>; 2], first_is_home: bool) -> [Vec<Pose>; 2] {
    if first_is_home {
        return [first, second];
    }
    let turned = |poses: Vec<Pose>| poses.into_iter().map(|pose| Attacking::West.turn_pose(pose)).collect();
    [turned(second), turned(first)]
}

/// Where the ball begins.
pub(super) const BALL: Vec2 = Vec2::ZERO;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;
    use crate::testing::cye;

    fn start(counts: [usize; 2], seed: u64) -> [Vec<Pose>; 2] {
        let footprint = Footprint::of_robot(&cye());
        let mut dice = Dice::new(Seed(seed), "test", None);
        mirrored_start(counts, [&footprint, &footprint], &mut dice).expect("there is room")
    }

    fn is_turned(a: Pose, b: Pose) -> bool {
        (a.position + b.position).length() < 1e-5 && wrap_angle(a.heading - b.heading - PI).abs() < 1e-4
            || (a.position + b.position).length() < 1e-5
                && wrap_angle(a.heading - b.heading + PI).abs() < 1e-4
    }

    #[test]
    fn robots_that_both_sides_have_stand_opposite_each_other_and_look_at_the_ball() {
        for seed in 0..50 {
            let [first, second] = start([2, 1], seed);
            assert_eq!((first.len(), second.len()), (2, 1));
            assert!(is_turned(first[0], second[0]), "{first:?} {second:?}");
            for pose in first.iter().chain(&second) {
                let distance = pose.position.length();
                assert!((DISTANCE.0..=DISTANCE.1).contains(&distance), "{pose:?}");
                assert!(pose.to_local(BALL).normalize().x > 0.999, "{pose:?}");
            }
        }
    }

    #[test]
    fn nobody_stands_in_anybody_else() {
        let footprint = Footprint::of_robot(&cye());
        for seed in 0..50 {
            let poses = start([3, 3], seed);
            assert!(stand_apart(&poses, [&footprint, &footprint]));
        }
    }

    #[test]
    fn a_side_sees_the_same_at_home_and_away() {
        let poses = start([2, 1], 7);
        let [home, away] = on_pitch(poses.clone(), true);
        assert_eq!([home, away], poses);
        let [home, away] = on_pitch(poses.clone(), false);
        assert!(away.iter().zip(&poses[0]).all(|(away, first)| is_turned(*away, *first)));
        assert!(home.iter().zip(&poses[1]).all(|(home, second)| is_turned(*home, *second)));
    }
}
