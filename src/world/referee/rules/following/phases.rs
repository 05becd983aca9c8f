//! The states of a box, and when a match that it has finished is over.

use bevy::prelude::Vec2;

use super::super::by_hand;
use super::ends::robots_placed;
use crate::world::gamecontroller::control::State;
use crate::world::gamecontroller::referee_box::{BoxView, GONE_AFTER};
use crate::world::referee::decision::{Decision, PlacementReason};
use crate::world::referee::followed::BoxStatement;
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::KickOffStyle;
use crate::world::referee::rules::observation::{Laws, Observation};
use crate::world::referee::state::MatchState;

pub(super) fn follow(
    word: &BoxStatement,
    laws: &Laws,
    observation: &Observation,
    dt: f64,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let next = if is_done(word, dt, state) { Some(Phase::Finished) } else { phase_of(word.view) };
    let Some(next) = next.filter(|next| *next != state.phase) else { return };
    state.phase = next;
    decisions.push(Decision::PhaseChanged(next));
    let by_hand = word.view.is_penalty_kick();
    match next {
        // The robots are put in their places as for any other penalty kick.
        Phase::Ready if by_hand => {}
        Phase::Ready => {
            decisions.push(Decision::BallPlaced { at: Vec2::ZERO, reason: PlacementReason::KickOff });
            if laws.book.kick_off == KickOffStyle::Carried {
                decisions.push(robots_placed(state));
            }
        }
        Phase::Set if !by_hand => by_hand::places_by_hand(laws, observation, 0.0, state, decisions),
        Phase::Finished => decisions.push(Decision::MatchFinished { score: state.score }),
        Phase::Set | Phase::Initial | Phase::Playing => {}
    }
}

/// The phase that a box's state is for us; none for states that we do not know. After `Finished` more may follow: another
/// half, extra time, or a whistle that is taken back.
fn phase_of(view: &BoxView) -> Option<Phase> {
    match view.state {
        State::Initial | State::Standby | State::Finished => Some(Phase::Initial),
        State::Ready => Some(Phase::Ready),
        State::Set => Some(Phase::Set),
        State::Playing => Some(Phase::Playing),
        State::Other(_) => None,
    }
}

/// Whether the box is done with the match: it has said for long enough that a match that may be over is finished, or has
/// said so and fallen silent.
fn is_done(word: &BoxStatement, dt: f64, state: &mut MatchState) -> bool {
    let Some(patience) = word.view.done_after() else {
        state.following.finished_for = 0.0;
        return false;
    };
    state.following.finished_for += dt;
    state.phase == Phase::Finished || word.silence > GONE_AFTER || state.following.finished_for > patience
}
