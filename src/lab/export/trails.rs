//! The ways that bodies have come in the last seconds.

use std::collections::VecDeque;

use bevy::math::Vec2;

use super::figure::{Figure, Tint};
use super::moment::MatchMoment;
use super::palette;
use crate::ids::Team;

/// Where ball and robots were lately, oldest first.
#[derive(Clone, Debug)]
pub struct Trails {
    /// Ticks between two places.
    every: u64,
    /// Places that are kept.
    most: usize,
    ball: VecDeque<Vec2>,
    robots: Vec<(Team, VecDeque<Vec2>)>,
}

/// A way between two places longer than this was not driven or rolled, m.
const CARRIED: f32 = 0.5;
/// Ticks between two places, about a twentieth of a second.
const EVERY: u64 = 3;
/// Pieces of a trail, each a little fainter than the one after it.
const PIECES: usize = 6;
/// Opacity of the newest piece of the ball's trail and of a robot's, and their widths, m.
const BALL: (f32, f32) = (0.85, 0.09);
const ROBOT: (f32, f32) = (0.85, 0.04);

impl Trails {
    /// Of so many ticks.
    pub fn new(ticks: u64) -> Trails {
        let most = (ticks / EVERY) as usize + 1;
        Trails { every: EVERY, most, ball: VecDeque::new(), robots: Vec::new() }
    }

    /// Takes note of a moment.
    pub fn observe(&mut self, moment: &MatchMoment) {
        if !moment.tick.is_multiple_of(self.every) {
            return;
        }
        if self.robots.is_empty() {
            self.robots = moment.robots.iter().map(|robot| (robot.id.team, VecDeque::new())).collect();
        }
        extend(&mut self.ball, moment.ball, self.most);
        for ((_, trail), robot) in self.robots.iter_mut().zip(&moment.robots) {
            extend(trail, robot.pose.position, self.most);
        }
    }

    /// The trails as lines that fade.
    pub fn figures(&self) -> Vec<Figure> {
        let robots =
            (self.robots.iter()).flat_map(|(team, trail)| fading(trail, palette::team(*team), ROBOT));
        robots.chain(fading(&self.ball, palette::BALL, BALL)).collect()
    }
}

/// A body that was carried leaves no way behind it.
fn extend(trail: &mut VecDeque<Vec2>, place: Vec2, most: usize) {
    if trail.back().is_some_and(|last| last.distance(place) > CARRIED) {
        trail.clear();
    }
    trail.push_back(place);
    while trail.len() > most {
        trail.pop_front();
    }
}

fn fading(trail: &VecDeque<Vec2>, colour: u32, (opacity, width): (f32, f32)) -> Vec<Figure> {
    let places: Vec<Vec2> = trail.iter().copied().collect();
    let length = places.len().div_ceil(PIECES).max(1);
    let pieces = (0..PIECES).filter_map(|piece| {
        let (from, to) = (piece * length, ((piece + 1) * length + 1).min(places.len()));
        let points = Some(apart(places.get(from..to)?)).filter(|points| points.len() > 1)?;
        let opacity = opacity * (piece + 2) as f32 / (PIECES + 1) as f32;
        let tint = Tint { colour, opacity };
        Some(Figure::Line { points, closed: false, width, tint, dash: None })
    });
    pieces.collect()
}

/// Without places that are hardly away from the one before: a body that stands leaves no way.
fn apart(places: &[Vec2]) -> Vec<Vec2> {
    let mut kept = places.to_vec();
    kept.dedup_by(|next, last| next.distance(*last) < STANDS);
    kept
}

/// A body that moves less than this between two places stands, m.
const STANDS: f32 = 0.004;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trail_has_so_many_places_and_ends_where_the_body_was_carried() {
        let mut trail = VecDeque::new();
        for step in 0..20_u8 {
            extend(&mut trail, Vec2::X * (0.1 * f32::from(step)), 10);
        }
        assert_eq!((trail.len(), trail[9]), (10, Vec2::X * (0.1 * 19.0)));
        extend(&mut trail, Vec2::new(-3.0, 1.0), 10);
        assert_eq!(trail, [Vec2::new(-3.0, 1.0)]);
    }

    #[test]
    fn a_body_that_stands_leaves_no_way() {
        let trail: VecDeque<Vec2> = (0..30_u8).map(|step| Vec2::X * (1e-4 * f32::from(step))).collect();
        assert_eq!(fading(&trail, 0, (1.0, 0.1)), []);
    }

    #[test]
    fn a_trail_fades_towards_its_beginning_and_has_no_gap() {
        let trail: VecDeque<Vec2> = (0..30_u8).map(|step| Vec2::X * f32::from(step)).collect();
        let figures = fading(&trail, 0, (1.0, 0.1));
        let mut last: Option<(Vec2, f32)> = None;
        for figure in &figures {
            let Figure::Line { points, tint, .. } = figure else { panic!("{figure:?}") };
            if let Some((end, opacity)) = last {
                assert_eq!(points[0], end);
                assert!(tint.opacity > opacity);
            }
            last = Some((points[points.len() - 1], tint.opacity));
        }
        assert_eq!(last, Some((Vec2::X * 29.0, 1.0)));
    }
}
