//! Outlines in pieces: dashed circles, wedges, diamonds, dots. Pure geometry, in whatever unit the arguments have.

use std::f32::consts::TAU;

use bevy::prelude::*;

use crate::geometry::unit;

/// Chords of a circle: dashes and gaps of about `dash` in length, ten dashes at least.
pub fn dashed_circle(centre: Vec2, radius: f32, dash: f32) -> impl Iterator<Item = (Vec2, Vec2)> {
    let dashes = (TAU * radius / (2.0 * dash.max(f32::EPSILON))).clamp(10.0, 96.0).round() as u32;
    let step = TAU / dashes as f32;
    (0..dashes).map(move |number| {
        let from = number as f32 * step;
        (centre + radius * unit(from), centre + radius * unit(from + step / 2.0))
    })
}

/// Chords of an arc from the angle `from` to the angle `to`: dashes of about `dash` in length, with gaps as long.
pub fn dashed_arc(
    centre: Vec2,
    radius: f32,
    (from, to): (f32, f32),
    dash: f32,
) -> impl Iterator<Item = (Vec2, Vec2)> {
    let length = radius * (to - from).abs();
    let pieces = (length / dash.max(f32::EPSILON)).clamp(1.0, 399.0) as u32 | 1;
    let at = move |piece: u32| centre + radius * unit(from + (to - from) * piece as f32 / pieces as f32);
    (0..pieces).step_by(2).map(move |piece| (at(piece), at(piece + 1)))
}

/// Dashes of about `dash` in length from one point to another, beginning and ending with one.
pub fn dashed_line(from: Vec2, to: Vec2, dash: f32) -> impl Iterator<Item = (Vec2, Vec2)> {
    let pieces = (from.distance(to) / dash.max(f32::EPSILON)).clamp(1.0, 199.0) as u32 | 1;
    let at = move |piece: u32| from.lerp(to, piece as f32 / pieces as f32);
    (0..pieces).step_by(2).map(move |piece| (at(piece), at(piece + 1)))
}

/// Points along an arc from the angle `from` to the angle `to`, both included, about every five degrees.
pub fn arc(centre: Vec2, radius: f32, from: f32, to: f32) -> impl Iterator<Item = Vec2> {
    let steps = ((to - from).abs() / 5.0_f32.to_radians()).ceil().clamp(1.0, 96.0) as u32;
    (0..=steps).map(move |step| centre + radius * unit(from + (to - from) * step as f32 / steps as f32))
}

/// A sector around a heading, as a closed line from its centre and back to it; angles in radians.
pub fn wedge(centre: Vec2, heading: f32, opening: f32, radius: f32) -> impl Iterator<Item = Vec2> {
    let half = opening.min(TAU) / 2.0;
    std::iter::once(centre)
        .chain(arc(centre, radius, heading - half, heading + half))
        .chain(std::iter::once(centre))
}

/// The corners of a square on its tip.
pub fn diamond(centre: Vec2, reach: f32) -> [Vec2; 4] {
    [Vec2::X, Vec2::Y, Vec2::NEG_X, Vec2::NEG_Y].map(|tip| centre + reach * tip)
}

/// Radii of the rings that fill a disc when each is drawn as a line of this width.
pub fn rings(radius: f32, width: f32) -> impl Iterator<Item = f32> {
    let count = (radius / width.max(f32::EPSILON)).ceil().clamp(1.0, 12.0) as u32;
    (0..count).map(move |ring| radius * (ring as f32 + 0.5) / count as f32)
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use super::*;

    #[test]
    fn a_dashed_circle_is_half_dashes_and_half_gaps() {
        let centre = Vec2::new(1.0, 2.0);
        let dashes: Vec<_> = dashed_circle(centre, 1.0, 0.1).collect();
        assert_eq!(dashes.len(), 31);
        let drawn: f32 = dashes.iter().map(|(a, b)| a.distance(*b)).sum();
        assert!((drawn - PI).abs() < 0.02, "{drawn}");
        assert!(dashes.iter().all(|(a, b)| [a, b].iter().all(|p| (p.distance(centre) - 1.0).abs() < 1e-5)));
    }

    #[test]
    fn a_small_dashed_circle_is_still_dashed() {
        assert_eq!(dashed_circle(Vec2::ZERO, 0.01, 0.1).count(), 10);
        assert_eq!(dashed_circle(Vec2::ZERO, 1.0, 0.0).count(), 96);
    }

    #[test]
    fn a_dashed_line_begins_and_ends_with_a_dash() {
        let dashes: Vec<_> = dashed_line(Vec2::ZERO, Vec2::X, 0.1).collect();
        assert_eq!(dashes.first().map(|dash| dash.0), Some(Vec2::ZERO));
        assert!(dashes.last().is_some_and(|dash| dash.1.distance(Vec2::X) < 1e-6));
        assert_eq!(dashed_line(Vec2::ZERO, Vec2::ZERO, 0.1).count(), 1);
    }

    #[test]
    fn a_dashed_arc_lies_between_its_two_angles() {
        let dashes: Vec<_> = dashed_arc(Vec2::ZERO, 2.0, (0.0, PI / 2.0), 0.2).collect();
        assert_eq!(dashes.len(), 8);
        assert!(dashes[0].0.distance(Vec2::new(2.0, 0.0)) < 1e-5);
        assert!(dashes[7].1.distance(Vec2::new(0.0, 2.0)) < 1e-5);
    }

    #[test]
    fn a_wedge_opens_symmetrically_around_its_heading() {
        let points: Vec<_> = wedge(Vec2::ZERO, PI / 2.0, PI / 2.0, 2.0).collect();
        assert_eq!((points[0], points[points.len() - 1]), (Vec2::ZERO, Vec2::ZERO));
        let (right, left) = (points[1], points[points.len() - 2]);
        assert!((right - Vec2::new(2.0_f32.sqrt(), 2.0_f32.sqrt())).length() < 1e-5, "{right}");
        assert!((left - Vec2::new(-right.x, right.y)).length() < 1e-5, "{left}");
    }

    #[test]
    fn rings_fill_a_disc_without_leaving_it() {
        let radii: Vec<_> = rings(4.0, 2.0).collect();
        assert_eq!(radii, [1.0, 3.0]);
        assert_eq!(diamond(Vec2::X, 1.0)[2], Vec2::ZERO);
    }
}
