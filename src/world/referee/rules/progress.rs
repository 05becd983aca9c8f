//! No progress: a ball that stays about where it is goes to the nearest spot, whoever waits there.
//!
//! A robot on the spot is in luck (Hammerheads, section V-B): the ball comes down beside it.
//!
//! The clock restarts when the ball is [`RuleBook::no_progress_distance`](crate::world::referee::rulebook::RuleBook) away
//! from where it was when the clock started. Between two samples the ball is taken to roll straight, so that the clock
//! starts at the same places for every step size.

use std::f32::consts::TAU;

use bevy::prelude::Vec2;

use crate::geometry::unit;
use crate::world::referee::decision::{Decision, PlacementReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::Stuck;
use crate::world::referee::rules::observation::{Laws, Observation, is_over, placed_ball, standing};
use crate::world::referee::state::{Anchor, MatchState};

/// Moves a stuck ball. While there is no room at any spot it stays, and goes as soon as there is.
pub(super) fn no_progress(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let ball = observation.ball;
    if laws.book.stuck != Stuck::Spots || state.phase != Phase::Playing || !ball.is_finite() {
        return;
    }
    if let Some(at) = placed_ball(decisions) {
        state.anchor = Some(Anchor { at, seconds: 0.0 });
        return;
    }
    let from = state.seen_ball.filter(|seen| seen.is_finite()).unwrap_or(ball);
    let anchor = state.anchor.unwrap_or(Anchor { at: from, seconds: 0.0 });
    let mut anchor = anchor.moved(from, ball, state.played, laws.book.no_progress_distance);
    let limit = laws.book.no_progress_seconds;
    if is_over(anchor.seconds, limit) {
        let robots: Vec<Vec2> = standing(observation, state, decisions).collect();
        if let Some(at) = place_at_spot(&laws.pitch.penalty_spots, ball, &robots, laws) {
            let beyond = (anchor.seconds - f64::from(limit)).clamp(0.0, state.played);
            anchor = Anchor { at, seconds: beyond };
            decisions.push(Decision::BallPlaced { at, reason: PlacementReason::NoProgress });
        }
    }
    state.anchor = Some(anchor);
}

/// Where a stuck ball goes: to the spot nearest to it; of two as near, the first of the pitch's list. A spot on which the ball
/// practically lies is the last choice, as moving it there would be no progress. `None` while there is room at none.
pub(super) fn place_at_spot(spots: &[Vec2], ball: Vec2, robots: &[Vec2], laws: &Laws) -> Option<Vec2> {
    let order = |spot: &Vec2| {
        let distance = spot.distance(ball);
        (distance < laws.book.no_progress_distance, distance)
    };
    let mut spots = spots.to_vec();
    spots.sort_by(|a, b| {
        let ((a_here, a), (b_here, b)) = (order(a), order(b));
        a_here.cmp(&b_here).then(a.total_cmp(&b))
    });
    spots.into_iter().find_map(|spot| beside(spot, robots, laws))
}

/// The place on the pitch nearest to a spot that is clear of all robots: the spot itself, or one on a ring around it.
fn beside(spot: Vec2, robots: &[Vec2], laws: &Laws) -> Option<Vec2> {
    let room = laws.book.spot_clearance;
    let half = laws.pitch.half_size() - laws.ball_radius;
    let is_clear = |place: &Vec2| {
        let is_on_pitch = place.abs().cmple(half).all() || *place == spot;
        is_on_pitch && robots.iter().all(|robot| robot.distance(*place) >= room)
    };
    let rings = (0..=RINGS).map(|ring| 2.0 * room * f32::from(ring) / f32::from(RINGS));
    // From where the nearest robot is not.
    let nearest = robots.iter().min_by(|a, b| a.distance(spot).total_cmp(&b.distance(spot)));
    let away = nearest.and_then(|robot| (spot - *robot).try_normalize()).unwrap_or(Vec2::X);
    let on_ring = |radius: f32| (0..DIRECTIONS).map(move |step| spot + radius * direction(step).rotate(away));
    rings.flat_map(on_ring).find(is_clear)
}

/// Rings around a spot that are tried, out to twice the clearance.
const RINGS: u8 = 32;
/// Places that are tried on each ring.
const DIRECTIONS: u8 = 24;

/// By turns to the left and to the right, ever farther from straight ahead.
fn direction(step: u8) -> Vec2 {
    let side = if step % 2 == 1 { 1.0 } else { -1.0 };
    unit(side * f32::from(step.div_ceil(2)) * TAU / f32::from(DIRECTIONS))
}

impl Anchor {
    /// The clock after the ball rolled straight from one point to another within some seconds.
    pub(super) fn moved(self, from: Vec2, to: Vec2, seconds: f64, reach: f32) -> Anchor {
        if self.at.distance(to) < reach {
            return Anchor { seconds: self.seconds + seconds, ..self };
        }
        // From where the ball leaves the circle around the anchor, new anchors follow each other at the same distance.
        let (way, length) = (to - from, from.distance(to));
        let left = from + way * exit_share(from - self.at, way, reach);
        let beyond = left.distance(to) % reach;
        let at = to - way * (beyond / length);
        let anchor = Anchor { at, seconds: seconds * f64::from(beyond / length) };
        if anchor.at.is_finite() && anchor.seconds.is_finite() {
            anchor
        } else {
            Anchor { at: to, seconds: 0.0 }
        }
    }
}

/// The share of a way, 0 to 1, after which it leaves the circle around the origin; 0 if it starts outside.
fn exit_share(start: Vec2, way: Vec2, radius: f32) -> f32 {
    let (a, b) = (way.length_squared(), start.dot(way));
    let c = (start.length_squared() - radius * radius).min(0.0);
    if c == 0.0 {
        return 0.0;
    }
    (((b * b - a * c).sqrt() - b) / a).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use crate::world::referee::rules::table::{KICK_OFF_SECONDS, Table};

    use super::*;

    const STUCK: fn(&Decision) -> bool =
        |d| matches!(d, Decision::BallPlaced { reason: PlacementReason::NoProgress, .. });

    #[test]
    fn a_ball_that_lies_still_goes_to_the_nearest_spot_after_ten_seconds() {
        let mut table = Table::playing(60);
        table.ball = Vec2::new(4.3, 2.3);
        table.run(9.9);
        assert_eq!(table.ball, Vec2::new(4.3, 2.3));
        table.run(0.2);
        assert_eq!(table.ball, Vec2::new(2.5, 1.25));
    }

    #[test]
    fn beside_a_robot_that_waits_on_the_nearest_spot_the_ball_comes_down_with_the_least_shift() {
        let (spot, mut table) = (Vec2::new(2.5, 1.25), Table::playing(60));
        let room = table.book.spot_clearance;
        for waits_at in [spot, spot - Vec2::new(0.0, 0.3 * room), spot + Vec2::new(0.5 * room, 0.1)] {
            table.ball = Vec2::new(4.3, 2.3);
            table.robots[0].1 = waits_at;
            table.run(10.1);
            let (clear, shift) = (table.ball.distance(waits_at), table.ball.distance(spot));
            assert!(clear >= room, "{clear} m from the robot");
            let least = room - waits_at.distance(spot);
            assert!(
                shift < least + 2.0 * room / f32::from(RINGS) + 1e-4,
                "shifted by {shift}, least {least}"
            );
        }
    }

    #[test]
    fn a_ball_stuck_on_a_spot_goes_to_the_next_one() {
        let mut table = Table::playing(60);
        table.ball = Vec2::new(2.5, 0.1);
        table.run(10.1);
        assert_eq!(table.ball, Vec2::new(2.5, 1.25));
    }

    #[test]
    fn a_kick_off_starts_the_clock_anew() {
        let mut table = Table::playing(60);
        table.state.time_left = 9.0;
        table.run(9.0);
        assert_eq!(table.state.half, 2);
        table.run(KICK_OFF_SECONDS + 9.9);
        assert_eq!(table.times(STUCK).len(), 0);
        table.run(0.2);
        assert_eq!(table.times(STUCK).len(), 1);
    }

    #[test]
    fn a_pitch_with_one_spot_uses_it_again_and_again() {
        let mut table = Table::playing(60);
        table.pitch.penalty_spots = vec![Vec2::ZERO];
        table.ball = Vec2::new(0.1, 0.0);
        table.run(30.5);
        assert_eq!((table.ball, table.times(STUCK).len()), (Vec2::ZERO, 3));
    }

    #[test]
    fn while_there_is_no_room_at_any_spot_the_ball_waits() {
        let mut table = Table::playing(60);
        table.pitch.penalty_spots = vec![Vec2::ZERO];
        let clearance = std::mem::replace(&mut table.book.spot_clearance, 40.0);
        table.robots[0].1 = Vec2::new(0.0, 1.0);
        table.ball = Vec2::new(3.0, 0.0);
        table.run(15.0);
        assert_eq!(table.ball.x, 3.0);
        table.book.spot_clearance = clearance;
        table.run(0.1);
        assert_eq!(table.ball, Vec2::ZERO);
    }

    #[test]
    fn a_ball_pushed_to_and_fro_makes_no_progress_and_a_rolling_one_does() {
        let mut table = Table::playing(60);
        for step in 0..1300_u16 {
            table.ball = unit(f32::from(step) * 0.05) * 0.2 + Vec2::X;
            table.run(1.0 / 60.0);
        }
        assert_eq!(table.times(STUCK).len(), 2);

        let mut table = Table::playing(60);
        for step in 0..1800_u16 {
            table.ball = unit(f32::from(step) * 0.002) * 2.0;
            table.run(1.0 / 60.0);
        }
        assert_eq!(table.times(STUCK).len(), 0, "0.24 m/s is progress");
    }

    #[test]
    fn the_clock_starts_anew_where_the_ball_crossed_the_distance_and_not_at_the_sample() {
        let start = Anchor { at: Vec2::ZERO, seconds: 3.0 };
        let anchor = start.moved(Vec2::new(0.25, 0.0), Vec2::new(1.75, 0.0), 3.0, 0.5);
        assert!((anchor.at - Vec2::new(1.5, 0.0)).length() < 1e-5, "{}", anchor.at);
        assert!((anchor.seconds - 0.5).abs() < 1e-5, "{}", anchor.seconds);
    }

    #[test]
    fn a_ball_without_a_place_stops_no_clock_and_breaks_none() {
        let mut table = Table::playing(60);
        for ball in
            [Vec2::NAN, Vec2::splat(1e30), Vec2::new(f32::INFINITY, 0.0), Vec2::splat(1e30), Vec2::ZERO]
        {
            table.ball = ball;
            table.run(1.0);
        }
        table.run(10.0);
        assert_eq!(table.times(STUCK).len(), 1);
    }
}
