//! What stays where it is: floor, walls, goals, beacons, and the hall around them.

use bevy::math::Vec2;

use super::evenness::Evenness;
use super::floor::Floor;
use super::material::Material;
use super::solid::{Solids, circle, rectangle};
use crate::geometry::Zone;
use crate::pitch::{BallKind, Pitch};
use crate::rng::{Dice, Seed};
use crate::vision::ColourClass;
use crate::vision::paint::{
    BEACON_BANDS, BEACON_RADIUS, CLOTHES, FENCE_HEIGHT, HeightBand, PitchPaint, beacon_colours, goal_colour,
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
        add_people(outermost, &mut solids);
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

/// Pieces of wall that differ a little, as doors and curtains do.
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

/// From one of the people to the next along the pitch, m. ASSUMPTION.
const APART: f32 = 1.2;
/// How near people come to the outermost walls, and how far from them they stand, m. ASSUMPTION.
const AUDIENCE: (f32, f32) = (0.7, 2.2);
/// Half of a body's width and of a head's, m.
const SHOULDERS: (f32, f32) = (0.22, 0.08);
/// The share of shirts in colours that are like those of a pitch: the league asks people near the pitch not to wear such. ASSUMPTION.
const GAUDY: f32 = 0.3;
/// Clothes that are dull, and which of them is skin.
const DULL: (usize, usize) = (2, 2);

/// People who stand around the pitch and look on: they face its middle, flat as posters. The same for all matches.
fn add_people(outermost: Vec2, solids: &mut Solids) {
    let mut dice = Dice::new(Seed(0), "people", None);
    let corners = rectangle(Vec2::ZERO, outermost);
    for side in 0..4 {
        let (from, to) = (corners[side], corners[(side + 1) % 4]);
        let places = (from.distance(to) / APART) as usize;
        let outwards = -(to - from).perp().normalize_or_zero();
        for place in 0..places {
            let along = from.lerp(to, (place as f32 + dice.uniform()) / places as f32);
            let beyond = AUDIENCE.0 + (AUDIENCE.1 - AUDIENCE.0) * dice.uniform();
            add_person(along + outwards * beyond, &mut dice, solids);
        }
    }
}

fn add_person(at: Vec2, dice: &mut Dice, solids: &mut Solids) {
    let scale = 0.9 + 0.2 * dice.uniform();
    let mut any = |from: usize, to: usize| from + (dice.uniform() * (to - from) as f32) as usize;
    let (trousers, dull, gaudy) = (any(0, DULL.0), any(0, DULL.0), any(DULL.1 + 1, CLOTHES.len()));
    let shirt = if dice.chance(GAUDY) { gaudy } else { dull };
    let across = (-at).normalize_or_zero().perp();
    let mut part = |half: f32, bottom: f32, top: f32, clothes: usize| {
        let band = HeightBand { bottom: bottom * scale, top: top * scale };
        solids.panel([at - across * half, at + across * half], band, Material::clothes(clothes));
    };
    part(SHOULDERS.0, 0.0, 0.85, trousers);
    part(SHOULDERS.0, 0.85, 1.45, shirt);
    part(SHOULDERS.1, 1.45, 1.72, DULL.1);
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
