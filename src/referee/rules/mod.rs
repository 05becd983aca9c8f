//! The rules of play in the order in which the referee applies them.
//!
//! A rule is a plain function: it sees ball and robots, is told how much time has passed, changes the [`MatchState`] and
//! hands out [`Decision`]s. Nothing here knows of bodies, a clock or chance. Times are carried over from sample to
//! sample with what they exceed, so that matches go the same way at every step size, within one sample.

mod defenders;
mod flow;
mod goal;
mod progress;

#[cfg(test)]
mod properties;
#[cfg(test)]
mod table;
#[cfg(test)]
mod walkthrough;

use bevy::prelude::Vec2;

use super::decision::Decision;
use super::rulebook::RuleBook;
use super::state::MatchState;
use crate::ids::RobotId;
use crate::pitch::Pitch;

/// What stays the same during a match.
#[derive(Clone, Copy, Debug)]
pub struct Laws<'a> {
    pub pitch: &'a Pitch,
    pub book: &'a RuleBook,
    /// In metres.
    pub ball_radius: f32,
}

/// What the referee sees at one moment, in the pitch frame and in metres.
#[derive(Clone, Copy, Debug)]
pub struct Observation<'a> {
    pub ball: Vec2,
    /// The robots on the field, sorted by id.
    pub robots: &'a [(RobotId, Vec2)],
}

/// How a rule judges a sample: laws, what is seen, the seconds since the last sample, the state, and the decisions that
/// rules have made in this sample so far.
pub type Judge = fn(&Laws, &Observation, f64, &mut MatchState, &mut Vec<Decision>);

/// One rule of play.
pub struct Rule {
    pub name: &'static str,
    pub judge: Judge,
}

/// All rules, in order:
///
/// 1. `phases` tells how much of the sample was played, which all others count.
/// 2. `goal` comes before `clock`: a ball that crossed the line before time was up counts, and the rest of the sample is
///    not played.
/// 3. `clock` may end the half, also right after a goal.
/// 4. `returns` comes before `second defender`, so that a removal starts with its full time.
/// 5. `no progress` knows who has just come or gone, so that it finds a free spot.
/// 6. `kick-off` is last: goal and half time may both owe one, and one is taken.
pub const RULES: &[Rule] = &[
    Rule { name: "phases", judge: flow::phases },
    Rule { name: "goal", judge: goal::goal },
    Rule { name: "clock", judge: flow::clock },
    Rule { name: "returns", judge: defenders::returns },
    Rule { name: "second defender", judge: defenders::second_defender },
    Rule { name: "no progress", judge: progress::no_progress },
    Rule { name: "kick-off", judge: flow::kick_off },
];

/// Applies all rules to what is seen `dt` seconds after the last look, and appends what they decide.
///
/// A `dt` that is negative or not finite counts as 0, and one of more than an hour as an hour.
pub fn referee(
    laws: &Laws,
    observation: &Observation,
    dt: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let dt = if dt.is_finite() { dt.clamp(0.0, 3600.0) } else { 0.0 };
    let mut made = Vec::new();
    for rule in RULES {
        (rule.judge)(laws, observation, dt, state, &mut made);
    }
    let placed = made.iter().rev().find_map(|decision| match decision {
        Decision::BallPlaced { at, .. } => Some(*at),
        _ => None,
    });
    state.seen_ball = Some(placed.unwrap_or(observation.ball));
    decisions.append(&mut made);
}

/// Whether a span of time is over, with room for the rounding of a sum of many steps.
fn is_over(seconds: f64, limit: f32) -> bool {
    seconds + ROUNDING >= f64::from(limit)
}

/// Seconds by which a sum of steps may miss its true value.
const ROUNDING: f64 = 1e-6;

/// Where robots stand after this sample's decisions.
fn standing<'a>(
    observation: &'a Observation,
    state: &'a MatchState,
    made: &'a [Decision],
) -> impl Iterator<Item = Vec2> + 'a {
    let seen = observation.robots.iter().filter(|(robot, _)| !state.is_removed(*robot)).map(|(_, at)| *at);
    let returned = made.iter().filter_map(|decision| match decision {
        Decision::RobotReturned { at, .. } => Some(at.position),
        _ => None,
    });
    seen.chain(returned)
}
