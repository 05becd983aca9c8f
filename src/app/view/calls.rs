//! What has just happened, in words: the referee's last call for three seconds, all events of the match for the time line,
//! and what went wrong with a file until it is mended.

use bevy::prelude::*;

use super::FrameSystems;
use super::driver::AfterTick;
use super::session::MatchBegun;
use crate::clock::Clock;
use crate::world::referee::{Decision, MatchState, PlacementReason, RuleBook, Whistles};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Call>()
        .init_resource::<Events>()
        .init_resource::<Trouble>()
        .add_observer(forget)
        .add_systems(AfterTick, note_decisions)
        .add_systems(Update, let_call_pass.in_set(FrameSystems::Picture));
}

/// The sentence at the top, while it is news.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct Call {
    text: String,
    weight: u8,
    /// Seconds on the wall.
    left: f32,
}

/// What went wrong with a file, in one line.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct Trouble(pub Option<String>);

/// What there is to see on the time line, oldest first.
#[derive(Resource, Clone, Debug, Default)]
pub struct Events(pub Vec<Happening>);

/// A decision and when it fell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Happening {
    pub decision: Decision,
    /// Seconds of playing time since the match began.
    pub played: f64,
}

/// How long a call is shown, s.
const SHOWN: f32 = 3.0;
/// Weight of the news that a file was taken over.
const NEWS: u8 = 2;

impl Call {
    /// The sentence, if there is one.
    pub fn text(&self) -> Option<&str> {
        (self.left > 0.0).then_some(self.text.as_str())
    }

    /// Something that people did, and not the referee.
    pub fn tell(&mut self, text: String) {
        self.say(text, NEWS);
    }

    /// Shows a sentence unless a weightier one is shown.
    fn say(&mut self, text: String, weight: u8) {
        if self.left <= 0.0 || weight >= self.weight {
            *self = Call { text, weight, left: SHOWN };
        }
    }
}

/// How much a decision matters to a spectator; several fall at once, and one is shown.
fn weight(decision: &Decision) -> u8 {
    match decision {
        Decision::MatchFinished { .. } => 5,
        Decision::Goal { .. } => 4,
        Decision::HalfEnded { .. } | Decision::NoGoal { .. } => 3,
        Decision::RobotRemoved { .. } | Decision::RobotReturned { .. } | Decision::Untouched { .. } => 2,
        Decision::BallPlaced { reason: PlacementReason::NoProgress, .. } => 2,
        Decision::RobotsPlaced { .. } => 1,
        Decision::BallPlaced {
            reason: PlacementReason::ThrowIn { .. } | PlacementReason::SetPlay, ..
        } => 1,
        Decision::BallPlaced { reason: PlacementReason::KickOff, .. }
        | Decision::PhaseChanged(_)
        | Decision::RobotPlaced { .. } => 0,
    }
}

/// Whether a decision has a place on the time line.
fn is_event(decision: &Decision) -> bool {
    weight(decision) >= 2
}

/// Seconds of playing time since the match began.
pub fn played(state: &MatchState, book: &RuleBook) -> f64 {
    f64::from(state.half) * book.half_seconds() - state.time_left
}

fn forget(_: On<MatchBegun>, mut call: ResMut<Call>, mut events: ResMut<Events>) {
    *call = Call::default();
    events.0.clear();
}

fn note_decisions(
    (clock, whistles, state, book): (Res<Clock>, Res<Whistles>, Res<MatchState>, Res<RuleBook>),
    mut call: ResMut<Call>,
    mut events: ResMut<Events>,
) {
    let last_tick = clock.tick.saturating_sub(1);
    let fresh = whistles.heard.iter().rev().take_while(|(tick, _)| *tick == last_tick).count();
    for (_, decision) in whistles.heard.iter().skip(whistles.heard.len() - fresh) {
        call.say(decision.to_string(), weight(decision));
        if is_event(decision) {
            events.0.push(Happening { decision: *decision, played: played(&state, &book) });
        }
    }
}

fn let_call_pass(time: Res<Time<Real>>, mut call: ResMut<Call>) {
    if call.left > 0.0 {
        call.left -= time.delta_secs();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;
    use crate::world::referee::Phase;

    #[test]
    fn a_goal_is_not_talked_over_by_the_kick_off_that_follows() {
        let mut call = Call::default();
        for decision in [
            Decision::Goal { by: Team::Home, score: [1, 0] },
            Decision::RobotsPlaced { kick_off: Some(Team::Away) },
            Decision::PhaseChanged(Phase::Ready),
        ] {
            call.say(decision.to_string(), weight(&decision));
        }
        assert_eq!(call.text(), Some("Goal for home, 1:0"));
    }

    #[test]
    fn a_call_that_has_been_read_gives_way_to_anything() {
        let mut call = Call::default();
        call.say("Half time".into(), 3);
        call.left = 0.0;
        assert_eq!(call.text(), None);
        call.say("Play".into(), 0);
        assert_eq!(call.text(), Some("Play"));
    }

    #[test]
    fn playing_time_goes_on_through_the_second_half() {
        let book = RuleBook::default();
        let mut state = MatchState::new(Team::Home, &book);
        assert_eq!(played(&state, &book), 0.0);
        (state.half, state.time_left) = (2, 100.0);
        assert_eq!(played(&state, &book), 1100.0);
    }
}
