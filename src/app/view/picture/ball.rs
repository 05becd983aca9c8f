//! The ball as it is drawn: orange, with a soft outline and a short trail of where it was.

use std::collections::VecDeque;

use bevy::prelude::*;

use super::shapes::{paint, soft_disc};
use super::visuals::{BodyVisual, Drawn, Fade, height};
use crate::app::view::colours;
use crate::app::view::state::{AfterTick, FrameSystems, MatchBegun};
use crate::clock::Clock;
use crate::geometry::Pose;
use crate::lab::rewind::GoesBack;
use crate::pitch::BallKind;
use crate::world::ball::Ball;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Past>()
        .goes_back::<Past>()
        .add_observer(draw_ball)
        .add_systems(AfterTick, remember_way)
        .add_systems(Update, place_trail.in_set(FrameSystems::Picture));
}

/// Where the ball was, newest first, every [`SPACING`].
#[derive(Resource, Clone, Debug, Default)]
struct Past(VecDeque<Vec2>);

/// A piece of the trail, counted from the ball.
#[derive(Component, Clone, Copy, Debug)]
struct TrailPiece(usize);

/// Pieces of the trail.
const PIECES: usize = 14;
/// Match time between two of them, s.
const SPACING: f32 = 0.05;
/// A way between two pieces longer than this was not rolled, m.
const CARRIED: f32 = 0.5;

fn draw_ball(
    _: On<MatchBegun>,
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<ColorMaterial>>,
    mut past: ResMut<Past>,
    kind: Res<BallKind>,
    ball: Single<(Entity, &Pose), With<Ball>>,
) {
    past.0.clear();
    let (entity, pose) = *ball;
    let radius = kind.radius;
    let [fill, edge] = [colours::BALL, colours::BALL_EDGE.with_alpha(EDGE_OPACITY)]
        .map(|colour| materials.add(paint(colour)));
    let fade = Fade::of([(fill.clone(), 1.0), (edge.clone(), EDGE_OPACITY)]);
    let (disc, halo) = (meshes.add(soft_disc(radius, 0.93)), meshes.add(soft_disc(1.3 * radius, 0.72)));
    commands.spawn((BodyVisual::new(entity, None, *pose, height::BALL), fade)).with_children(|parent| {
        parent.spawn((Drawn, Mesh2d(halo), MeshMaterial2d(edge)));
        parent.spawn((Drawn, Mesh2d(disc), MeshMaterial2d(fill), Transform::from_xyz(0.0, 0.0, 0.1)));
    });
    let piece = meshes.add(soft_disc(radius, 0.6));
    for number in 0..PIECES {
        let left = 1.0 - number as f32 / PIECES as f32;
        let material = materials.add(paint(colours::BALL.with_alpha(0.3 * left)));
        commands.spawn((
            Drawn,
            TrailPiece(number),
            Mesh2d(piece.clone()),
            MeshMaterial2d(material),
            Transform::from_xyz(0.0, 0.0, height::TRAIL).with_scale(Vec3::splat(0.35 + 0.5 * left)),
            Visibility::Hidden,
        ));
    }
}

/// How dark the outline is.
const EDGE_OPACITY: f32 = 0.7;

fn remember_way(clock: Res<Clock>, mut past: ResMut<Past>, ball: Single<&Pose, With<Ball>>) {
    if !clock.tick.is_multiple_of(clock.ticks(SPACING)) {
        return;
    }
    if past.0.front().is_some_and(|last| last.distance(ball.position) > CARRIED) {
        past.0.clear();
    }
    past.0.push_front(ball.position);
    past.0.truncate(PIECES);
}

fn place_trail(past: Res<Past>, mut pieces: Query<(&TrailPiece, &mut Transform, &mut Visibility)>) {
    if !past.is_changed() {
        return;
    }
    for (piece, mut transform, mut visibility) in &mut pieces {
        let place = past.0.get(piece.0);
        if let Some(at) = place {
            transform.translation = at.extend(height::TRAIL);
        }
        visibility.set_if_neq(if place.is_some() { Visibility::Inherited } else { Visibility::Hidden });
    }
}
