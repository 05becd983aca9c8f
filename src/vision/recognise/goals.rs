//! Goals: the ends of a patch of a goal's colour are its posts.

use bevy::math::Vec2;

use super::estimate::{RangeEstimate, fuse};
use super::known::KnownObjects;
use super::perspective::Perspective;
use crate::geometry::{Sighting, wrap_angle};
use crate::ops;
use crate::vision::blob::{ColourBlob, PixelBox};
use crate::vision::colours::ColourClass;
use crate::vision::landmark::{Landmark, LandmarkSighting};
use crate::vision::paint::goal_colour;

/// Pixels of the smallest goal.
const LEAST_AREA: usize = 12;
/// Rows of the lowest goal.
const LEAST_HEIGHT: usize = 3;
/// The height of another patch of a goal against the largest one's, at least.
const PART_HEIGHT: f32 = 0.4;
/// Patches of a goal's colour that are looked at, the largest first.
const CANDIDATES: usize = 6;
/// Deviations of a slope or of a width within which a goal is as it should be.
const CONSISTENT: f32 = 3.0;
/// By how much the width between two posts may differ, m: standard deviation.
const WIDTH_ERROR: f32 = 0.05;

/// An end of a goal in the picture.
#[derive(Clone, Copy, Debug)]
struct PostEnd {
    north: bool,
    bearing: f32,
    estimate: RangeEstimate,
}

/// Finds posts. Patches within `taken` are of something else.
pub fn find_posts(
    view: &Perspective,
    known: &KnownObjects,
    taken: &[PixelBox],
    landmarks: &mut Vec<LandmarkSighting>,
) {
    for east in [false, true] {
        let Some(bounds) = find_goal(view, goal_colour(east), taken) else { continue };
        // Who looks west has the south to the left.
        let left = find_post(view, known, bounds, east, true).map(|post| PostEnd { north: east, ..post });
        let right = find_post(view, known, bounds, east, false).map(|post| PostEnd { north: !east, ..post });
        let posts = match (left, right) {
            (Some(left), Some(right)) => match by_width(known, left, right) {
                Some(both) => both.map(Some),
                None => continue,
            },
            one => [one.0, one.1],
        };
        landmarks.extend(posts.into_iter().flatten().map(|post| LandmarkSighting {
            landmark: Landmark::GoalPost { east, north: post.north },
            sighting: Sighting { range: post.estimate.range, bearing: post.bearing },
            range_deviation: post.estimate.deviation,
        }));
    }
}

/// The box of a goal: of its largest patch, and of others that something in front cuts off.
fn find_goal(view: &Perspective, colour: ColourClass, taken: &[PixelBox]) -> Option<PixelBox> {
    let mut patches = (view.picture.of_class(colour).take(CANDIDATES))
        .filter(|blob| blob.bounds.height() >= LEAST_HEIGHT && !taken.contains(&blob.bounds));
    let main = patches.next().filter(|main| main.area >= LEAST_AREA)?;
    let belongs = |part: &&ColourBlob| {
        let (height, least) = (main.bounds.height() as f32, part.bounds.height() as f32);
        let (top, bottom) =
            (main.bounds.top.max(part.bounds.top), main.bounds.bottom.min(part.bounds.bottom));
        let shared = (bottom + 1).saturating_sub(top) as f32;
        least >= PART_HEIGHT * height && shared >= 0.5 * least
    };
    Some(patches.filter(belongs).fold(main.bounds, |bounds, part| bounds.joined(part.bounds)))
}

/// The post at the left or right end of a goal, if the end is in the picture and no robot hides it.
fn find_post(
    view: &Perspective,
    known: &KnownObjects,
    bounds: PixelBox,
    east: bool,
    left: bool,
) -> Option<PostEnd> {
    let is_cut = if left { bounds.left == 0 } else { bounds.right + 1 == view.picture.width };
    if is_cut || is_hidden(view, bounds, left) {
        return None;
    }
    let (top, bottom) = rows_at_end(view, bounds, goal_colour(east), left)?;
    let x = if left { bounds.left as f32 } else { bounds.right as f32 + 1.0 };
    let (head, foot) = (Vec2::new(x, top as f32), Vec2::new(x, bottom as f32 + 1.0));
    let height = known.paint.goal_height;
    let shows_top = top > 0;
    let stands = stands_on_carpet(view, bounds, bottom, left);
    let estimate = fuse([
        view.by_height(x, (head.y, foot.y), height).filter(|_| shows_top && stands),
        view.by_plane(foot, 0.0).filter(|_| stands),
        view.by_plane(head, height).filter(|_| shows_top),
    ])?;
    let room = CONSISTENT * view.slope_deviation();
    let (highest, lowest) = (view.slope_of(height, estimate.range), view.slope_of(0.0, estimate.range));
    let slack = room + 0.25 * (highest - lowest);
    let is_at_its_height = view.slope(head) <= highest + slack && view.slope(foot) >= lowest - slack;
    (is_at_its_height && estimate.range <= known.farthest).then(|| PostEnd {
        north: false,
        bearing: view.bearing(head),
        // What is seen at the end is a post, or, from aside, the back of the goal beyond it: the middle of both.
        estimate: estimate.beyond(-known.goal_depth / 2.0).less_sure(known.goal_depth / 2.0),
    })
}

