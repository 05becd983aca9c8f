//! Halves and ends are the box's: they may also go back, as in extra time, in a new match, or when a click is undone.

use super::super::by_hand;
use crate::geometry::Attacking;
use crate::world::gamecontroller::referee_box::BoxView;
use crate::world::referee::decision::Decision;
use crate::world::referee::phase::Phase;
use crate::world::referee::rulebook::KickOffStyle;
use crate::world::referee::rules::observation::{Laws, Observation};
use crate::world::referee::state::MatchState;

/// Takes half and ends over, and tells whether the ends have changed.
pub(super) fn follow(view: &BoxView, state: &mut MatchState, decisions: &mut Vec<Decision>) -> bool {
    let half = if view.first_half { 1 } else { 2 };
    if state.half == 1 && half == 2 {
        decisions.push(Decision::HalfEnded { half: 1 });
    }
    state.half = half;
    let home_attacks = if view.left == 0 { Attacking::East } else { Attacking::West };
    std::mem::replace(&mut state.home_attacks, home_attacks) != home_attacks
}

/// Puts the robots into their own halves when ends have changed, and when a match is joined in which they would stand
/// beside the pitch. Robots that walk to their places for a kick-off are also put there where a half begins.
pub(super) fn line_up(
    turned: bool,
    before: Phase,
    laws: &Laws,
    observation: &Observation,
    state: &mut MatchState,
    decisions: &mut Vec<Decision>,
) {
    let ready = decisions.contains(&Decision::PhaseChanged(Phase::Ready));
    let half_begins = ready && before == Phase::Initial;
    let joined = before == Phase::Initial && matches!(state.phase, Phase::Set | Phase::Playing);
    let due = turned || half_begins || (joined && !state.following.lined_up);
    if due && state.phase != Phase::Finished {
        match laws.book.kick_off {
            KickOffStyle::Carried if ready => {}
            KickOffStyle::Carried => decisions.push(robots_placed(state)),
            KickOffStyle::Walked => by_hand::line_up(laws, observation, state, decisions),
        }
    }
    state.following.lined_up |= due;
}

/// All robots are put on their places for the kick-off.
pub(super) fn robots_placed(state: &MatchState) -> Decision {
    Decision::RobotsPlaced { kick_off: Some(state.kick_off).filter(|team| state.kicks_off(*team)) }
}
