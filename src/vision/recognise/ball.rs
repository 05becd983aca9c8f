//! The ball: an orange patch that is round, as large as its place demands, and lies on the carpet.

use std::f32::consts::PI;
use std::ops::RangeInclusive;

use bevy::math::{DMat3, DVec3, Vec2, Vec3};

use super::estimate::{RangeEstimate, fuse};
use super::known::KnownObjects;
use super::perspective::Perspective;
use crate::geometry::{Sighting, angle, wrap_angle};
use crate::ops;
use crate::vision::blob::ColourBlob;
use crate::vision::colours::ColourClass;

/// Pixels of the smallest ball.
const LEAST_AREA: usize = 5;
/// Orange patches that are looked at, the largest first.
const CANDIDATES: usize = 6;
/// The share of its box that a ball fills at least; a circle fills 0.79.
const LEAST_DENSITY: f32 = 0.45;
/// The shorter side of a ball's box against the longer one, at least: less is a stripe.
const LEAST_ASPECT: f32 = 0.3;
/// A ball whose box is not squarer than this is partly hidden or in shadow.
const WHOLE_ASPECT: f32 = 0.8;
/// By how much a diameter is wrong, pixels: of a whole ball, and of one that is partly hidden.
const DIAMETER_ERROR: [f32; 2] = [0.8, 2.5];
/// What a diameter loses at its edges, pixels, where lens and sensor mix the ball's colour with that beside it. How much depends on the
/// colours that a robot was taught: of 1,500 pictures of each, those of the AIBO's camera ask for 1.4, those of the Cye's for 0.8. In a
/// coarser picture it is as much.
const EDGE_LOSS: f32 = 1.1;
/// Deviations between what size and place say of the range, at most.
const CONSISTENT: f32 = 3.0;
/// The share of what is beside and below a ball that carpet and lines are at least; shadow is neither.
const LEAST_CARPET: f32 = 0.12;
/// The share of red beside a patch that makes it a part of a marker. Markers of robots behind a ball are above it.
const MOST_RED: f32 = 0.35;

/// The largest orange patch that can be the ball.
pub fn find_ball(view: &Perspective, known: &KnownObjects) -> Option<Sighting> {
    let candidates = view.picture.of_class(ColourClass::Orange).take(CANDIDATES);
    candidates.take_while(|blob| blob.area >= LEAST_AREA).find_map(|blob| as_ball(view, known, blob))
}

fn as_ball(view: &Perspective, known: &KnownObjects, blob: &ColourBlob) -> Option<Sighting> {
    let disc = Disc::of(view, blob);
    if blob.density() < LEAST_DENSITY || disc.aspect < LEAST_ASPECT {
        return None;
    }
    let by_size = disc.by_size(view, known.ball_radius)?;
    let by_place = view.by_plane(disc.centre, known.ball_radius);
    let estimate = fuse([Some(by_size), by_place])?;
    let fits = disc.fits_its_place(view, known.ball_radius, by_size)
        && estimate.range <= known.farthest
        && lies_on_carpet(view, blob, &disc);
    fits.then_some(Sighting { range: estimate.range, bearing: disc.bearing })
}

/// A ball's outline in the picture.
struct Disc {
    /// Pixels.
    centre: Vec2,
    /// Pixels.
    diameter: f32,
    /// rad, counter-clockwise from the robot's heading.
    bearing: f32,
    /// Half of the angle that it covers, rad.
    half_angle: f32,
    /// The shorter side of what is seen against the longer one; 1, if the picture's edge cuts it.
    aspect: f32,
    /// Whether a part is hidden or beyond the picture's edge.
    is_part: bool,
}

