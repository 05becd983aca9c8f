//! What the robot believes, dashed, each with a thin line to what is true of it.

use bevy::prelude::*;

use super::pens::Pens;
use crate::app::inspector::matching::pair;
use crate::app::inspector::outlines;
use crate::app::inspector::subject::SelectedRobot;
use crate::app::view::colours;
use crate::geometry::unit;

/// Dashes in pixels.
const DASH: f32 = 5.0;
/// Beliefs nearer to the truth than this need no line to it, m.
const NEAR: f32 = 0.03;

pub(super) fn draw(pens: &mut Pens, robot: &SelectedRobot, pixel: f32) {
    let model = robot.of.model;
    let reach = robot.of.robot.kind.reach();
    let own = colours::team(robot.id.team);
    let turn = |v: Vec2| robot.ends.turn(v);

    let believed = robot.ends.turn_pose(model.pose);
    circle(pens, believed.position, reach, own, pixel);
    for (a, b) in outlines::dashed_line(
        believed.position,
        believed.position + 1.3 * reach * unit(believed.heading),
        DASH * pixel,
    ) {
        pens.strong.line_2d(a, b, own);
    }
    connect(pens, believed.position, turn(robot.pose.position), own);

    if let Some(ball) = model.ball {
        let radius = robot.ball.map_or(reach / 2.0, |ball| ball.radius);
        circle(pens, turn(ball.position), radius, own, pixel);
        if let Some(truth) = robot.ball {
            connect(pens, turn(ball.position), turn(truth.position), own);
        }
    }
    for pair in pair(&model.robots, &robot.others) {
        let Some(belief) = pair.belief else { continue };
        let tint = colours::team(belief.team);
        circle(pens, turn(belief.position), reach, tint, pixel);
        if let Some((_, truth)) = pair.truth {
            connect(pens, turn(belief.position), turn(truth), tint);
        }
    }
}

fn circle(pens: &mut Pens, centre: Vec2, radius: f32, tint: Color, pixel: f32) {
    for (a, b) in outlines::dashed_circle(centre, radius, DASH * pixel) {
        pens.strong.line_2d(a, b, tint);
    }
}

fn connect(pens: &mut Pens, belief: Vec2, truth: Vec2, tint: Color) {
    if belief.distance(truth) > NEAR {
        pens.fine.line_2d(belief, truth, tint);
    }
}
