//! Free kicks, throw-ins, goal kicks and corner kicks: the ball lies where it is kicked from, and opponents keep away from it
//! until the set play is over, as far as at a kick-off: no robot is nearer to the ball than the radius of the centre circle.

use bevy::prelude::Vec2;

use super::super::returns;
use crate::geometry::{Pose, angle, unit};
use crate::ids::{RobotId, Team};
use crate::world::gamecontroller::control::SetPlay;
use crate::world::gamecontroller::referee_box::BoxView;
use crate::world::referee::decision::{Decision, PlacementReason};
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::ReturnPlace;
use crate::world::referee::rules::observation::{Laws, Observation, placed_ball, standing};
use crate::world::referee::state::MatchState;

/// Metres that a robot needs at most to come to rest. ASSUMPTION: a third of a metre from a metre a second.
const BRAKING: f32 = 0.35;
/// Metres by which a place may be missed.
const ROUNDING: f32 = 0.01;
/// Metres that the ball has gone when it is in play, and nobody is carried away from it any more.
const IN_PLAY: f32 = 0.2;

pub(super) fn follow(
    view: &BoxView,
    laws: &Laws,
    observation: &Observation,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let kind = Some(view.set_play).filter(|play| !matches!(play, SetPlay::None | SetPlay::Other(_)));
    let running =
        kind.filter(|_| state.phase == Phase::Playing && !view.is_penalty_kick()).zip(view.kicking_team());
    let Some((play, kicking)) = running else {
        state.following.set_play = None;
        if state.following.penalty_kick.is_none() {
            state.restraints.held_back.clear();
        }
        return;
    };
    let known = state.following.set_play.filter(|(before, by, _)| (*before, *by) == (play, kicking));
    let lies = known.map_or_else(|| ball_place(play, kicking, laws, state, observation.ball), |(.., at)| at);
    // A robot that comes to rest may push it.
    let is_pushed = view.stopped && observation.ball.distance(lies) > IN_PLAY / 2.0;
    if known.is_none() || is_pushed {
        decisions.push(Decision::BallPlaced { at: lies, reason: PlacementReason::SetPlay });
    }
    state.following.set_play = Some((play, kicking, lies));
    let ball = placed_ball(decisions).unwrap_or(observation.ball);
    let is_moved = ball.distance(observation.ball) > ROUNDING;
    if ball.distance(lies) < IN_PLAY {
        put_away(ball, is_moved, kicking, laws, observation, state, decisions);
    }
    hold_back(ball, kicking, laws, observation, state);
}

/// Where the ball lies for a set play: in the corner that it is nearest to, at the corner of the goalkeeper's area, and for
/// all others where it is, on the pitch.
fn ball_place(play: SetPlay, kicking: Team, laws: &Laws, state: &MatchState, ball: Vec2) -> Vec2 {
    let half = laws.pitch.half_size();
    let ends = state.attacking(kicking);
    // As the kicking team sees it.
    let seen = if ball.is_finite() { ends.turn(ball) } else { Vec2::ZERO };
    let side = if seen.y < 0.0 { -1.0 } else { 1.0 };
    let corner = half - laws.ball_radius;
    let at = match play {
        SetPlay::CornerKick => Vec2::new(corner.x, side * corner.y),
        SetPlay::GoalKick => {
            let area = laws.pitch.own_penalty_area();
            Vec2::new(area.max.x, side * area.max.y)
        }
        _ => seen.clamp(-corner, corner),
    };
    ends.turn(at)
}

/// Puts opponents that are too near to the ball away from it, as well as any robot on which it has been put.
fn put_away(
    ball: Vec2,
    is_moved: bool,
    kicking: Team,
    laws: &Laws,
    observation: &Observation,
    state: &MatchState,
    decisions: &mut Vec<Decision>,
) {
    let distance = distance_to_ball(laws);
    for (robot, at) in observation.on_field(state) {
        let least = match robot.team == kicking {
            true if is_moved => laws.book.spot_clearance,
            true => continue,
            false => distance,
        };
        if at.distance(ball) < least {
            let others: Vec<Vec2> =
                standing(observation, state, decisions).filter(|other| *other != at).collect();
            let place = place_away(ball, at, distance + BRAKING, laws, &others).or_else(|| {
                let attacks = state.attacking(robot.team);
                returns::place_at_side_line(laws, ReturnPlace::OwnHalf, ball, attacks, &others)
            });
            decisions.extend(place.map(|at| Decision::RobotPlaced { robot, at }));
        }
    }
}

/// Lets opponents stand that would come too near.
fn hold_back(ball: Vec2, kicking: Team, laws: &Laws, observation: &Observation, state: &mut MatchState) {
    let near = |(robot, at): &(RobotId, Vec2)| {
        robot.team != kicking && at.distance(ball) < distance_to_ball(laws) + BRAKING - ROUNDING
    };
    let held_back = observation.on_field(state).filter(near).map(|(robot, _)| robot).collect();
    state.restraints.held_back = held_back;
}

/// Metres that the centre of an opponent keeps from the ball, so that all of it is outside of a centre circle around it.
fn distance_to_ball(laws: &Laws) -> f32 {
    laws.pitch.centre_circle_radius + laws.book.spot_clearance
}

/// A free place at some distance from the ball, in a direction as near as there is to the one in which a robot stands; it
/// faces the ball there.
fn place_away(ball: Vec2, from: Vec2, distance: f32, laws: &Laws, others: &[Vec2]) -> Option<Pose> {
    let room = laws.book.spot_clearance;
    let outwards = (from - ball).try_normalize().unwrap_or_else(|| -ball.normalize_or(Vec2::X));
    let steps = (0..2 * DIRECTIONS).map(|step| {
        let way = f32::from(step.div_ceil(2)) * std::f32::consts::PI / f32::from(DIRECTIONS);
        unit(if step % 2 == 1 { way } else { -way }).rotate(outwards)
    });
    let half = laws.pitch.half_size() - room;
    let mut places = steps.map(|way| (ball + distance * way, way));
    let is_free = |at: &Vec2| {
        at.abs().cmple(half).all() && others.iter().all(|other| other.distance(*at) >= 2.0 * room)
    };
    let (position, way) = places.find(|(at, _)| is_free(at))?;
    Some(Pose { position, heading: angle(-way) })
}

/// Directions on each side that are tried.
const DIRECTIONS: u8 = 12;
