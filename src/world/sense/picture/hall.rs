//! What stays where it is: floor, walls, goals, beacons, and the hall around them.

use bevy::math::Vec2;

use super::evenness::Evenness;
use super::floor::Floor;
use super::material::Material;
use super::solid::{Solids, circle, rectangle};
use crate::geometry::Zone;
use crate::pitch::{BallKind, Pitch};
use crate::vision::ColourClass;
use crate::vision::paint::{
    BEACON_BANDS, BEACON_RADIUS, FENCE_HEIGHT, HeightBand, PitchPaint, beacon_colours, goal_colour,
};
use crate::world::physics::wall_boxes;

/// All that pictures of a match show and that does not move. Made once for a match.
#[derive(Clone, Debug)]
pub struct Hall {
    /// Carpet and lines.
    pub floor: Floor,
    /// Walls, goals, beacons.
    pub solids: Solids,
    /// Of the light.
    pub evenness: Evenness,
    /// m.
    pub ball_radius: f32,
}

/// From the outermost walls of the pitch to those of the hall, m. ASSUMPTION.
const ROOM: f32 = 3.0;
/// Of the hall, m. ASSUMPTION.
const HALL_HEIGHT: f32 = 4.0;
/// Of a piece of the hall's walls, m. ASSUMPTION.
const PIECE: f32 = 1.7;
/// By how much the inside of a goal stands before the wall that carries it, m.
const LINING: f32 = 0.004;

impl Hall {
    /// The hall around a pitch.
    pub fn of(pitch: &Pitch, ball: &BallKind) -> Hall {
        let outermost = pitch.half_size() + pitch.margin().max(pitch.goal.depth + pitch.walls.thickness);
        let edge = outermost + ROOM;
        let mut solids = Solids::default();
        add_hall(edge, &mut solids);
        let paint = PitchPaint::of(pitch);
        match paint.walls {
            Some(height) => add_walls(pitch, height, &mut solids),
            None => add_fence(pitch, paint.goal_height, &mut solids),
        }
        for end in [1.0, -1.0] {
            add_goal(pitch, &paint, end, &mut solids);
        }
        pitch.beacons.iter().for_each(|at| add_beacon(*at, &mut solids));
        let evenness = Evenness::of(Zone { min: -edge, max: edge });
        Hall { floor: Floor::of(pitch), solids, evenness, ball_radius: ball.radius }
    }
}

const fn up_to(top: f32) -> HeightBand {
    HeightBand { bottom: 0.0, top }
}

/// Pieces of wall that differ a little, as doors, curtains and people do.
fn add_hall(edge: Vec2, solids: &mut Solids) {
    let corners = rectangle(Vec2::ZERO, edge);
    for side in 0..4 {
        let (from, to) = (corners[(side + 1) % 4], corners[side]);
        let pieces = (from.distance(to) / PIECE).ceil().max(1.0) as usize;
        let at = |piece: usize| from.lerp(to, piece as f32 / pieces as f32);
        for piece in 0..pieces {
            let material = match (piece * 5 + side * 3) % 7 {
                0 | 3 => Material::FENCE,
                5 => Material::DARK,
                _ => Material::HALL,
            };
            solids.panel([at(piece), at(piece + 1)], up_to(HALL_HEIGHT), material);
        }
    }
}

fn add_walls(pitch: &Pitch, height: f32, solids: &mut Solids) {
    let white = Material::of(ColourClass::White);
    for (middle, half) in wall_boxes(pitch) {
        let outline = rectangle(middle, half);
        solids.sides(None, &outline, up_to(height), white);
        solids.top(None, &outline, height, white);
    }
}

/// The fence, and the goals' own walls from outside.
fn add_fence(pitch: &Pitch, goal_height: f32, solids: &mut Solids) {
    let edge = pitch.half_size() + pitch.margin();
    for (middle, half) in wall_boxes(pitch) {
        let is_of_goal = middle.abs().cmplt(edge).all();
        let height = if is_of_goal { goal_height } else { FENCE_HEIGHT };
        let outline = rectangle(middle, half);
        solids.sides(None, &outline, up_to(height), Material::FENCE);
        solids.top(None, &outline, height, Material::FENCE);
    }
}

/// The coloured inside of a goal, and its outside where it rises above walls.
fn add_goal(pitch: &Pitch, paint: &PitchPaint, end: f32, solids: &mut Solids) {
    let (line, back) = (pitch.half_size().x, pitch.half_size().x + pitch.goal.depth - LINING);
    let post = pitch.goal.width / 2.0 - LINING;
    // From the mouth around the inside, which is on the right, and back.
    let mut around =
        [(line, post), (back, post), (back, -post), (line, -post)].map(|(x, y)| Vec2::new(x * end, y));
    if end < 0.0 {
        around.reverse();
    }
    for pair in around.windows(2) {
        let inside = Material::of(goal_colour(end > 0.0));
        solids.panel([pair[0], pair[1]], up_to(paint.goal_height), inside);
        if let Some(walls) = paint.walls.filter(|height| *height < paint.goal_height) {
            let above = HeightBand { bottom: walls, top: paint.goal_height };
            solids.panel([pair[1], pair[0]], above, Material::FENCE);
        }
    }
}

fn add_beacon(at: Vec2, solids: &mut Solids) {
    let outline = circle(at, BEACON_RADIUS);
    let white = Material::of(ColourClass::White);
    solids.sides(None, &outline, up_to(BEACON_BANDS[0].bottom), white);
    for (band, colour) in BEACON_BANDS.into_iter().zip(beacon_colours(at.x > 0.0, at.y > 0.0)) {
        solids.sides(None, &outline, band, Material::of(colour));
    }
}
