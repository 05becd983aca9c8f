//! Robots as they are drawn: the true outlines of drive unit, jaws and trailer in black, a chevron for the heading and a
//! plate for the number in the team's colour.

use bevy::prelude::*;

use super::colours;
use super::session::MatchBegun;
use super::shapes::{box_at, frame, inset, paint, polygon};
use super::shown::{Drawn, Fade, Shown, height};
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::robot::{Robot, RobotKind, Trailer, jaws};

pub(super) fn plugin(app: &mut App) {
    app.add_observer(draw_robots);
}

/// The plate that bears a robot's number, on the drive unit or on its trailer.
#[derive(Component, Clone, Copy, Debug)]
pub struct Plate {
    pub of: RobotId,
    /// Its middle in the body's frame, m.
    pub middle: Vec2,
}

/// Width of the line around a part, m.
const EDGE: f32 = 0.012;
/// Half the size of a plate, as a share of how far its trailer reaches back: beyond the drive unit in any position.
const PLATE_SHARE: f32 = 0.27;
/// Room between two robots' heights, so that no two parts are at the same one.
const STEP: f32 = 0.1;

/// The materials of one robot; its own, so that it can fade.
struct Paint {
    body: Handle<ColorMaterial>,
    edge: Handle<ColorMaterial>,
    team: Handle<ColorMaterial>,
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
        };
        let handles = [&paint.body, &paint.edge, &paint.team].map(|handle| (handle.clone(), 1.0));
        let mut unit = commands.spawn((Shown::new(entity, Some(*id), *pose, level), Fade::of(handles)));
        unit.with_children(|parent| draw_unit(parent, &mut meshes, &paint, &robot.kind));
        let pulled = trailers.iter().find(|(_, trailer, _)| trailer.of == *id);
        match (pulled, &robot.kind.trailer) {
            (Some((entity, trailer, pose)), Some(kind)) => {
                let back = kind.outline.iter().map(|corner| -corner.x).fold(trailer.radius, f32::max);
                let half = PLATE_SHARE * back;
                let plate = Plate { of: *id, middle: Vec2::X * (half + EDGE - back) };
                let mut drawn = commands.spawn((Shown::new(entity, None, *pose, level - STEP / 2.0), plate));
                drawn.with_children(|parent| {
                    part(parent, &mut meshes, &paint, &kind.outline);
                    draw_plate(parent, &mut meshes, &paint, plate.middle, half);
                });
            }
            _ => {
                let middle = Vec2::X * (-0.25 * robot.kind.body.length);
                unit.insert(Plate { of: *id, middle });
                let half = 0.2 * robot.kind.body.length;
                unit.with_children(|parent| draw_plate(parent, &mut meshes, &paint, middle, half));
            }
        }
    }
}

type Parent<'a> = bevy::ecs::hierarchy::ChildSpawnerCommands<'a>;

fn draw_unit(parent: &mut Parent, meshes: &mut Assets<Mesh>, paint: &Paint, kind: &RobotKind) {
    let half = Vec2::new(kind.body.length, kind.body.width) / 2.0;
    part(parent, meshes, paint, &box_at(Vec2::ZERO, half));
    for jaw in jaws(kind) {
        fill(parent, meshes, &paint.edge, polygon(&jaw), 0.0);
    }
    let reach = Vec2::new(0.62 * half.x, 0.55 * half.y.min(2.0 * half.x));
    for chevron in chevron(reach, 0.55 * half.x) {
        fill(parent, meshes, &paint.team, polygon(&chevron), 0.02);
    }
}

/// Two bars that meet ahead: their corners, for a chevron that reaches so far ahead and aside.
fn chevron(reach: Vec2, thick: f32) -> [[Vec2; 4]; 2] {
    [1.0, -1.0].map(|side| {
        let (tip, tail) = (Vec2::new(reach.x, 0.0), Vec2::new(thick - reach.x, side * reach.y));
        [tip, tail, tail - Vec2::X * thick, tip - Vec2::X * thick]
    })
}

fn part(parent: &mut Parent, meshes: &mut Assets<Mesh>, paint: &Paint, outline: &[Vec2]) {
    fill(parent, meshes, &paint.body, polygon(&inset(outline, EDGE / 2.0)), 0.0);
    fill(parent, meshes, &paint.edge, frame(outline, EDGE), 0.01);
}

fn draw_plate(parent: &mut Parent, meshes: &mut Assets<Mesh>, paint: &Paint, middle: Vec2, half: f32) {
    fill(parent, meshes, &paint.team, polygon(&box_at(middle, Vec2::splat(half))), STEP / 2.0 + 0.03);
}

fn fill(
    parent: &mut Parent,
    meshes: &mut Assets<Mesh>,
    material: &Handle<ColorMaterial>,
    shape: Mesh,
    level: f32,
) {
    parent.spawn((
        Drawn,
        Mesh2d(meshes.add(shape)),
        MeshMaterial2d(material.clone()),
        Transform::from_xyz(0.0, 0.0, level),
    ));
}
