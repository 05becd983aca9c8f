//! Where the walls of a pitch stand.

use bevy::prelude::*;

use crate::pitch::Pitch;

/// Centre and half extents of each wall, in metres.
pub fn wall_boxes(pitch: &Pitch) -> Vec<(Vec2, Vec2)> {
    if pitch.margin() > 0.0 { fence_boxes(pitch) } else { walls_on_the_lines(pitch) }
}

/// Two sides, four beside the goals, and three around each goal.
fn walls_on_the_lines(pitch: &Pitch) -> Vec<(Vec2, Vec2)> {
    let half = pitch.half_size();
    let thick = pitch.walls.thickness / 2.0;
    let post = pitch.goal.width / 2.0;
    let back = half.x + pitch.goal.depth;
    let mut boxes = Vec::new();
    for side in [1.0, -1.0] {
        boxes.push((Vec2::new(0.0, side * (half.y + thick)), Vec2::new(back + 2.0 * thick, thick)));
        boxes.push((Vec2::new(side * (back + thick), 0.0), Vec2::new(thick, half.y)));
        for end in [1.0, -1.0] {
            let beside = Vec2::new(side * (half.x + back) / 2.0, end * (post + half.y) / 2.0);
            boxes.push((beside, Vec2::new((back - half.x) / 2.0, (half.y - post) / 2.0)));
        }
    }
    boxes
}

/// A fence around the carpet, and three thin walls around each goal.
fn fence_boxes(pitch: &Pitch) -> Vec<(Vec2, Vec2)> {
    let edge = pitch.half_size() + pitch.margin();
    let thick = pitch.walls.thickness / 2.0;
    let post = pitch.goal.width / 2.0;
    let (line, deep) = (pitch.half_size().x, pitch.goal.depth / 2.0);
    let mut boxes = Vec::new();
    for side in [1.0, -1.0] {
        boxes.push((Vec2::new(0.0, side * (edge.y + thick)), Vec2::new(edge.x + 2.0 * thick, thick)));
        boxes.push((Vec2::new(side * (edge.x + thick), 0.0), Vec2::new(thick, edge.y)));
        let back = Vec2::new(side * (line + 2.0 * deep + thick), 0.0);
        boxes.push((back, Vec2::new(thick, post + 2.0 * thick)));
        for end in [1.0, -1.0] {
            boxes.push((Vec2::new(side * (line + deep), end * (post + thick)), Vec2::new(deep, thick)));
        }
    }
    boxes
}
