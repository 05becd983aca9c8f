//! What the robot can see and what it saw: the camera's field of view, and the sightings of the newest frame.

use bevy::prelude::*;

use super::pens::Pens;
use crate::app::inspector::outlines;
use crate::app::inspector::subject::SelectedRobot;
use crate::app::view::colours;
use crate::geometry::{Pose, unit};
use crate::robot::Eyes;

/// Solid to the farthest ball, dashed on to the farthest robot.
pub(super) fn draw_field_of_view(pens: &mut Pens, eyes: &Eyes, from: Pose, pixel: f32) {
    let Some(camera) = eyes.camera() else { return };
    let opening = camera.field_of_view.to_radians();
    let tint = colours::SENSED.with_alpha(0.4);
    let ball = outlines::wedge(from.position, from.heading, opening, camera.ball_range);
    pens.fine.linestrip_2d(ball, tint);
    let (right, left) = (from.heading - opening / 2.0, from.heading + opening / 2.0);
    let dash = 7.0 * pixel;
    for (a, b) in outlines::dashed_arc(from.position, camera.robot_range, (right, left), dash) {
        pens.fine.line_2d(a, b, tint);
    }
    for edge in [right, left] {
        let at = |range: f32| from.position + range * unit(edge);
        for (a, b) in outlines::dashed_line(at(camera.ball_range), at(camera.robot_range), dash) {
            pens.fine.line_2d(a, b, tint);
        }
    }
}

/// White dots where the things of the newest frame were, if the robot was where it believes to be now, or where the frame
/// told it to be.
pub(super) fn draw_frame(pens: &mut Pens, robot: &SelectedRobot, pixel: f32) {
    let Some(frame) = &robot.of.percepts.frame else { return };
    let from = frame.fix.map_or(robot.of.model.pose, |fix| fix.pose);
    let robots = frame.robots.iter().map(|(_, sighting)| (*sighting, 4.0));
    for (sighting, reach) in frame.ball.map(|ball| (ball, 4.0)).into_iter().chain(robots) {
        let at = robot.ends.turn(sighting.placed(from));
        for radius in outlines::rings(reach, 2.5) {
            pens.strong.circle_2d(at, radius * pixel, colours::SENSED).resolution(16);
        }
    }
}
