//! Meshes of what the picture is made of: filled polygons, rings, frames and soft discs, in metres. Built once a match.

use std::f32::consts::TAU;

use bevy::asset::RenderAssetUsages;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use bevy::sprite_render::AlphaMode2d;

use super::visuals::Drawn;
use crate::geometry::unit;

/// A colour that can fade; without this, opaque colours stay so.
pub fn paint(colour: Color) -> ColorMaterial {
    ColorMaterial { color: colour, alpha_mode: AlphaMode2d::Blend, ..default() }
}

/// A convex polygon, filled.
pub fn polygon(corners: &[Vec2]) -> Mesh {
    let indices = (1..corners.len().saturating_sub(1) as u32).flat_map(|i| [0, i, i + 1]);
    mesh(corners.iter().copied(), indices.collect())
}

/// A closed line of some width along the inside of a convex polygon, counter-clockwise or clockwise.
pub fn frame(corners: &[Vec2], width: f32) -> Mesh {
    band(corners, &inset(corners, width), true)
}

/// A part of a ring, from one angle to another.
pub fn arc(radius: f32, width: f32, from: f32, to: f32) -> Mesh {
    let steps = ((to - from).abs() / TAU * SEGMENTS).ceil().max(2.0) as u32;
    let at = |step: u32| unit(from + (to - from) * step as f32 / steps as f32);
    let outer: Vec<Vec2> = (0..=steps).map(|step| at(step) * (radius + width / 2.0)).collect();
    let inner: Vec<Vec2> = (0..=steps).map(|step| at(step) * (radius - width / 2.0)).collect();
    band(&outer, &inner, false)
}

/// A whole ring.
pub fn ring(radius: f32, width: f32) -> Mesh {
    arc(radius, width, 0.0, TAU)
}

/// A disc that is opaque up to a share of its radius and fades towards its edge.
pub fn soft_disc(radius: f32, core: f32) -> Mesh {
    const STEPS: u32 = 32;
    let rim = |r: f32| (0..STEPS).map(move |step| unit(step as f32 / STEPS as f32 * TAU) * r);
    let points = std::iter::once(Vec2::ZERO).chain(rim(radius * core)).chain(rim(radius));
    let mut indices = Vec::new();
    for step in 0..STEPS {
        let (a, b) = (1 + step, 1 + (step + 1) % STEPS);
        indices.extend([0, a, b, a, a + STEPS, b, b, a + STEPS, b + STEPS]);
    }
    let opacity = |index: usize| if index > STEPS as usize { 0.0 } else { 1.0 };
    let colours: Vec<[f32; 4]> =
        (0..=2 * STEPS as usize).map(|index| [1.0, 1.0, 1.0, opacity(index)]).collect();
    mesh(points, indices).with_inserted_attribute(Mesh::ATTRIBUTE_COLOR, colours)
}

/// A convex polygon with each side moved inwards by some metres.
pub fn inset(corners: &[Vec2], by: f32) -> Vec<Vec2> {
    let count = corners.len();
    let area: f32 = (0..count).map(|i| corners[i].perp_dot(corners[(i + 1) % count])).sum();
    let side = area.signum();
    (0..count)
        .map(|i| {
            let (last, here, next) = (corners[(i + count - 1) % count], corners[i], corners[(i + 1) % count]);
            let (into, out) = ((here - last).normalize_or_zero(), (next - here).normalize_or_zero());
            let (first, second) = (side * into.perp(), side * out.perp());
            let middle = (first + second).normalize_or_zero();
            here + middle * (by / middle.dot(first).max(0.3))
        })
        .collect()
}

/// The materials of one robot; its own, so that it can fade.
pub(super) struct Paint {
    pub body: Handle<ColorMaterial>,
    pub edge: Handle<ColorMaterial>,
    pub team: Handle<ColorMaterial>,
    pub head: Handle<ColorMaterial>,
}

pub(super) type Parent<'a> = bevy::ecs::hierarchy::ChildSpawnerCommands<'a>;

pub(super) fn part(parent: &mut Parent, meshes: &mut Assets<Mesh>, paint: &Paint, outline: &[Vec2]) {
    fill(parent, meshes, &paint.body, polygon(&inset(outline, EDGE / 2.0)), 0.0);
    fill(parent, meshes, &paint.edge, frame(outline, EDGE), 0.01);
}

pub(super) fn fill(
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

/// Width of the line around a part, m.
pub(super) const EDGE: f32 = 0.012;

const SEGMENTS: f32 = 64.0;

/// The strip between two lines of equally many points.
fn band(outer: &[Vec2], inner: &[Vec2], closed: bool) -> Mesh {
    let count = outer.len() as u32;
    let steps = if closed { count } else { count - 1 };
    let indices = (0..steps).flat_map(|i| {
        let next = (i + 1) % count;
        [i, next, count + i, next, count + next, count + i]
    });
    mesh(outer.iter().chain(inner).copied(), indices.collect())
}

fn mesh(points: impl IntoIterator<Item = Vec2>, indices: Vec<u32>) -> Mesh {
    let positions: Vec<[f32; 3]> = points.into_iter().map(|point| [point.x, point.y, 0.0]).collect();
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::RENDER_WORLD)
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_indices(Indices::U32(indices))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::export::outlines::{box_at, rounded_box_at};

    #[test]
    fn a_rounded_box_touches_its_sides_and_spares_its_corners() {
        let corners = rounded_box_at(Vec2::X, Vec2::new(0.5, 0.3), 0.1);
        let far = |side: Vec2| corners.iter().map(|corner| (*corner - Vec2::X).dot(side)).fold(0.0, f32::max);
        assert!((far(Vec2::X) - 0.5).abs() < 1e-5 && (far(Vec2::NEG_Y) - 0.3).abs() < 1e-5);
        assert!(far(Vec2::new(1.0, 1.0)) < 0.8 - 0.05);
        let area: f32 =
            (0..corners.len()).map(|i| corners[i].perp_dot(corners[(i + 1) % corners.len()])).sum();
        assert!(area > 0.0, "counter-clockwise");
    }

    #[test]
    fn a_box_is_inset_by_the_same_on_all_sides_however_it_is_wound() {
        let corners = box_at(Vec2::new(1.0, 0.0), Vec2::new(0.5, 0.3));
        let mut turned = corners;
        turned.reverse();
        for corners in [corners, turned] {
            let inner = inset(&corners, 0.1);
            for (outer, inner) in corners.iter().zip(&inner) {
                let moved = (*inner - *outer).abs();
                assert!((moved - Vec2::splat(0.1)).length() < 1e-5, "{moved}");
                assert!((*inner - Vec2::X).length() < (*outer - Vec2::X).length());
            }
        }
    }
}
