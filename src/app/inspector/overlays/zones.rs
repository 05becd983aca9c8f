//! The robot's zone of control, as far as it lies on the pitch, and the homebases of the role it acts in.

use bevy::prelude::*;

use super::pens::Pens;
use crate::app::inspector::outlines;
use crate::app::inspector::subject::SelectedRobot;
use crate::app::view::colours;
use crate::strategy::Part;

/// From the middle of a homebase's sign to its tips, m.
const REACH: f32 = 0.13;

pub(super) fn draw(pens: &mut Pens, robot: &SelectedRobot, half_pitch: Vec2) {
    let activity = robot.of.activity;
    let tint = colours::team(robot.id.team);
    let zone = activity.danger_zone(robot.strategy);
    // A finger's breadth inside the walls, so that the line is seen.
    let edge = half_pitch - 0.03;
    let (min, max) = (zone.min.max(-edge), zone.max.min(edge));
    pens.strong.rect_2d(robot.ends.turn((min + max) / 2.0), max - min, tint);
    let spec = robot.strategy.roles.get(activity.acting_as);
    let Some(Part::Plays(play)) = spec.map(|role| &role.part) else { return };
    for home in &play.homebases {
        let at = robot.ends.turn(*home);
        pens.strong.lineloop_2d(outlines::diamond(at, REACH), tint);
        if *home == activity.homebase {
            pens.strong.lineloop_2d(outlines::diamond(at, REACH / 2.0), tint);
        }
    }
}