impl Disc {
    /// The diameter of a whole ball is the mean of what both sides of its box and its area say; of a part it is the longer side.
    /// Shadow, paws and the picture's edge hide what is below, so that the upper edge is trusted. What a corner of the picture leaves
    /// of a ball shows neither of its sides whole: there its rim tells.
    fn of(view: &Perspective, blob: &ColourBlob) -> Disc {
        let bounds = blob.bounds;
        let (width, height) = (bounds.width() as f32, bounds.height() as f32);
        let (cut_left, cut_right) = (bounds.left == 0, bounds.right + 1 == view.picture.width);
        let (cut_top, cut_bottom) = (bounds.top == 0, bounds.bottom + 1 == view.picture.height);
        let is_in_corner = (cut_left || cut_right) && (cut_top || cut_bottom);
        if let Some(disc) = is_in_corner.then(|| Disc::by_rim(view, blob)).flatten() {
            return disc;
        }
        let is_cut = cut_left || cut_right || cut_top || cut_bottom;
        let aspect = width.min(height) / width.max(height);
        let is_part = is_cut || aspect < WHOLE_ASPECT;
        let of_area = 2.0 * (blob.area as f32 / PI).sqrt();
        let diameter = if is_part { width.max(height) } else { (width + height + of_area) / 3.0 } + EDGE_LOSS;
        let x = match (cut_left, cut_right) {
            (true, false) => bounds.right as f32 + 1.0 - diameter / 2.0,
            (false, true) => bounds.left as f32 + diameter / 2.0,
            _ => bounds.left as f32 + width / 2.0,
        };
        let y = if cut_top && !cut_bottom {
            bounds.bottom as f32 + 1.0 - diameter / 2.0
        } else {
            bounds.top as f32 + diameter / 2.0
        };
        let centre = Vec2::new(x, y);
        Disc {
            centre,
            diameter,
            bearing: middle_bearing(view, centre, if is_part { diameter } else { width }),
            half_angle: angle_across(view, centre, diameter) / 2.0,
            aspect: if is_cut { 1.0 } else { aspect },
            is_part,
        }
    }

    /// The ball of which a patch shows a part of the rim; nothing, if it tells too little of it.
    fn by_rim(view: &Perspective, blob: &ColourBlob) -> Option<Disc> {
        let (axis, half_angle) = fitted_cone(rim(view, blob).map(|at| view.ray(at)))?;
        let size = (view.picture.width, view.picture.height);
        let centre = view.optics.project(size, view.gaze, axis)?;
        let pixel = angle_across(view, centre, 1.0);
        let diameter = 2.0 * half_angle / pixel;
        let longest = blob.bounds.width().max(blob.bounds.height()) as f32;
        let disc = Disc {
            centre,
            diameter: diameter + EDGE_LOSS,
            bearing: angle(axis.truncate()),
            half_angle: half_angle + EDGE_LOSS * pixel / 2.0,
            aspect: 1.0,
            is_part: true,
        };
        OF_PART.contains(&(diameter / longest)).then_some(disc)
    }

    /// The range that the angle says which it covers.
    fn by_size(&self, view: &Perspective, radius: f32) -> Option<RangeEstimate> {
        let distance = radius / ops::sin(self.half_angle);
        let sink = view.optics.mount - radius;
        let range = (distance * distance - sink * sink).max(0.0).sqrt();
        let error = DIAMETER_ERROR[usize::from(self.is_part)];
        let deviation = distance * error / self.diameter;
        deviation.is_finite().then_some(RangeEstimate { range, deviation })
    }

    /// Whether the patch is as high in the picture as a ball on the carpet is that looks so large. A ball of which a part is hidden
    /// may be nearer, and lower, than it looks.
    fn fits_its_place(&self, view: &Perspective, radius: f32, by_size: RangeEstimate) -> bool {
        let slope = view.slope(self.centre);
        let nearest = (by_size.range - CONSISTENT * by_size.deviation).max(radius);
        let farthest = by_size.range + CONSISTENT * by_size.deviation;
        let room = CONSISTENT * view.slope_deviation();
        let lowest =
            if self.is_part { view.slope_of(radius, nearest / 2.0) } else { view.slope_of(radius, nearest) };
        (lowest - room..=view.slope_of(radius, farthest) + room).contains(&slope)
    }
}

/// The middle of the directions of both edges: far from the picture's middle a sphere is drawn longer on its outer side.
fn middle_bearing(view: &Perspective, centre: Vec2, width: f32) -> f32 {
    let half = Vec2::new(width / 2.0, 0.0);
    let (left, right) = (view.bearing(centre - half), view.bearing(centre + half));
    wrap_angle(right + wrap_angle(left - right) / 2.0)
}

