//! The pitch as it lies there: carpet, lines, walls and the two goals, drawn once a match.

use std::f32::consts::TAU;

use bevy::prelude::*;

use super::shapes::{frame, polygon, ring};
use super::visuals::{Drawn, height};
use crate::app::view::colours;
use crate::app::view::state::MatchBegun;
use crate::lab::export::outlines::box_at;
use crate::pitch::Pitch;

pub(super) fn plugin(app: &mut App) {
    app.add_observer(draw_pitch);
}

/// Width of the white lines along walls, and of lines that are painted on open carpet, m.
const LINE: f32 = 0.04;
const PAINTED: f32 = 0.025;
/// Width of a mowing stripe, m, about.
const STRIPE: f32 = 0.75;
/// Width of the walls as they are drawn, m; behind them the ground is not carpet any more.
pub const WALL: f32 = 0.12;

fn draw_pitch(
    _: On<MatchBegun>,
    mut commands: Commands,
    pitch: Res<Pitch>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<ColorMaterial>>,
) {
    let mut draw = |colour: Color, level: f32, shapes: Vec<Mesh>| {
        let material = materials.add(ColorMaterial::from_color(colour));
        for shape in shapes {
            commands.spawn((
                Drawn,
                Mesh2d(meshes.add(shape)),
                MeshMaterial2d(material.clone()),
                Transform::from_xyz(0.0, 0.0, level),
            ));
        }
    };
    let half = pitch.half_size();
    if is_open(&pitch) {
        let fence = half + pitch.margin() + pitch.walls.thickness;
        let frame = frame(&box_at(Vec2::ZERO, fence), pitch.walls.thickness);
        draw(colours::FENCE, height::GROUND, vec![frame]);
        draw(colours::CHALK, height::GROUND + 0.4, goal_walls(&pitch));
    } else {
        draw(colours::CHALK, height::GROUND, walls(&pitch));
    }
    let carpet = half + pitch.margin();
    draw(colours::CARPET, height::GROUND + 0.1, stripes(carpet, 0));
    draw(colours::STRIPE, height::GROUND + 0.1, stripes(carpet, 1));
    draw(colours::YELLOW_GOAL, height::GROUND + 0.3, vec![goal(&pitch, -1.0)]);
    draw(colours::BLUE_GOAL, height::GROUND + 0.3, vec![goal(&pitch, 1.0)]);
    draw(colours::CHALK, height::LINES, lines(&pitch));
}

/// Whether there is carpet beyond the lines.
pub fn is_open(pitch: &Pitch) -> bool {
    pitch.margin() > 0.0
}

fn filled(min: Vec2, max: Vec2) -> Mesh {
    polygon(&box_at((min + max) / 2.0, (max - min) / 2.0))
}

/// The walls around pitch and goals. Nothing is drawn over another, which matters where pixels are filled in software.
fn walls(pitch: &Pitch) -> Vec<Mesh> {
    let half = pitch.half_size();
    let depth = pitch.goal.depth + WALL;
    let behind = Vec2::new(depth / 2.0, pitch.goal.width / 2.0 + WALL);
    let goal = Vec2::X * (half.x + depth / 2.0);
    let mut walls = vec![frame(&box_at(Vec2::ZERO, half + WALL), WALL)];
    walls.extend([goal, -goal].map(|centre| frame(&box_at(centre, behind), WALL)));
    walls
}

/// The walls of goals that stand free: at the sides and the back.
fn goal_walls(pitch: &Pitch) -> Vec<Mesh> {
    let (line, post) = (pitch.half_size().x, pitch.goal.width / 2.0);
    let (thick, deep) = (pitch.walls.thickness, pitch.goal.depth);
    let boxes = |side: f32| {
        let back = (Vec2::new(deep + thick / 2.0, 0.0), Vec2::new(thick / 2.0, post + thick));
        let ends = [1.0, -1.0]
            .map(|end| (Vec2::new(deep / 2.0, end * (post + thick / 2.0)), Vec2::new(deep, thick) / 2.0));
        [back, ends[0], ends[1]]
            .map(|(at, half)| polygon(&box_at(Vec2::new(side * (line + at.x), at.y), half)))
    };
    [1.0, -1.0].into_iter().flat_map(boxes).collect()
}

/// Every second mowing stripe, from the first or the second on.
fn stripes(half: Vec2, first: u32) -> Vec<Mesh> {
    let count = (2.0 * half.x / STRIPE / 2.0).round().max(1.0) as u32 * 2;
    let width = 2.0 * half.x / count as f32;
    (first..count)
        .step_by(2)
        .map(|stripe| {
            let west = -half.x + stripe as f32 * width;
            filled(Vec2::new(west, -half.y), Vec2::new(west + width, half.y))
        })
        .collect()
}

fn goal(pitch: &Pitch, side: f32) -> Mesh {
    let centre = pitch.goal_centre() + Vec2::X * (pitch.goal.depth / 2.0);
    polygon(&box_at(side * centre, Vec2::new(pitch.goal.depth, pitch.goal.width) / 2.0))
}

fn lines(pitch: &Pitch) -> Vec<Mesh> {
    let half = pitch.half_size();
    let area = pitch.own_penalty_area();
    let width = if is_open(pitch) { PAINTED } else { LINE };
    let mut lines = vec![
        frame(&box_at(Vec2::ZERO, half), width),
        filled(Vec2::new(-width / 2.0, -half.y), Vec2::new(width / 2.0, half.y)),
        ring(pitch.centre_circle_radius, width),
        polygon(&std::array::from_fn::<_, 24, _>(|i| crate::geometry::unit(i as f32 / 24.0 * TAU) * width)),
    ];
    for side in [1.0, -1.0] {
        let (min, max) = (area.min * side, area.max * side);
        lines.push(frame(&box_at((min + max) / 2.0, (max - min).abs() / 2.0), width));
    }
    for spot in pitch.penalty_spots.iter().filter(|spot| spot.length() > width) {
        let (long, thin) = (width * 1.6, width / 4.0);
        lines.push(polygon(&box_at(*spot, Vec2::new(long, thin))));
        lines.push(polygon(&box_at(*spot, Vec2::new(thin, long))));
    }
    lines
}
