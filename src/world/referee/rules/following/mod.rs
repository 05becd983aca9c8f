//! Following a referee box: it decides about states, halves and ends, score, clock, set plays and penalties, and our own
//! referee stands back. What is left to us is what the helpers around a pitch do: they carry robots, put a ball that is
//! out back, and put it on its spot for a set play.
//!
//! A box that is lost stops the play until one is heard again.

mod ends;
mod penalties;
mod penalty_kick;
mod phases;
mod set_plays;

#[cfg(test)]
mod tests;

use super::{out, touches};
use crate::ids::Team;
use crate::world::gamecontroller::referee_box::BoxView;
use crate::world::referee::decision::Decision;
use crate::world::referee::followed::BoxStatement;
use crate::world::referee::phase::Phase;
use crate::world::referee::rules::observation::{Laws, Observation, placed_ball};
use crate::world::referee::state::MatchState;

/// Does what a referee box says, `dt` seconds after the last look.
pub fn follow(
    word: &BoxStatement,
    laws: &Laws,
    observation: &Observation,
    dt: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let view = word.view;
    state.restraints.stopped = view.stopped || word.is_lost;
    let turned = ends::follow(view, state, decisions);
    count_goals(view, state, decisions);
    if let Some(kicking) = view.kicking_team() {
        state.kick_off = kicking;
    }
    state.dropped_ball = view.kicking.is_none();
    state.time_left = f64::from(view.seconds_left);
    let before = state.phase;
    phases::follow(word, laws, observation, dt, state, decisions);
    ends::line_up(turned, before, laws, observation, state, decisions);
    let in_play = state.phase == Phase::Playing && !state.restraints.stopped;
    state.played = if in_play { dt } else { 0.0 };
    penalties::follow(view, laws, observation, state, decisions);
    penalty_kick::follow(view, laws, observation, state, decisions);
    set_plays::follow(view, laws, observation, state, decisions);
    touches::touches(laws, observation, dt, state, decisions);
    out::out(laws, observation, dt, state, decisions);
    state.seen_ball = Some(placed_ball(decisions).unwrap_or(observation.ball));
}

/// A score may also be taken back; then nobody is told.
fn count_goals(view: &BoxView, state: &mut MatchState, decisions: &mut Vec<Decision>) {
    let before = state.score;
    state.score = view.score;
    let scored = Team::BOTH.into_iter().filter(|team| view.score[team.index()] > before[team.index()]);
    decisions.extend(scored.map(|by| Decision::Goal { by, score: view.score }));
}
