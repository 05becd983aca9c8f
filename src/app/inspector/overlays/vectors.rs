//! The vectors of the running assemblage, as arrows from the robot: each as it counts in the sum, and the sum.

use bevy::prelude::*;

use super::pens::Pens;
use crate::app::inspector::subject::SelectedRobot;
use crate::app::view::colours;

/// Length on the pitch of a vector of length 1, m.
const SCALE: f32 = 0.8;
/// Longest and shortest arrow, m.
const LONGEST: f32 = 1.6;
const SHORTEST: f32 = 0.02;

pub(super) fn draw(pens: &mut Pens, robot: &SelectedRobot, from: Vec2) {
    let Some((_, assemblage)) = robot.assemblage() else { return };
    let contributions = robot.of.contributions;
    // The sum first and broad, so that a schema that points the same way is seen upon it.
    arrow(&mut pens.broad, from, robot.ends.turn(contributions.sum), colours::SUM);
    for (term, vector) in assemblage.terms.iter().zip(&contributions.vectors) {
        let tint = colours::schema(term.kind());
        arrow(&mut pens.strong, from, robot.ends.turn(*vector * term.weight), tint);
    }
}

fn arrow<Line: GizmoConfigGroup>(pen: &mut Gizmos<Line>, from: Vec2, vector: Vec2, tint: Color) {
    let way = (vector * SCALE).clamp_length_max(LONGEST);
    let length = way.length();
    if length >= SHORTEST {
        pen.arrow_2d(from, from + way, tint).with_tip_length((0.35 * length).min(0.12));
    }
}
