//! From a schema of a strategy, with its percepts, to the pure function that works it out.

use bevy::prelude::*;

use crate::mind::perception::{Memory, Perception};
use crate::mind::schemas::docking::{DockLatch, Docking, dock_behind, misalignment};
use crate::mind::schemas::dribbling::dribble;
use crate::mind::schemas::operators::shifted;
use crate::mind::schemas::{attraction, avoidance, swirl, walls};
use crate::rng::Dice;
use crate::strategy::language::{Points, Schema};

/// The vector of a schema: its angle is where to go, its length how fast, 0 to 1 and more where it is urgent. `None` while
/// something that it needs is unknown.
pub fn evaluate(schema: &Schema, senses: &Perception, memory: &mut Memory, dice: &mut Dice) -> Option<Vec2> {
    let own = senses.model.pose.position;
    let relative = |points: &Points, memory: &mut Memory| shifted(senses.points(points, memory), -own);
    Some(match schema {
        Schema::GoTo { target, controlled_zone, dead_zone } => {
            attraction::linear_attraction(senses.relative(target, memory)?, *controlled_zone, *dead_zone)
        }
        Schema::GoToAll { targets, controlled_zone, dead_zone } => {
            attraction::linear_attraction_all(relative(targets, memory), *controlled_zone, *dead_zone)
        }
        Schema::AttractNear { to, sphere, safety } => {
            attraction::attract_near(relative(to, memory), *sphere, *safety)
        }
        Schema::Avoid { of, sphere, safety } => avoidance::avoid_all(relative(of, memory), *sphere, *safety),
        Schema::Swirl { around, toward, sphere, safety } => {
            let toward = senses.relative(toward, memory)?;
            swirl::swirl_all(relative(around, memory), toward, *sphere, *safety)
        }
        Schema::SwirlLeft { around, sphere, safety } => {
            swirl::swirl_left(relative(around, memory), *sphere, *safety)
        }
        Schema::GeoField { around, toward, sphere, safety } => {
            let toward = senses.relative(toward, memory)?;
            swirl::geo_field(relative(around, memory), toward, *sphere, *safety)
        }
        Schema::Noise { period, slot } => memory.noise(*slot).sample(senses.now, *period, dice),
        Schema::DockBehind { ball, toward, standoff, enter_cone, leave_cone, slot } => {
            let docking = Docking {
                enter_cone: enter_cone.to_radians(),
                leave_cone: leave_cone.to_radians(),
                standoff: *standoff,
                ..Docking::default()
            };
            let ball = senses.relative(ball, memory)?;
            let goal = senses.relative(toward, memory)?;
            dock(ball, goal, &docking, senses, memory.dock_latch(*slot))
        }
        Schema::Dribble { ball, toward, tight } => {
            let ball = senses.relative(ball, memory)?;
            let goal = senses.relative(toward, memory)?;
            dribble(ball, goal, senses.model.pose.heading, tight.to_radians())
        }
        Schema::Constant(vector) => *vector,
    })
}

/// A robot's centre stays at least this far from the walls, m: half the width of a body and a little.
const CLEARANCE: f32 = 0.25;
/// A ball is before the robot's body up to this gap and this far off the middle, m.
const BEFORE: (f32, f32) = (0.1, 0.055);

/// Docks behind the ball as seen from the goal; where a wall leaves no room there, as there is room, and sweeps the ball out.
fn dock(ball: Vec2, goal: Vec2, docking: &Docking, senses: &Perception, latch: &mut DockLatch) -> Vec2 {
    let pose = senses.model.pose;
    let place = on_pitch(pose.position + ball, senses);
    let shot = (goal - ball).normalize_or_zero();
    let room = senses.pitch.margin() - CLEARANCE;
    let way_in = walls::way_in(place, shot, docking.standoff, |at| senses.pitch.holds(at, room));
    if way_in == shot {
        return dock_behind(ball, goal, docking, latch);
    }
    let threat = (-senses.pitch.goal_centre() - place).normalize_or_zero();
    let ahead = pose.to_local(pose.position + ball);
    let gap = ahead.x - senses.front - senses.ball_radius;
    let before = ahead.x > 0.0 && gap <= BEFORE.0 && ahead.y.abs() <= BEFORE.1;
    if before && misalignment(ball, goal) > docking.enter_cone {
        return walls::sweep(ball, shot, threat, pose.heading);
    }
    dock_behind(ball, ball + way_in * (goal - ball).length(), docking, latch)
}

/// Where a ball can be that is believed to be at a place, since walls stand where they stand.
fn on_pitch(place: Vec2, senses: &Perception) -> Vec2 {
    let pitch = senses.pitch;
    let mut half = pitch.half_size() + pitch.margin() - senses.ball_radius;
    if place.y.abs() < pitch.goal.width / 2.0 {
        half.x += pitch.goal.depth;
    }
    place.clamp(-half, half)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mind::perception::fixture::Situation;

    /// Where a robot docks to that looks in a direction, degrees, with the ball at a place.
    fn docked(robot: (f32, f32, f32), ball: Vec2) -> Vec2 {
        let situation = Situation::at(robot.0, robot.1, robot.2).ball(ball.x, ball.y);
        let senses = situation.senses();
        let goal = senses.pitch.goal_centre() - senses.model.pose.position;
        let docking = Docking { standoff: 0.55, ..Docking::default() };
        let ball = ball - senses.model.pose.position;
        dock(ball, goal, &docking, &senses, &mut DockLatch::default())
    }

    #[test]
    fn a_ball_at_the_side_wall_is_pushed_along_it() {
        // In line with the wall and half a metre behind the ball, where there is no room in line with the goal.
        let course = docked((-0.5, 2.2, 0.0), Vec2::new(0.0, 2.39));
        assert!(course.x > 0.8, "{course}");
    }

    #[test]
    fn a_ball_in_a_corner_is_swept_out_by_who_has_it_before_its_scoop() {
        // Nose to the corner: the way out is to the left in the south, to the right in the north.
        for side in [1.0, -1.0] {
            let robot = Vec2::new(-4.21, side * 2.21);
            let course = docked((robot.x, robot.y, side * 135.0), Vec2::new(-4.39, side * 2.39));
            assert!(course.x > 0.0 && course.y * side > 0.0, "{course}");
        }
    }

    #[test]
    fn a_ball_beside_the_own_goal_is_taken_from_the_front_and_swept_away_from_it() {
        let course = docked((-3.6, 1.3, 180.0), Vec2::new(-4.39, 1.3));
        assert!(course.x < -0.9, "{course}");
        let course = docked((-4.13, 1.3, 180.0), Vec2::new(-4.39, 1.3));
        assert!(course.y > 0.9, "{course}");
    }
}
