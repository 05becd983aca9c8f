//! Random moments of a match, as one robot may see them. Pure but for the dice.

use std::f32::consts::{PI, TAU};

use bevy::prelude::Vec2;

use crate::geometry::{Pose, Sighting, unit, wrap_angle};
use crate::rng::Dice;
use crate::world::sense::sway::Stride;

/// Where everything is.
#[derive(Clone, Debug)]
pub(super) struct RandomMoment {
    /// The robot whose camera it is. It heads where the camera looks.
    pub own: Pose,
    /// How far its body heads to the right of where the camera looks, rad.
    pub head: f32,
    /// How it walks.
    pub stride: Stride,
    /// The other robots.
    pub others: Vec<Pose>,
    pub ball: Vec2,
    /// How fast the camera turns, rad/s.
    pub turn_rate: f32,
}

/// Half of the pitch, what the camera sees, and who plays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// m
    pub half: Vec2,
    /// From edge to edge, rad.
    pub field_of_view: f32,
    /// How far balls are placed, m.
    pub farthest: f32,
    /// Other robots.
    pub others: usize,
    /// Around each robot, m.
    pub room: f32,
    /// How far heads turn to either side, rad.
    pub pan: f32,
}

/// Nearest ball, m: it touches a robot.
const NEAREST: f32 = 0.2;
/// The share of moments in which the ball is somewhere before the camera.
const BEFORE: f32 = 0.75;
/// The share of the other robots that stand somewhere before the camera.
const CROWD: f32 = 0.5;
/// How fast a camera turns, rad/s: a standard deviation. ASSUMPTION: a robot that walks, and a head that follows the ball.
const TURNS: f32 = 0.3;
/// Draws for one place before it is left out.
const DRAWS: usize = 200;

impl RandomMoment {
    /// Draws a moment: the robot anywhere, at any part of a stride and of any speed up to its full one, the ball mostly before it, at any
    /// distance for which the pitch has room, and others all over the pitch.
    pub fn draw(bounds: &Bounds, dice: &mut Dice) -> RandomMoment {
        let own = Pose { position: anywhere(bounds, dice), heading: (dice.uniform() - 0.5) * TAU };
        let before = dice.chance(BEFORE);
        let is_on_pitch = |place: &Vec2| place.abs().cmple(bounds.half).all();
        let ball = (0..DRAWS)
            .map(|_| if before { ahead(bounds, own, dice) } else { anywhere(bounds, dice) })
            .find(is_on_pitch)
            .unwrap_or(own.position - unit(own.heading) * NEAREST);
        let mut others: Vec<Pose> = Vec::with_capacity(bounds.others);
        for _ in 0..bounds.others {
            let crowds = dice.chance(CROWD);
            let place = (0..DRAWS)
                .map(|_| if crowds { ahead(bounds, own, dice) } else { anywhere(bounds, dice) })
                .filter(is_on_pitch)
                .find(|place| {
                    let has_room = |other: &Pose| other.position.distance(*place) > 2.0 * bounds.room;
                    place.distance(ball) > bounds.room && has_room(&own) && others.iter().all(has_room)
                });
            let heading = (dice.uniform() - 0.5) * TAU;
            others.extend(place.map(|position| Pose { position, heading }));
        }
        let head = (2.0 * dice.uniform() - 1.0) * bounds.pan;
        let stride = Stride { phase: dice.uniform(), effort: dice.uniform() };
        RandomMoment { own, head, stride, others, ball, turn_rate: dice.normal(TURNS) }
    }
}

fn anywhere(bounds: &Bounds, dice: &mut Dice) -> Vec2 {
    Vec2::new(dice.uniform() - 0.5, dice.uniform() - 0.5) * 2.0 * bounds.half
}

/// A place in the field of view or a little beside it, at any distance as likely.
fn ahead(bounds: &Bounds, own: Pose, dice: &mut Dice) -> Vec2 {
    let range = NEAREST + (bounds.farthest - NEAREST) * dice.uniform();
    let bearing = wrap_angle((dice.uniform() - 0.5) * (1.2 * bounds.field_of_view).min(2.0 * PI));
    Sighting { range, bearing }.placed(own)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;

    const BOUNDS: Bounds = Bounds {
        half: Vec2::new(2.25, 1.5),
        field_of_view: 1.0,
        farthest: 3.5,
        others: 7,
        room: 0.2,
        pan: 1.5,
    };

    #[test]
    fn everything_is_on_the_pitch_and_robots_have_room() {
        let mut dice = Dice::new(Seed(1), "test", None);
        for _ in 0..500 {
            let moment = RandomMoment::draw(&BOUNDS, &mut dice);
            let places = moment.others.iter().map(|pose| pose.position).chain([moment.own.position]);
            let places: Vec<Vec2> = places.collect();
            assert!(places.iter().all(|place| place.abs().cmple(BOUNDS.half).all()));
            for (index, place) in places.iter().enumerate() {
                assert!(places[..index].iter().all(|other| other.distance(*place) > 0.39), "{moment:?}");
            }
        }
    }

    #[test]
    fn balls_are_before_the_camera_at_near_and_far_ranges() {
        let mut dice = Dice::new(Seed(2), "test", None);
        let mut ranges = [0; 4];
        for _ in 0..2000 {
            let moment = RandomMoment::draw(&BOUNDS, &mut dice);
            let seen = Sighting::of(moment.ball, moment.own);
            if seen.bearing.abs() < BOUNDS.field_of_view / 2.0 {
                ranges[(seen.range as usize).min(3)] += 1;
            }
        }
        assert!(ranges.iter().all(|count| *count > 20), "{ranges:?}");
    }
}
