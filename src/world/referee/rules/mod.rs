//! The rules of play in the order in which the referee applies them.
//!
//! A rule is a plain function: it sees ball and robots, is told how much time has passed, changes the [`MatchState`] and
//! hands out [`Decision`]s. Nothing here knows of bodies, a clock or chance. Times are carried over from sample to
//! sample with what they exceed, so that matches go the same way at every step size, within one sample.

mod by_hand;
mod charging;
mod defenders;
mod flow;
mod following;
mod goal;
mod goalie_pushing;
mod holding;
mod illegal_defender;
mod leaving;
mod observation;
mod out;
mod progress;
mod pushing;
mod returns;
mod stuck;
mod touches;
mod walking;

#[cfg(test)]
mod properties;
#[cfg(test)]
mod table;
#[cfg(test)]
mod walkthrough;

#[cfg(test)]
pub(super) use table::{four_legged_book, read_book};

pub use following::follow;
use observation::placed_ball;
pub use observation::{Laws, Observation};

use super::decision::Decision;
use super::state::MatchState;

/// How a rule judges a sample: laws, what is seen, the seconds since the last sample, the state, and the decisions that
/// rules have made in this sample so far.
pub type RuleJudge = fn(&Laws, &Observation, f64, &mut MatchState, &mut Vec<Decision>);

/// One rule of play.
pub struct Rule {
    /// Its name for people.
    pub name: &'static str,
    /// The rule itself.
    pub judge: RuleJudge,
}

/// All rules, in order; which of them bite is for the [`RuleBook`](super::rulebook::RuleBook) to say:
///
/// 1. `walking` may cut the time of [`Phase::Ready`](super::phase::Phase) short, which `phases` counts.
/// 2. `phases` tells how much of the sample was played, which all others count.
/// 3. `places by hand` follows the order to stand still at once.
/// 4. `touches` knows who touched the ball, and when the kick-off is over, before `goal` and `out` ask.
/// 5. `goal` asks what `goalie pushing` will say in this sample. It comes before `clock`: a ball that crossed the line before time was up counts, and the rest of the sample is
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
    Rule { name: "goalie pushing", judge: goalie_pushing::goalie_pushing },
    Rule { name: "pushing", judge: pushing::pushing },
    Rule { name: "charging", judge: charging::charging },
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
