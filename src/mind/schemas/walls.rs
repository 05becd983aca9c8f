//! Getting a ball away from a wall, where a robot has no room behind it.
//!
//! It then comes to the ball as the walls let it, and turns with the ball before its scoop, which sweeps the ball out.
//! Directions are unit vectors on the team frame's axes.

use bevy::prelude::*;

use crate::geometry::{angle, unit};

/// Directions that are tried, all around.
const DIRECTIONS: u32 = 72;
/// A direction that is no farther off the shot than this has a cosine above it: 60°.
const NEAR_SHOT: f32 = 0.5;
/// A course so far to the side that a robot turns on the spot, rad.
const TURN: f32 = 1.75;

/// The direction in which to come to the ball: `shot`, if a robot `standoff` metres behind it is where it `fits`; otherwise
/// the fitting direction that is nearest to the shot, as long as the ball goes more to the goal than to a side, or else the
/// middle of all that fit, on which the walls are farthest. `ball` is a place, m; `shot` itself if nothing fits.
pub fn way_in(ball: Vec2, shot: Vec2, standoff: f32, fits: impl Fn(Vec2) -> bool) -> Vec2 {
    let has_room = |direction: &Vec2| fits(ball - *direction * standoff);
    if has_room(&shot) {
        return shot;
    }
    let straight = angle(shot);
    let turned = |step: u32| unit(straight + step as f32 * std::f32::consts::TAU / DIRECTIONS as f32);
    let open = || (1..DIRECTIONS).map(turned).filter(has_room);
    let nearest = open().max_by(|a, b| a.dot(shot).total_cmp(&b.dot(shot)));
    match nearest {
        Some(direction) if direction.dot(shot) >= NEAR_SHOT => direction,
        _ => open().sum::<Vec2>().try_normalize().unwrap_or(shot),
    }
}

/// The course of a robot that sweeps the ball before it towards `shot` and away from `threat`, the direction of what has to
/// be kept from it: far enough to that side to turn on the spot.
pub fn sweep(ball: Vec2, shot: Vec2, threat: Vec2, heading: f32) -> Vec2 {
    unit(heading + TURN.copysign(ball.perp_dot(shot - threat)))
}

#[cfg(test)]
mod tests {
    use std::f32::consts::FRAC_PI_2;

    use super::*;

    const STANDOFF: f32 = 0.5;
    const GOAL: Vec2 = Vec2::new(4.0, 0.0);

    /// Inside walls at x = ±4 and y = ±2.
    fn fits(place: Vec2) -> bool {
        place.abs().cmple(Vec2::new(3.75, 1.75)).all()
    }

    fn way_to(x: f32, y: f32) -> Vec2 {
        let ball = Vec2::new(x, y);
        way_in(ball, (GOAL - ball).normalize(), STANDOFF, fits)
    }

    #[test]
    fn where_there_is_room_the_way_in_is_the_shot() {
        assert_eq!(way_to(0.0, 0.0), Vec2::X);
        assert_eq!(way_to(0.0, 1.4), Vec2::new(4.0, -1.4).normalize());
    }

    #[test]
    fn at_a_side_wall_it_leads_along_the_wall_towards_the_goal() {
        for side in [1.0, -1.0] {
            let way = way_to(0.0, side * 1.9);
            assert!(way.x > 0.9 && way.y * side > 0.0, "{way}");
        }
    }

    #[test]
    fn beside_the_own_goal_it_leads_straight_to_the_wall_and_in_a_corner_half_way_between_its_walls() {
        for side in [1.0, -1.0] {
            assert!(way_to(-3.9, side * 1.2).x < -0.95);
            for end in [1.0, -1.0] {
                let corner = Vec2::new(end, side).normalize();
                assert!(way_to(end * 3.9, side * 1.9).dot(corner) > 0.95, "{corner}");
            }
        }
    }

    #[test]
    fn where_nothing_fits_it_is_the_shot() {
        assert_eq!(way_in(Vec2::ZERO, Vec2::X, STANDOFF, |_| false), Vec2::X);
    }

    #[test]
    fn a_sweep_turns_to_the_side_of_the_shot_and_away_from_the_own_goal() {
        let ahead = Vec2::new(0.25, 0.0);
        assert!(sweep(ahead, Vec2::Y, Vec2::NEG_Y, 0.0).y > 0.9);
        assert!(sweep(ahead, Vec2::NEG_Y, Vec2::Y, 0.0).y < -0.9);
        assert!(sweep(Vec2::new(0.0, 0.25), Vec2::X, Vec2::NEG_X, FRAC_PI_2).x > 0.9);
        // Nose to the wall beside the own goal, north of it: the ball goes on to the north.
        let (shot, threat) = (Vec2::new(0.99, -0.14), Vec2::new(-0.08, -0.99));
        assert!(sweep(Vec2::new(-0.25, 0.0), shot, threat, std::f32::consts::PI).y > 0.9);
    }
}
