//! Lines and feet of walls: where white begins on the carpet, going up some columns of the picture.

use bevy::math::Vec2;

use super::known::KnownObjects;
use super::perspective::Perspective;
use crate::geometry::Sighting;
use crate::vision::colours::ColourClass;
use crate::vision::landmark::{Landmark, LandmarkSighting};

/// Columns that are looked at.
const COLUMNS: usize = 16;
/// Pixels of carpet below a line, at least.
const LEAST_CARPET: usize = 3;
/// Pixels between carpet and white that are neither, at most.
const EDGE: usize = 1;
/// Standard deviation of the range of a point that is of use, at most, m.
const LEAST_SURE: f32 = 0.4;
/// The share of a wall's height that is seen white, at least.
const WALL_SHARE: f32 = 0.5;

/// Finds the nearest line or wall of each column.
pub fn find_lines(view: &Perspective, known: &KnownObjects, landmarks: &mut Vec<LandmarkSighting>) {
    let step = (view.picture.width / COLUMNS).max(1);
    landmarks.extend((step / 2..view.picture.width).step_by(step).filter_map(|x| find_edge(view, known, x)));
}

fn find_edge(view: &Perspective, known: &KnownObjects, x: usize) -> Option<LandmarkSighting> {
    let (mut carpet, mut other) = (0, 0);
    let mut y = view.picture.height;
    while y > 0 {
        match view.picture.class_at(x, y - 1) {
            Some(ColourClass::Green) => (carpet, other) = (carpet + 1, 0),
            Some(ColourClass::White) if carpet >= LEAST_CARPET => {
                let above = stripe_top(view, x, y);
                if let Some(seen) = as_edge(view, known, x, (above, y + other)) {
                    return Some(seen);
                }
                (carpet, other, y) = (0, 0, above + 1);
            }
            _ if other < EDGE => other += 1,
            _ => carpet = 0,
        }
        y -= 1;
    }
    None
}

/// The upper edge of a white stripe of which a lower edge is given.
fn stripe_top(view: &Perspective, x: usize, bottom: usize) -> usize {
    let is_white = |row: &usize| view.picture.class_at(x, *row) == Some(ColourClass::White);
    (0..bottom).rev().take_while(is_white).last().unwrap_or(bottom)
}

/// What a white stripe is between two edges: a wall is about as high as walls are, and a line has carpet behind it and is about as
/// wide as lines are.
fn as_edge(
    view: &Perspective,
    known: &KnownObjects,
    x: usize,
    (top, bottom): (usize, usize),
) -> Option<LandmarkSighting> {
    let foot = Vec2::new(x as f32 + 0.5, bottom as f32);
    let estimate = view.by_plane(foot, 0.0).filter(|estimate| estimate.deviation <= LEAST_SURE)?;
    let head = Vec2::new(foot.x, top as f32);
    let rise = view.slope(head) - view.slope(foot);
    let is_wall = known.paint.walls.is_some_and(|height| rise * estimate.range >= WALL_SHARE * height);
    let landmark = if is_wall {
        Landmark::Wall
    } else if is_line(view, known, (foot, head), estimate.range) {
        Landmark::Line
    } else {
        return None;
    };
    Some(LandmarkSighting {
        landmark,
        sighting: Sighting { range: estimate.range, bearing: view.bearing(foot) },
        range_deviation: estimate.deviation,
    })
}

/// A line may be seen along, so that it looks up to four times as wide.
fn is_line(view: &Perspective, known: &KnownObjects, (foot, head): (Vec2, Vec2), range: f32) -> bool {
    let Some(far) = view.by_plane(head, 0.0) else { return false };
    let (x, above) = (foot.x as isize, head.y as isize);
    let is_carpet = |class| class == ColourClass::Green;
    let has_carpet_behind = view.count(x..x + 1, above - 4..above, is_carpet).0 >= 2;
    let pixel = range * range / view.optics.mount * view.pixel();
    has_carpet_behind && far.range - range <= 4.0 * known.paint.line_width + 2.0 * pixel
}
