//! Plain scenes for tests, seen by a camera: nominal paints without light, noise or the mixing of colours at edges.

use bevy::math::{Vec2, Vec3};

use super::colours::ColourClass;
use super::image::Image;
use super::optics::{Gaze, Optics};
use super::sketch::colour_of;

/// A thing on a carpet without end, in the robot's own frame: x ahead, y to the left.
#[derive(Clone, Copy, Debug)]
pub enum Prop {
    /// A sphere on the carpet: its place and radius.
    Ball(Vec2, f32),
    /// An upright cylinder: its place, radius, bottom and top.
    Post(Vec2, f32, f32, f32),
    /// An upright wall from end to end, from the carpet to a top.
    Screen(Vec2, Vec2, f32),
    /// A painted stripe from end to end, of this width.
    Stripe(Vec2, Vec2, f32),
}

/// What a camera sees of things, each in the colour of a class or in grey.
pub fn scene(
    optics: &Optics,
    size: (usize, usize),
    gaze: Gaze,
    things: &[(Prop, Option<ColourClass>)],
) -> Image {
    let mut image = Image::new(size.0, size.1);
    let lens = Vec3::new(0.0, 0.0, optics.mount);
    for (index, pixel) in image.pixels.iter_mut().enumerate() {
        let at = Vec2::new((index % size.0) as f32 + 0.5, (index / size.0) as f32 + 0.5);
        let way = optics.ray(size, gaze, at).normalize();
        let carpet = if way.z < 0.0 { -lens.z / way.z } else { f32::INFINITY };
        let nothing = if way.z < 0.0 { Some(ColourClass::Green) } else { None };
        let hits = things.iter().filter_map(|(prop, class)| Some((prop.hit(lens, way)?, *class)));
        let nearest = hits.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|hit| hit.0 <= carpet + 1e-4);
        *pixel = colour_of(nearest.map_or(nothing, |(_, class)| class));
    }
    image
}

impl Prop {
    /// How far along a ray it is met.
    fn hit(self, lens: Vec3, way: Vec3) -> Option<f32> {
        match self {
            Prop::Ball(place, radius) => {
                let offset = place.extend(radius) - lens;
                let middle = offset.dot(way);
                let gap = offset.length_squared() - middle * middle;
                (gap < radius * radius && middle > 0.0).then(|| middle - (radius * radius - gap).sqrt())
            }
            Prop::Post(place, radius, bottom, top) => {
                let (flat, scale) = (way.truncate().normalize(), way.truncate().length());
                let middle = place.dot(flat);
                let gap = place.length_squared() - middle * middle;
                if gap >= radius * radius {
                    return None;
                }
                let share = (middle - (radius * radius - gap).sqrt()) / scale;
                (share > 0.0 && (bottom..top).contains(&(lens.z + share * way.z))).then_some(share)
            }
            Prop::Screen(from, to, top) => {
                let (along, flat) = (to - from, way.truncate());
                let slope = flat.perp_dot(along);
                let (share, place) = (from.perp_dot(along) / slope, from.perp_dot(flat) / slope);
                let height = lens.z + share * way.z;
                (share > 0.0 && (0.0..=1.0).contains(&place) && (0.0..top).contains(&height)).then_some(share)
            }
            Prop::Stripe(from, to, width) => {
                let share = -lens.z / way.z;
                let (offset, along) = (way.truncate() * share - from, to - from);
                let place = offset.dot(along) / along.length_squared();
                let aside = offset.perp_dot(along).abs() / along.length();
                (share > 0.0 && (0.0..=1.0).contains(&place) && aside <= width / 2.0).then_some(share)
            }
        }
    }
}