/// Whether a robot's marker is beside an end: then the robot may hide the post.
fn is_hidden(view: &Perspective, bounds: PixelBox, left: bool) -> bool {
    let reach = (bounds.height() / 3).max(3) as isize;
    let columns = if left {
        bounds.left as isize - reach..bounds.left as isize
    } else {
        bounds.right as isize + 1..bounds.right as isize + 1 + reach
    };
    let rows = bounds.top as isize..bounds.bottom as isize + 1;
    let is_marker = |class| matches!(class, ColourClass::Red | ColourClass::DarkBlue);
    view.count(columns, rows, is_marker).0 >= LEAST_HEIGHT
}

/// Columns of an end that are looked at.
const END: usize = 3;

/// The first and the last row of a goal's colour at an end.
fn rows_at_end(
    view: &Perspective,
    bounds: PixelBox,
    colour: ColourClass,
    left: bool,
) -> Option<(usize, usize)> {
    let (from, to) = end_columns(bounds, left);
    let is_goal = |row: &usize| (from..=to).any(|x| view.picture.class_at(x, *row) == Some(colour));
    let mut rows = (bounds.top..=bounds.bottom).filter(is_goal);
    let top = rows.next()?;
    let bottom = rows.next_back().unwrap_or(top);
    (bottom + 1 - top >= LEAST_HEIGHT).then_some((top, bottom))
}

fn end_columns(bounds: PixelBox, left: bool) -> (usize, usize) {
    let more = END.min(bounds.width()) - 1;
    if left { (bounds.left, bounds.left + more) } else { (bounds.right - more, bounds.right) }
}

/// Whether carpet or a line begins right below an end: otherwise something hides its foot.
fn stands_on_carpet(view: &Perspective, bounds: PixelBox, bottom: usize, left: bool) -> bool {
    let (from, to) = end_columns(bounds, left);
    let is_carpet = |class| matches!(class, ColourClass::Green | ColourClass::White);
    let below = bottom as isize + 1;
    view.count(from as isize..to as isize + 1, below..below + 3, is_carpet).0 >= END
}

/// Both posts of a goal whose width is known: ranges that fit it better; nothing, if they cannot be its posts.
fn by_width(known: &KnownObjects, left: PostEnd, right: PostEnd) -> Option<[PostEnd; 2]> {
    let (mut a, mut b) = (left, right);
    let between = ops::cos(wrap_angle(a.bearing - b.bearing));
    // One step of a Kalman filter whose measurement is the width.
    let (near, far) = (a.estimate, b.estimate);
    let width =
        (near.range * near.range + far.range * far.range - 2.0 * near.range * far.range * between).sqrt();
    let slopes = [(near.range - far.range * between) / width, (far.range - near.range * between) / width];
    let variances = [near.deviation * near.deviation, far.deviation * far.deviation];
    let variance = slopes[0] * slopes[0] * variances[0]
        + slopes[1] * slopes[1] * variances[1]
        + WIDTH_ERROR * WIDTH_ERROR;
    let error = known.goal_width - width;
    if !variance.is_finite() || error * error > CONSISTENT * CONSISTENT * variance {
        return None;
    }
    for ((post, slope), own) in [&mut a, &mut b].into_iter().zip(slopes).zip(variances) {
        let gain = own * slope / variance;
        post.estimate = RangeEstimate {
            range: (post.estimate.range + gain * error).max(0.0),
            deviation: (own * (1.0 - gain * slope)).max(0.0).sqrt(),
        };
    }
    Some([a, b])
}
