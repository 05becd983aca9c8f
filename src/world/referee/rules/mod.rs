//! The rules of play in the order in which the referee applies them.
//!
//! A rule is a plain function: it sees ball and robots, is told how much time has passed, changes the [`MatchState`] and
//! hands out [`Decision`]s. Nothing here knows of bodies, a clock or chance. Times are carried over from sample to
//! sample with what they exceed, so that matches go the same way at every step size, within one sample.

mod by_hand;
mod defenders;
mod flow;
mod following;
mod goal;
mod holding;
mod illegal_defender;
mod leaving;
mod out;
mod progress;
mod pushing;
mod returns;
mod stuck;
mod touches;
mod walking;

#[cfg(test)]
mod four_legged_table;
#[cfg(test)]
mod properties;
#[cfg(test)]
mod table;
#[cfg(test)]
mod walkthrough;

#[cfg(test)]
pub(super) use four_legged_table::{four_legged_book, read_book};

use bevy::prelude::Vec2;
pub(super) use following::Following;
pub use following::{Word, follow};

use super::decision::{Decision, RemovalReason};
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
    /// The robots that touch the ball, in any order; the robot that holds it need not be among them.
    pub touching: &'a [RobotId],
    /// The robot that has the ball so firmly that nobody else gets at it, under its chin for instance.
    pub held_by: Option<RobotId>,
    /// Who pushes which opponent, in any order: they touch, and the first one drives against the second one.
    pub shoving: &'a [(RobotId, RobotId)],
    /// The robots that stand still, in any order.
    pub still: &'a [RobotId],
}

impl<'a> Observation<'a> {
    /// Ball and robots, of which none touches the ball or another one and none is known to stand still.
    pub fn of(ball: Vec2, robots: &'a [(RobotId, Vec2)]) -> Observation<'a> {
        Observation { ball, robots, touching: &[], held_by: None, shoving: &[], still: &[] }
    }

    /// Where a robot is that has not been taken off the field.
    fn place(&self, robot: RobotId, state: &MatchState) -> Option<Vec2> {
        self.on_field(state).find(|(other, _)| *other == robot).map(|(_, at)| at)
    }

    /// The robots that have not been taken off the field, by id.
    fn on_field<'s>(&self, state: &'s MatchState) -> impl Iterator<Item = (RobotId, Vec2)> + use<'a, 's> {
        self.robots.iter().copied().filter(|(robot, _)| !state.is_removed(*robot))
    }

    /// The robot on the field that is nearest to a point, of those that are asked for; of equals the first by id.
    fn nearest(
        &self,
        state: &MatchState,
        to: Vec2,
        asked: impl Fn(RobotId) -> bool,
    ) -> Option<(RobotId, Vec2)> {
        let asked = self.on_field(state).filter(|(robot, _)| asked(*robot));
        asked.min_by(|(_, a), (_, b)| a.distance(to).total_cmp(&b.distance(to)))
    }
}

/// How a rule judges a sample: laws, what is seen, the seconds since the last sample, the state, and the decisions that
/// rules have made in this sample so far.
pub type Judge = fn(&Laws, &Observation, f64, &mut MatchState, &mut Vec<Decision>);

/// One rule of play.
pub struct Rule {
    pub name: &'static str,
    pub judge: Judge,
}

/// All rules, in order; which of them bite is for the [`RuleBook`] to say:
///
/// 1. `walking` may cut the time of [`Phase::Ready`](super::state::Phase) short, which `phases` counts.
/// 2. `phases` tells how much of the sample was played, which all others count.
/// 3. `places by hand` follows the order to stand still at once.
/// 4. `touches` knows who touched the ball, and when the kick-off is over, before `goal` and `out` ask.
/// 5. `goal` comes before `clock`: a ball that crossed the line before time was up counts, and the rest of the sample is
///    not played.
/// 6. `clock` may end the half, also right after a goal, and `mercy` the match.
/// 7. `out` moves the ball before others ask where it is. It comes after `goal`, as a goal is no ball that is out.
/// 8. `returns` comes before what removes robots, so that a removal starts with its full time.
/// 9. Of the rules that remove robots the first that bites gives the reason. `stuck` is the last of them, since it may be
///    enough to take off the robot at fault.
/// 10. `no progress` knows who has just come or gone, so that it finds a free spot.
/// 11. `kick-off` is last: several rules may owe one, and one is taken.
pub const RULES: &[Rule] = &[
    Rule { name: "walking", judge: walking::walking },
    Rule { name: "phases", judge: flow::phases },
    Rule { name: "places by hand", judge: by_hand::places_by_hand },
    Rule { name: "touches", judge: touches::touches },
    Rule { name: "goal", judge: goal::goal },
    Rule { name: "clock", judge: flow::clock },
    Rule { name: "mercy", judge: flow::mercy },
    Rule { name: "out", judge: out::out },
    Rule { name: "returns", judge: returns::returns },
    Rule { name: "second defender", judge: defenders::second_defender },
    Rule { name: "illegal defender", judge: illegal_defender::illegal_defender },
    Rule { name: "ball holding", judge: holding::ball_holding },
    Rule { name: "pushing", judge: pushing::pushing },
    Rule { name: "leaving", judge: leaving::leaving },
    Rule { name: "stuck", judge: stuck::stuck },
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
    state.seen_ball = Some(placed_ball(&made).unwrap_or(observation.ball));
    decisions.append(&mut made);
}

/// Where the ball has been put in this sample.
fn placed_ball(made: &[Decision]) -> Option<Vec2> {
    made.iter().rev().find_map(|decision| match decision {
        Decision::BallPlaced { at, .. } => Some(*at),
        _ => None,
    })
}

/// Takes a robot off the field, unless another rule has already done so or people have just put it where it is.
fn send_off(
    state: &mut MatchState,
    made: &mut Vec<Decision>,
    robot: RobotId,
    seconds: f64,
    reason: RemovalReason,
) {
    let placed = made.iter().any(|decision| match decision {
        Decision::RobotPlaced { robot: placed, .. } => *placed == robot,
        _ => false,
    });
    if !placed && state.remove(robot, seconds.max(0.0), reason) {
        made.push(Decision::RobotRemoved { robot, reason });
    }
}

/// Whether a robot is in its own penalty area.
fn is_in_own_area(laws: &Laws, state: &MatchState, robot: RobotId, at: Vec2) -> bool {
    laws.pitch.own_penalty_area().contains(state.attacking(robot.team).turn(at))
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
    let seen = observation.on_field(state).map(move |(robot, at)| {
        let put = made.iter().rev().find_map(|decision| match decision {
            Decision::RobotPlaced { robot: placed, at } if *placed == robot => Some(at.position),
            _ => None,
        });
        put.unwrap_or(at)
    });
    let returned = made.iter().filter_map(|decision| match decision {
        Decision::RobotReturned { at, .. } => Some(at.position),
        _ => None,
    });
    seen.chain(returned)
}
