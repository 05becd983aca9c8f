//! Other robots: their markers, which tell the team.

use bevy::math::Vec2;

use super::estimate::{RangeEstimate, fuse};
use super::known::KnownObjects;
use super::perspective::Perspective;
use crate::geometry::{Sighting, wrap_angle};
use crate::ids::Team;
use crate::vision::blob::ColourBlob;
use crate::vision::colours::ColourClass;
use crate::vision::paint::RobotPaint;

/// Pixels of the smallest marker.
const LEAST_AREA: usize = 6;
/// Patches of a team's colour that are looked at, the largest first.
const CANDIDATES: usize = 12;
/// The share of its box that a marker fills at least.
const LEAST_DENSITY: f32 = 0.35;
/// From the near side of a marker around a body to the body's middle, m.
const BODY_DEPTH: f32 = 0.12;
/// No marker is wider, m: a body seen across a corner.
const WIDEST: f32 = 0.5;
/// Nearer than this, m, is the robot itself.
const OWN_BODY: f32 = 0.2;
/// Patches of a marker's colour that are nearer to each other, m, are of one robot.
const ONE_ROBOT: f32 = 0.3;
/// Deviations of a slope within which a marker is where it should be.
const CONSISTENT: f32 = 3.0;

/// A robot as its largest patch shows it.
struct FoundRobot {
    area: usize,
    bearing: f32,
    estimate: RangeEstimate,
}

/// The other robots in the picture, home first, the largest first.
pub fn find_robots(view: &Perspective, known: &KnownObjects, robots: &mut Vec<(Team, Sighting)>) {
    for team in Team::BOTH {
        let paint = &known.robots[team.index()];
        let mut found: Vec<FoundRobot> = Vec::new();
        let blobs = view.picture.of_class(ColourClass::marker(team)).take(CANDIDATES);
        for blob in blobs.filter(|blob| blob.area >= LEAST_AREA && blob.density() >= LEAST_DENSITY) {
            let Some(robot) = as_robot(view, known, paint, blob) else { continue };
            match found.iter_mut().find(|other| other.is(&robot)) {
                Some(other) => other.join(&robot),
                None => found.push(robot),
            }
        }
        robots.extend(found.into_iter().map(|robot| {
            (team, Sighting { range: robot.estimate.range, bearing: wrap_angle(robot.bearing) })
        }));
    }
}

fn as_robot(
    view: &Perspective,
    known: &KnownObjects,
    paint: &RobotPaint,
    blob: &ColourBlob,
) -> Option<FoundRobot> {
    let (bounds, marker) = (blob.bounds, paint.marker);
    let x = (bounds.left + bounds.right + 1) as f32 / 2.0;
    let (top, bottom) = (bounds.top as f32, bounds.bottom as f32 + 1.0);
    let (shows_top, shows_bottom) = (bounds.top > 0, bounds.bottom + 1 < view.picture.height);
    let near_side = fuse([
        view.by_height(x, (top, bottom), marker.height()).filter(|_| shows_top && shows_bottom),
        view.by_plane(Vec2::new(x, top), marker.top).filter(|_| shows_top),
        view.by_plane(Vec2::new(x, bottom), marker.bottom).filter(|_| shows_bottom),
    ])?;
    let depth = paint.marker_radius.unwrap_or(BODY_DEPTH);
    let estimate = near_side.beyond(depth);
    let width = view.bearing(Vec2::new(bounds.left as f32, (top + bottom) / 2.0))
        - view.bearing(Vec2::new(bounds.right as f32 + 1.0, (top + bottom) / 2.0));
    let fits = is_at_its_height(view, paint, near_side.range, Vec2::new(x, top), Vec2::new(x, bottom))
        && wrap_angle(width) * near_side.range <= WIDEST
        && (OWN_BODY..known.farthest).contains(&estimate.range);
    let bearing = view.bearing(Vec2::new(x, (top + bottom) / 2.0));
    fits.then_some(FoundRobot { area: blob.area, bearing, estimate })
}

/// Whether a patch lies within the marker of a robot at this range, m, as the camera sways.
fn is_at_its_height(view: &Perspective, paint: &RobotPaint, range: f32, top: Vec2, bottom: Vec2) -> bool {
    let (highest, lowest) =
        (view.slope_of(paint.marker.top, range), view.slope_of(paint.marker.bottom, range));
    let room = CONSISTENT * view.slope_deviation() + 0.25 * (highest - lowest);
    view.slope(top) <= highest + room && view.slope(bottom) >= lowest - room
}

impl FoundRobot {
    /// Whether another patch is of the same robot.
    fn is(&self, other: &FoundRobot) -> bool {
        let aside = wrap_angle(self.bearing - other.bearing).abs() * self.estimate.range;
        let apart = (self.estimate.range - other.estimate.range).abs();
        aside < ONE_ROBOT && apart < ONE_ROBOT.max(2.0 * other.estimate.deviation)
    }

    /// With another patch. The range is that of the larger one.
    fn join(&mut self, other: &FoundRobot) {
        let share = other.area as f32 / (self.area + other.area) as f32;
        self.bearing += share * wrap_angle(other.bearing - self.bearing);
        self.area += other.area;
    }
}
