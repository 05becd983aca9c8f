//! Another branch of the match, on the same pitch: its robots and its ball as translucent shapes where it has them.

use bevy::prelude::*;

use super::shapes::{paint, polygon, ring, soft_disc};
use super::visuals::{Drawn, between, height};
use crate::app::view::colours;
use crate::app::view::state::{Beside, Carried, FrameSystems, MatchBegun, Playback};
use crate::clock::Clock;
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::lab::export::outlines::box_at;
use crate::lab::rewind::{BranchId, Rewind};
use crate::pitch::BallKind;
use crate::robot::Robot;

pub(super) fn plugin(app: &mut App) {
    app.add_observer(draw_ghosts)
        .add_systems(Update, (place_ghosts, place_carried).in_set(FrameSystems::Picture));
}

/// What a ghost is of.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
pub enum GhostVisual {
    /// A robot's drive unit.
    Robot(RobotId),
    /// A robot's trailer.
    Trailer(RobotId),
    /// The ball.
    Ball,
}

/// The disc under what a person carries.
#[derive(Component, Clone, Copy, Debug)]
struct Shade;

/// How much of a ghost is seen.
const BODY: f32 = 0.45;
const NOSE: f32 = 0.85;
/// Radius of the disc under what is carried, m.
const SHADE: f32 = 0.25;
/// Ghosts lie over lines and under robots.
const LEVEL: f32 = height::TRAIL + 0.5;

fn draw_ghosts(
    _: On<MatchBegun>,
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<ColorMaterial>>,
    robots: Query<(&RobotId, &Robot)>,
    kind: Res<BallKind>,
) {
    for (id, robot) in &robots {
        let colour = colours::team(id.team);
        let half = Vec2::new(robot.kind.body.length, robot.kind.body.width) / 2.0;
        let outline = box_at(Vec2::ZERO, half);
        let nose =
            [Vec2::new(half.x, 0.0), Vec2::new(0.1 * half.x, half.y), Vec2::new(0.1 * half.x, -half.y)];
        let [body, front] = [BODY, NOSE].map(|alpha| materials.add(paint(colour.with_alpha(alpha))));
        if let Some(trailer) = &robot.kind.trailer {
            let outline = meshes.add(polygon(&trailer.outline));
            let hidden = (Transform::default(), Visibility::Hidden);
            let shape = (Mesh2d(outline), MeshMaterial2d(body.clone()));
            commands.spawn((Drawn, GhostVisual::Trailer(*id), hidden, shape));
        }
        commands
            .spawn((Drawn, GhostVisual::Robot(*id), Transform::default(), Visibility::Hidden))
            .with_children(|parent| {
                let outline = polygon(&outline);
                parent.spawn((Drawn, Mesh2d(meshes.add(outline)), MeshMaterial2d(body)));
                let nose = polygon(&nose);
                let above = Transform::from_xyz(0.0, 0.0, 0.01);
                parent.spawn((Drawn, Mesh2d(meshes.add(nose)), MeshMaterial2d(front), above));
            });
    }
    let shade = materials.add(paint(colours::PILOT.with_alpha(BODY)));
    let disc = meshes.add(soft_disc(SHADE, 0.8));
    let level = Transform::from_xyz(0.0, 0.0, height::BALL + 1.0);
    commands.spawn((Drawn, Shade, Mesh2d(disc), MeshMaterial2d(shade), level, Visibility::Hidden));
    let [fill, edge] = [BODY, NOSE].map(|alpha| materials.add(paint(colours::BALL.with_alpha(alpha))));
    commands.spawn((Drawn, GhostVisual::Ball, Transform::default(), Visibility::Hidden)).with_children(
        |parent| {
            let disc = meshes.add(soft_disc(kind.radius, 0.93));
            parent.spawn((Drawn, Mesh2d(disc), MeshMaterial2d(fill)));
            let rim = meshes.add(ring(kind.radius, 0.15 * kind.radius));
            parent.spawn((Drawn, Mesh2d(rim), MeshMaterial2d(edge), Transform::from_xyz(0.0, 0.0, 0.01)));
        },
    );
}

/// Where a branch has something so many ticks after the beginning.
fn pose_of(rewind: &Rewind, branch: BranchId, tick: u64, what: GhostVisual) -> Option<Pose> {
    let ghost = rewind.ghost(branch, tick)?;
    match what {
        GhostVisual::Ball => Some(Pose { position: ghost.ball, heading: 0.0 }),
        GhostVisual::Robot(robot) => ghost.robot(robot),
        GhostVisual::Trailer(robot) => ghost.trailer(robot),
    }
}

/// Where two branches are still one there are no ghosts.
fn place_ghosts(
    (rewind, beside): (Option<Res<Rewind>>, Res<Beside>),
    (clock, playback): (Res<Clock>, Res<Playback>),
    mut ghosts: Query<(&GhostVisual, &mut Transform, &mut Visibility)>,
) {
    let shown = rewind.as_ref().zip(beside.0).filter(|(rewind, branch)| clock.tick > rewind.parting(*branch));
    for (what, mut transform, mut visibility) in &mut ghosts {
        let pose = shown.and_then(|(rewind, branch)| {
            let after = pose_of(rewind, branch, clock.tick, *what)?;
            let before = pose_of(rewind, branch, clock.tick.saturating_sub(1), *what).unwrap_or(after);
            Some(between(before, after, playback.between))
        });
        if let Some(pose) = pose {
            transform.translation = pose.position.extend(LEVEL);
            transform.rotation = Quat::from_rotation_z(pose.heading);
        }
        visibility.set_if_neq(if pose.is_some() { Visibility::Inherited } else { Visibility::Hidden });
    }
}

fn place_carried(
    carried: Res<Carried>,
    shade: Option<Single<(&mut Transform, &mut Visibility), With<Shade>>>,
) {
    let Some(shade) = shade else { return };
    let (mut transform, mut visibility) = shade.into_inner();
    if let Some((_, at)) = carried.0 {
        transform.translation = at.extend(transform.translation.z);
    }
    visibility.set_if_neq(if carried.0.is_some() { Visibility::Inherited } else { Visibility::Hidden });
}
