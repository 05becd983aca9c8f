//! A ball that is out comes back at once, where no walls keep it in.
//!
//! It is out when the whole ball is beyond a line and no goal has been given. Over a side line, it comes back on the
//! throw-in line of that side, some way back towards the goal of the team that touched it last. Over an end line, it
//! comes back at the corner point if the defenders touched it last, and where the throw-in line crosses the half-way line
//! if the attackers did. If nobody knows who touched it, it comes back on the throw-in line as near to where it left as
//! that line goes.

use bevy::prelude::Vec2;

use crate::geometry::Attacking;
use crate::ids::Team;
use crate::world::referee::decision::{Decision, PlacementReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::{Out, ThrowIn};
use crate::world::referee::rules::observation::{Laws, Observation, placed_ball, standing};
use crate::world::referee::state::MatchState;

/// Puts a ball that is out back onto the field.
pub(super) fn out(
    laws: &Laws,
    observation: &Observation,
    _: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let Out::ThrowIn(throw_in) = &laws.book.out else { return };
    let ball = observation.ball;
    if state.phase != Phase::Playing || !ball.is_finite() || placed_ball(decisions).is_some() {
        return;
    }
    let Some(crossing) = crossing(laws, state.seen_ball, ball) else { return };
    let carried_in = decisions.iter().find_map(|decision| match decision {
        Decision::NoGoal { by, .. } => Some(*by),
        _ => None,
    });
    let against = carried_in.or(state.last_touch.map(|robot| robot.team));
    let at = throw_in_place(throw_in, laws, state, crossing, against);
    let robots: Vec<Vec2> = standing(observation, state, decisions).collect();
    let at = free_place(throw_in, laws, at, &robots);
    decisions.push(Decision::BallPlaced { at, reason: PlacementReason::ThrowIn { against } });
}

/// Where a ball that is out crossed the lines, if it is taken to have rolled straight since it was seen last.
fn crossing(laws: &Laws, before: Option<Vec2>, ball: Vec2) -> Option<Vec2> {
    let limit = laws.pitch.half_size() + laws.ball_radius;
    let is_in = |point: &Vec2| point.abs().cmple(limit).all();
    if is_in(&ball) {
        return None;
    }
    let nearest = ball.clamp(-limit, limit);
    let from = before.filter(is_in).unwrap_or(nearest);
    let way = (nearest - from) / (ball - from);
    // A way that has no length along an axis crosses no line of it.
    let share = Vec2::select(way.is_nan_mask(), Vec2::ONE, way).min_element();
    let crossing = from + (ball - from) * share;
    Some(if crossing.is_finite() { crossing.clamp(-limit, limit) } else { nearest })
}

fn throw_in_place(
    throw_in: &ThrowIn,
    laws: &Laws,
    state: &MatchState,
    crossing: Vec2,
    against: Option<Team>,
) -> Vec2 {
    let half = laws.pitch.half_size();
    let sign = |value: f32| if value < 0.0 { -1.0 } else { 1.0 };
    let (end, side) = (sign(crossing.x), sign(crossing.y));
    let line = (half.y - throw_in.inside).max(0.0);
    let ends = line_ends(throw_in, laws);
    let beyond = crossing.abs() - half;
    if beyond.y > beyond.x {
        let back = against.map_or(0.0, |team| state.attacking(team).turn(Vec2::NEG_X).x * throw_in.back);
        return Vec2::new((crossing.x + back).clamp(-ends, ends), side * line);
    }
    let attacked = if end > 0.0 { Attacking::East } else { Attacking::West };
    match against {
        None => Vec2::new(end * ends, side * line),
        Some(team) if state.attacking(team) == attacked => Vec2::new(0.0, side * line),
        // ASSUMPTION: half-way between the penalty area and the throw-in line.
        Some(_) => Vec2::new(end * ends, side * (laws.pitch.penalty_area.width / 2.0 + line) / 2.0),
    }
}

/// Metres from the half-way line to the ends of the throw-in lines.
fn line_ends(throw_in: &ThrowIn, laws: &Laws) -> f32 {
    (laws.pitch.half_size().x - throw_in.from_end).max(0.0)
}

/// The place on a parallel of the side lines that is nearest to a point and that no robot takes; the point itself if all
/// do.
fn free_place(throw_in: &ThrowIn, laws: &Laws, at: Vec2, robots: &[Vec2]) -> Vec2 {
    let room = laws.book.spot_clearance;
    let ends = line_ends(throw_in, laws);
    // First towards the half-way line.
    let inwards = if at.x > 0.0 { -room } else { room };
    let steps = (0..=2 * STEPS).map(|step: u8| {
        let way = f32::from(step.div_ceil(2)) * inwards;
        at + Vec2::X * if step % 2 == 1 { way } else { -way }
    });
    let is_free = |place: &Vec2| robots.iter().all(|robot| robot.distance(*place) >= room);
    steps.filter(|place| place.x.abs() <= ends).find(is_free).unwrap_or(at)
}

/// How many places are tried on each side of one that is taken.
const STEPS: u8 = 8;

#[cfg(test)]
mod tests {
    use crate::ids::RobotId;
    use crate::world::referee::rules::table::Table;

    use super::*;

    const HOME_1: RobotId = RobotId::new(Team::Home, 1);
    const AWAY_1: RobotId = RobotId::new(Team::Away, 1);

    /// Where a ball that rolls from one point to another comes back, and against which team.
    fn thrown_in(table: &mut Table, by: Option<RobotId>, from: Vec2, to: Vec2) -> (Vec2, Option<Team>) {
        table.log.clear();
        table.ball = from;
        table.touching = by.map_or(vec![HOME_1, AWAY_1], |robot| vec![robot]);
        table.look(0.1);
        table.touching.clear();
        table.ball = to;
        table.look(0.1);
        let [(_, Decision::BallPlaced { at, reason: PlacementReason::ThrowIn { against } })] = table.log[..]
        else {
            panic!("{:?}", table.log);
        };
        assert_eq!((at, Phase::Playing), (table.ball, table.state.phase));
        (at, against)
    }

    fn close(a: Vec2, b: Vec2) -> bool {
        a.distance(b) < 1e-4
    }

    #[test]
    fn only_a_whole_ball_is_out() {
        let mut table = Table::four_legged_playing(60);
        for at in [Vec2::new(0.5, 2.04), Vec2::new(-2.74, 1.0), Vec2::new(2.74, 0.2)] {
            table.ball = at;
            table.run(0.2);
            assert_eq!(table.ball, at);
        }
        table.ball = Vec2::new(0.5, 2.05);
        table.look(1.0 / 60.0);
        assert_eq!(table.ball.y, 1.6);
    }

    #[test]
    fn over_a_side_line_it_comes_back_a_metre_towards_the_goal_of_whoever_touched_it() {
        let table = &mut Table::four_legged_playing(60);
        let roll = |y: f32| (Vec2::new(0.1, y * 1.845), Vec2::new(0.5, y * 2.245));
        for side in [1.0, -1.0] {
            let (from, to) = roll(side);
            for (by, x) in [(Some(HOME_1), -0.7), (Some(AWAY_1), 1.3), (None, 0.3)] {
                let (at, against) = thrown_in(table, by, from, to);
                assert!(close(at, Vec2::new(x, side * 1.6)), "{by:?}: {at}");
                assert_eq!(against, by.map(|robot| robot.team));
            }
        }
        table.state.home_attacks = Attacking::West;
        let (at, _) = thrown_in(table, Some(HOME_1), roll(1.0).0, roll(1.0).1);
        assert!(close(at, Vec2::new(1.3, 1.6)), "{at}");
    }

    #[test]
    fn it_never_comes_back_within_a_metre_of_an_end() {
        let table = &mut Table::four_legged_playing(60);
        let (at, _) = thrown_in(table, Some(HOME_1), Vec2::new(-1.5, 1.9), Vec2::new(-1.5, 2.2));
        assert!(close(at, Vec2::new(-1.7, 1.6)), "{at}");
    }

    #[test]
    fn over_an_end_line_it_comes_back_at_the_corner_point_or_at_the_half_way_line() {
        let table = &mut Table::four_legged_playing(60);
        for (end, side) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let (from, to) = (Vec2::new(end * 2.6, side), Vec2::new(end * 2.9, side));
            let (defender, attacker) = if end > 0.0 { (AWAY_1, HOME_1) } else { (HOME_1, AWAY_1) };
            let (at, _) = thrown_in(table, Some(defender), from, to);
            assert!(close(at, Vec2::new(end * 1.7, side * 1.125)), "{at}");
            let (at, _) = thrown_in(table, Some(attacker), from, to);
            assert!(close(at, Vec2::new(0.0, side * 1.6)), "{at}");
            let (at, _) = thrown_in(table, None, from, to);
            assert!(close(at, Vec2::new(end * 1.7, side * 1.6)), "{at}");
        }
    }

    #[test]
    fn over_a_corner_the_line_counts_that_it_crossed_first() {
        let table = &mut Table::four_legged_playing(60);
        let (at, _) = thrown_in(table, Some(HOME_1), Vec2::new(2.5, 1.95), Vec2::new(2.8, 2.25));
        assert!(close(at, Vec2::new(2.5 + 0.095 - 1.0, 1.6)), "over the side line: {at}");
        let (at, _) = thrown_in(table, Some(HOME_1), Vec2::new(2.65, 1.8), Vec2::new(2.95, 2.1));
        assert!(close(at, Vec2::new(0.0, 1.6)), "over the end line: {at}");
        let (at, _) = thrown_in(table, Some(HOME_1), Vec2::new(2.6, 2.03), Vec2::new(2.9, 2.04));
        assert!(close(at, Vec2::new(0.0, 1.6)), "on the side line and over the end line: {at}");
    }

    #[test]
    fn a_robot_that_stands_there_is_left_in_peace() {
        let table = &mut Table::four_legged_playing(60);
        table.put(AWAY_1, Vec2::new(1.35, 1.6));
        let (at, _) = thrown_in(table, None, Vec2::new(1.3, 1.9), Vec2::new(1.3, 2.2));
        assert!(close(at, Vec2::new(1.1, 1.6)), "{at}");
    }

    #[test]
    fn a_ball_that_lay_in_the_goal_when_play_began_and_one_far_away_come_back() {
        let mut table = Table::four_legged(60);
        table.obeys = false;
        table.run(35.0);
        assert_eq!(table.state.phase, Phase::Playing);
        table.obeys = true;
        table.state.seen_ball = Some(Vec2::new(2.9, 0.0));
        table.ball = Vec2::new(2.9, 0.0);
        table.look(0.01);
        assert_eq!((table.ball, table.state.score), (Vec2::new(1.7, 1.6), [0, 0]));
        for at in [Vec2::splat(-f32::MAX), Vec2::new(f32::MAX, 0.0), Vec2::new(-3.0, 0.0)] {
            table.ball = at;
            table.look(0.01);
            assert!(table.pitch.holds(table.ball, 0.0), "{at} to {}", table.ball);
        }
    }

    #[test]
    fn where_there_are_walls_nothing_comes_back() {
        let mut table = Table::playing(60);
        table.ball = Vec2::new(0.0, 5.0);
        table.run(1.0);
        assert_eq!(table.ball, Vec2::new(0.0, 5.0));
    }
}
