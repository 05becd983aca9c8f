//! Beacons: pink over or under the colour of a goal.

use bevy::math::Vec2;

use super::estimate::fuse;
use super::known::KnownObjects;
use super::perspective::Perspective;
use crate::geometry::Sighting;
use crate::vision::blob::{ColourBlob, PixelBox};
use crate::vision::colours::ColourClass;
use crate::vision::landmark::{Landmark, LandmarkSighting};
use crate::vision::paint::{BEACON_BANDS, BEACON_RADIUS, goal_colour};

/// Pixels of the smallest band.
const LEAST_AREA: usize = 4;
/// Pink patches that are looked at, the largest first.
const CANDIDATES: usize = 6;
/// The widths of two bands of a beacon differ at most by this factor.
const LIKE: f32 = 2.0;
/// The width of both bands against their height: what it is, within this factor.
const SHAPE: f32 = 2.0;
/// Deviations of a slope within which a beacon is where it should be.
const CONSISTENT: f32 = 3.0;

/// Finds beacons; the boxes of those found go to `taken`.
pub fn find_beacons(
    view: &Perspective,
    known: &KnownObjects,
    landmarks: &mut Vec<LandmarkSighting>,
    taken: &mut Vec<PixelBox>,
) {
    if !known.has_beacons {
        return;
    }
    for pink in view.picture.of_class(ColourClass::Pink).take(CANDIDATES) {
        let partners = [false, true].into_iter().flat_map(|east| {
            view.picture.of_class(goal_colour(east)).take(CANDIDATES).map(move |blob| (east, blob))
        });
        let mut fitting = partners.filter(|(_, other)| are_bands(pink, other));
        let Some((east, other)) = fitting.next() else { continue };
        let north = pink.centroid.y < other.centroid.y;
        let bounds = pink.bounds.joined(other.bounds);
        let landmark = Landmark::Beacon { east, north };
        let is_new = landmarks.iter().all(|seen| seen.landmark != landmark);
        if let Some(seen) = as_beacon(view, known, landmark, bounds).filter(|_| is_new) {
            landmarks.push(seen);
            taken.push(other.bounds);
        }
    }
}

/// Whether two patches lie on each other and are about as wide.
fn are_bands(a: &ColourBlob, b: &ColourBlob) -> bool {
    let (width, other) = (a.bounds.width() as f32, b.bounds.width() as f32);
    let left = a.bounds.left.max(b.bounds.left);
    let right = a.bounds.right.min(b.bounds.right);
    let shared = (right + 1).saturating_sub(left) as f32;
    let (_, gap) = a.bounds.gap(b.bounds);
    a.area.min(b.area) >= LEAST_AREA
        && shared >= 0.5 * width.min(other)
        && width.max(other) <= LIKE * width.min(other)
        && gap as f32 <= 1.0 + 0.3 * a.bounds.height().min(b.bounds.height()) as f32
        && (a.centroid.y - b.centroid.y).abs() >= 0.3 * a.bounds.height().max(b.bounds.height()) as f32
}

fn as_beacon(
    view: &Perspective,
    known: &KnownObjects,
    landmark: Landmark,
    bounds: PixelBox,
) -> Option<LandmarkSighting> {
    let [lower, upper] = BEACON_BANDS;
    let x = (bounds.left + bounds.right + 1) as f32 / 2.0;
    let (top, bottom) = (Vec2::new(x, bounds.top as f32), Vec2::new(x, bounds.bottom as f32 + 1.0));
    let (shows_top, shows_bottom) = (bounds.top > 0, bounds.bottom + 1 < view.picture.height);
    let near_side = fuse([
        view.by_height(x, (top.y, bottom.y), upper.top - lower.bottom).filter(|_| shows_top && shows_bottom),
        view.by_plane(top, upper.top).filter(|_| shows_top),
        view.by_plane(bottom, lower.bottom).filter(|_| shows_bottom),
    ])?;
    let (highest, lowest) =
        (view.slope_of(upper.top, near_side.range), view.slope_of(lower.bottom, near_side.range));
    let room = CONSISTENT * view.slope_deviation() + 0.25 * (highest - lowest);
    let is_at_its_height = view.slope(top) <= highest + room && view.slope(bottom) >= lowest - room;
    let shape =
        bounds.width() as f32 / bounds.height() as f32 * (upper.top - lower.bottom) / (2.0 * BEACON_RADIUS);
    let is_whole = shows_top && shows_bottom && bounds.left > 0 && bounds.right + 1 < view.picture.width;
    let has_its_shape = !is_whole || (1.0 / SHAPE..=SHAPE).contains(&shape);
    let estimate = near_side.beyond(BEACON_RADIUS);
    (is_at_its_height && has_its_shape && estimate.range <= known.farthest).then(|| LandmarkSighting {
        landmark,
        sighting: Sighting { range: estimate.range, bearing: view.bearing((top + bottom) / 2.0) },
        range_deviation: estimate.deviation,
    })
}