/// The angle that so many pixels across cover, rad.
fn angle_across(view: &Perspective, middle: Vec2, pixels: f32) -> f32 {
    let half = Vec2::new(pixels / 2.0, 0.0);
    view.ray(middle - half).angle_between(view.ray(middle + half))
}

/// How large a ball is, against the longer side of what a corner of the picture shows of it: from a whole one that is drawn long to one
/// of which too little is seen to tell.
const OF_PART: RangeInclusive<f32> = 0.6..=8.0;

/// The points between a patch and what is beside, above and below it, but for what the picture's edge cuts.
fn rim(view: &Perspective, blob: &ColourBlob) -> impl Iterator<Item = Vec2> {
    let (bounds, picture) = (blob.bounds, view.picture);
    let is_orange = move |x: usize, y: usize| picture.class_at(x, y) == Some(ColourClass::Orange);
    let rows = (bounds.top..=bounds.bottom).flat_map(move |y| {
        let ends = ends(bounds.left..=bounds.right, |x| is_orange(x, y), picture.width);
        ends.into_iter().flatten().map(move |x| Vec2::new(x, y as f32 + 0.5))
    });
    let columns = (bounds.left..=bounds.right).flat_map(move |x| {
        let ends = ends(bounds.top..=bounds.bottom, |y| is_orange(x, y), picture.height);
        ends.into_iter().flatten().map(move |y| Vec2::new(x as f32 + 0.5, y))
    });
    rows.chain(columns)
}

/// Where a line through a patch comes to it and leaves it, unless that is an edge of the picture, which has so many pixels.
fn ends(line: RangeInclusive<usize>, mut is_own: impl FnMut(usize) -> bool, size: usize) -> [Option<f32>; 2] {
    let mut own = line.filter(|at| is_own(*at));
    let Some(first) = own.next() else { return [None; 2] };
    let last = own.next_back().unwrap_or(first);
    [(first > 0).then_some(first as f32), (last + 1 < size).then_some(last as f32 + 1.0)]
}

/// The cone on which directions lie: its axis, of length 1, and the angle between the two, rad. A picture shows the rim of a ball as a
/// circle only in its middle; the directions of the rim lie on a cone anywhere, each with the same share along the axis. By least squares;
/// nothing, if the directions lie in a plane.
fn fitted_cone(directions: impl Iterator<Item = Vec3>) -> Option<(Vec3, f32)> {
    let (mut products, mut sum) = (DMat3::ZERO, DVec3::ZERO);
    for way in directions.map(|way| way.as_dvec3().normalize()) {
        products += DMat3::from_cols(way * way.x, way * way.y, way * way.z);
        sum += way;
    }
    // The axis over the cosine of the angle.
    let axis = products.inverse() * sum;
    let tangent = (axis.length_squared() - 1.0).sqrt() as f32;
    (axis.is_finite() && tangent.is_finite()).then(|| (axis.normalize().as_vec3(), ops::atan(tangent)))
}

/// Whether carpet or lines are beside or below a patch, and no marker. What the picture's edge hides is not asked for.
fn lies_on_carpet(view: &Perspective, blob: &ColourBlob, disc: &Disc) -> bool {
    let bounds = blob.bounds;
    let margin = (disc.diameter / 3.0).max(3.0) as isize;
    let (left, right) = (bounds.left as isize, bounds.right as isize + 1);
    let (middle, bottom) = ((bounds.top + bounds.height() / 2) as isize, bounds.bottom as isize + 1);
    let below = left - margin..right + margin;
    let sides = [left - margin..left, right..right + margin];
    let beside = |fits: fn(ColourClass) -> bool| {
        let counts = sides.clone().map(|columns| view.count(columns, middle..bottom, fits));
        (counts[0].0 + counts[1].0, counts[0].1 + counts[1].1)
    };
    let is_carpet = |class: ColourClass| matches!(class, ColourClass::Green | ColourClass::White);
    let (carpet, red) = (beside(is_carpet), beside(|class| class == ColourClass::Red));
    let carpet_below = view.count(below, bottom..bottom + margin, is_carpet);
    let (carpet, ground) = (carpet.0 + carpet_below.0, carpet.1 + carpet_below.1);
    carpet as f32 >= LEAST_CARPET * ground as f32 && red.0 as f32 <= MOST_RED * red.1 as f32
}
