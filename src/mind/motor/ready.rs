//! What a robot does in the state ready: it walks to its place for the kick-off, round robots that stand in its way.

use bevy::prelude::*;

use crate::geometry::{Pose, angle, wrap_angle};
use crate::mind::schemas::{attraction, avoidance};
use crate::mind::world_model::WorldModel;
use crate::robot::SteeringIntent;

/// It slows down within the first of these distances of its place, and stands within the second, m.
const PLACE: (f32, f32) = (0.4, 0.15);
/// Others are avoided within the first of these distances, most strongly within the second, m.
const ROOM: (f32, f32) = (0.5, 0.25);
/// A heading that is wrong by less is right, rad.
const TURNED: f32 = 0.1;
/// Share of the top speed below which legs do not walk.
const CRAWL: f32 = 0.15;

/// Both in the team frame; the odometry's heading is the robot's own in the frame of the intent.
pub(super) fn walk_to_place(model: &WorldModel, place: Pose, odometry_heading: f32) -> SteeringIntent {
    let own = model.pose.position;
    let turned = |heading: f32| odometry_heading + wrap_angle(heading - model.pose.heading);
    let way = attraction::linear_attraction(place.position - own, PLACE.0, PLACE.1);
    if way == Vec2::ZERO {
        let off = wrap_angle(place.heading - model.pose.heading).abs();
        let heading = turned(place.heading);
        return match off < TURNED {
            true => SteeringIntent::Stop,
            false => SteeringIntent::Steer { heading, facing: heading, speed: 0.0 },
        };
    }
    let others = model.robots.iter().map(|robot| robot.position - own);
    let way = way + avoidance::avoid_all(others, ROOM.0, ROOM.1);
    let facing = if own.distance(place.position) < PLACE.0 { place.heading } else { angle(way) };
    let speed = way.length().clamp(CRAWL, 1.0);
    SteeringIntent::Steer { heading: turned(angle(way)), facing: turned(facing), speed }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::FRAC_PI_2;

    use super::*;

    const PLACE: Pose = Pose::new(-1.0, 0.5, 0.0);

    fn from(x: f32, y: f32, heading: f32) -> SteeringIntent {
        walk_to_place(&WorldModel::told(Pose::new(x, y, heading)), PLACE, 0.0)
    }

    #[test]
    fn far_from_its_place_a_robot_walks_there_at_full_speed() {
        let SteeringIntent::Steer { heading, speed, .. } = from(-3.0, 0.5, FRAC_PI_2) else {
            panic!("it walks")
        };
        assert!((heading + FRAC_PI_2).abs() < 1e-5 && speed == 1.0, "{heading} {speed}");
    }

    #[test]
    fn at_its_place_it_turns_and_then_stands() {
        let turns = from(-1.0, 0.5, 1.0);
        assert!(matches!(turns, SteeringIntent::Steer { speed: 0.0, .. }), "{turns:?}");
        assert_eq!(from(-1.1, 0.5, 0.05), SteeringIntent::Stop);
    }
}
