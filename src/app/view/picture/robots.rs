//! Robots as they are drawn: the true outlines of drive unit, jaws and trailer in black, a chevron for the heading and a
//! plate for the number in the team's colour. Robots on four legs are drawn in [`walkers`](super::walkers).

use bevy::prelude::*;

use super::shapes::{Paint, Parent, fill, paint, part, polygon};
use super::visuals::{BodyVisual, Fade, height};
use super::walkers::{HeadVisual, draw_flash, draw_walker};
use crate::app::view::colours;
use crate::app::view::state::MatchBegun;
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::lab::export::outlines::{RobotOutlines, box_at, chevron};
use crate::robot::{Drive, Robot, RobotKind, Trailer, jaws};

pub(super) fn plugin(app: &mut App) {
    app.add_observer(draw_robots);
}

/// The plate that bears a robot's number, on the drive unit or on its trailer.
#[derive(Component, Clone, Copy, Debug)]
pub struct Plate {
    /// The robot that wears it.
    pub of: RobotId,
    /// Its middle in the body's frame, m.
    pub middle: Vec2,
    /// Half its size, m.
    pub half: f32,
    /// The robot's [`reach`], m.
    pub reach: f32,
}

/// Room between two robots' heights, so that no two parts are at the same one.
const STEP: f32 = 0.1;

/// How far a robot reaches back from its drive unit's centre, m.
fn back(kind: &RobotKind) -> f32 {
    let half = kind.body.length / 2.0;
    let trailer = kind.trailer.iter().flat_map(|trailer| &trailer.outline);
    trailer.map(|corner| -corner.x).fold(half, f32::max)
}

/// The radius that holds a robot, standing straight, around the middle of its outline, m.
pub fn reach(kind: &RobotKind) -> f32 {
    let front = kind.body.length / 2.0 + kind.scoop.map_or(0.0, |scoop| scoop.depth);
    Vec2::new((front + back(kind)) / 2.0, kind.body.width / 2.0).length()
}

/// The room that a robot may need around its drive unit's centre, m.
pub fn extent(kind: &RobotKind) -> f32 {
    kind.reach() + if kind.trailer.is_some() { back(kind) } else { 0.0 }
}

fn draw_robots(
    _: On<MatchBegun>,
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<ColorMaterial>>,
    robots: Query<(Entity, &RobotId, &Robot, &Pose)>,
    trailers: Query<(Entity, &Trailer, &Pose)>,
) {
    for (number, (entity, id, robot, pose)) in robots.iter().enumerate() {
        let level = height::ROBOTS + number as f32 * STEP;
        let mut mix = |colour: Color| materials.add(paint(colour));
        let paint = Paint {
            body: mix(colours::ROBOT),
            edge: mix(colours::ROBOT_EDGE),
            team: mix(colours::team(id.team)),
            head: mix(colours::HEAD),
        };
        let handles =
            [&paint.body, &paint.edge, &paint.team, &paint.head].map(|handle| (handle.clone(), 1.0));
        let outlines = RobotOutlines::of(&robot.kind);
        let (middle, half) = (outlines.plate, outlines.plate_half);
        let plate = Plate { of: *id, middle, half, reach: reach(&robot.kind) };
        let mut unit = commands.spawn((BodyVisual::new(entity, Some(*id), *pose, level), Fade::of(handles)));
        match robot.kind.drive {
            Drive::Differential(_) => {
                unit.with_children(|parent| draw_unit(parent, &mut meshes, &paint, &robot.kind));
            }
            Drive::Walker(_) => {
                unit.insert(HeadVisual::default());
                unit.with_children(|parent| {
                    draw_walker(parent, &mut meshes, &paint, &robot.kind, level);
                    draw_flash(parent, &mut meshes, &mut materials, &robot.kind);
                });
            }
        }
        let pulled = trailers.iter().find(|(_, trailer, _)| trailer.of == *id);
        match (pulled, &robot.kind.trailer) {
            (Some((entity, _, pose)), Some(kind)) => {
                let mut drawn =
                    commands.spawn((BodyVisual::new(entity, None, *pose, level - STEP / 2.0), plate));
                drawn.with_children(|parent| {
                    part(parent, &mut meshes, &paint, &kind.outline);
                    draw_plate(parent, &mut meshes, &paint, middle, half);
                });
            }
            _ => {
                unit.insert(plate);
                unit.with_children(|parent| draw_plate(parent, &mut meshes, &paint, middle, half));
            }
        }
    }
}

fn draw_unit(parent: &mut Parent, meshes: &mut Assets<Mesh>, paint: &Paint, kind: &RobotKind) {
    let half = Vec2::new(kind.body.length, kind.body.width) / 2.0;
    part(parent, meshes, paint, &box_at(Vec2::ZERO, half));
    for jaw in jaws(kind) {
        fill(parent, meshes, &paint.edge, polygon(&jaw), 0.0);
    }
    for bar in chevron(half) {
        fill(parent, meshes, &paint.team, polygon(&bar), 0.02);
    }
}

fn draw_plate(parent: &mut Parent, meshes: &mut Assets<Mesh>, paint: &Paint, middle: Vec2, half: f32) {
    fill(parent, meshes, &paint.team, polygon(&box_at(middle, Vec2::splat(half))), STEP / 2.0 + 0.03);
}
