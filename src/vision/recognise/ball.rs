//! The ball: an orange patch that is round, as large as its place demands, and lies on the carpet.

use std::f32::consts::PI;

use bevy::math::Vec2;

use super::estimate::{RangeEstimate, fuse};
use super::known::KnownObjects;
use super::perspective::Perspective;
use crate::geometry::{Sighting, wrap_angle};
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
/// What a diameter loses at its edges, pixels, where a sensor mixes the ball's colour with that beside it. Fitted to 500 pictures of
/// the AIBO's camera and 400 of the Cye's; in a coarser picture it is as much.
const EDGE_LOSS: f32 = 0.8;
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
    fits.then(|| Sighting { range: estimate.range, bearing: disc.bearing(view) })
}

/// A ball's outline in the picture, pixels.
struct Disc {
    centre: Vec2,
    diameter: f32,
    /// From edge to edge, at the height of the centre.
    width: f32,
    /// The shorter side of what is seen against the longer one; 1, if the picture's edge cuts it.
    aspect: f32,
    /// Whether a part is hidden or beyond the picture's edge.
    is_part: bool,
}

impl Disc {
    /// The diameter of a whole ball is the mean of what both sides of its box and its area say; of a part it is the longer side.
    /// Shadow, paws and the picture's edge hide what is below, so that the upper edge is trusted.
    fn of(view: &Perspective, blob: &ColourBlob) -> Disc {
        let bounds = blob.bounds;
        let (width, height) = (bounds.width() as f32, bounds.height() as f32);
        let (cut_left, cut_right) = (bounds.left == 0, bounds.right + 1 == view.picture.width);
        let (cut_top, cut_bottom) = (bounds.top == 0, bounds.bottom + 1 == view.picture.height);
        let is_cut = cut_left || cut_right || cut_top || cut_bottom;
        let aspect = width.min(height) / width.max(height);
        let is_part = is_cut || aspect < WHOLE_ASPECT;
        let of_area = 2.0 * (blob.area as f32 / PI).sqrt();
        let diameter = if is_part { width.max(height) } else { (width + height + of_area) / 3.0 } + EDGE_LOSS;
        let across = if is_part { diameter } else { width };
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
        Disc {
            centre: Vec2::new(x, y),
            diameter,
            width: across,
            aspect: if is_cut { 1.0 } else { aspect },
            is_part,
        }
    }

    /// The middle of the directions of both edges: far from the picture's middle a sphere is drawn longer on its outer side.
    fn bearing(&self, view: &Perspective) -> f32 {
        let half = Vec2::new(self.width / 2.0, 0.0);
        let (left, right) = (view.bearing(self.centre - half), view.bearing(self.centre + half));
        wrap_angle(right + wrap_angle(left - right) / 2.0)
    }

    /// The range that the diameter says: the outline of a sphere is seen at its tangents.
    fn by_size(&self, view: &Perspective, radius: f32) -> Option<RangeEstimate> {
        let half = Vec2::new(self.diameter / 2.0, 0.0);
        let (left, right) = (view.ray(self.centre - half), view.ray(self.centre + half));
        let distance = radius / ops::sin(left.angle_between(right) / 2.0);
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
