//! What the referee decides becomes an announcement for three seconds, and an event on the time line if it matters.

use bevy::prelude::*;

use crate::app::view::state::{
    AfterTick, Announcement, FrameSystems, MatchBegun, TimelineEvent, TimelineEvents,
};
use crate::clock::Clock;
use crate::world::referee::{Decision, MatchState, PlacementReason, RuleBook, Whistles};

pub(super) fn plugin(app: &mut App) {
    app.add_observer(forget)
        .add_systems(AfterTick, note_decisions)
        .add_systems(Update, let_announcement_pass.in_set(FrameSystems::Picture));
}

/// How much a decision matters to a spectator; several fall at once, and one is shown.
fn weight(decision: &Decision) -> u8 {
    match decision {
        Decision::MatchFinished { .. } => 5,
        Decision::Goal { .. } => 4,
        Decision::HalfEnded { .. } | Decision::NoGoal { .. } => 3,
        Decision::RobotWarned { .. }
        | Decision::RobotRemoved { .. }
        | Decision::RobotReturned { .. }
        | Decision::Untouched { .. } => 2,
        Decision::BallPlaced { reason: PlacementReason::NoProgress, .. } => 2,
        Decision::RobotsPlaced { .. } => 1,
        Decision::BallPlaced {
            reason: PlacementReason::ThrowIn { .. } | PlacementReason::SetPlay | PlacementReason::Foul,
            ..
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

fn forget(_: On<MatchBegun>, mut announcement: ResMut<Announcement>, mut events: ResMut<TimelineEvents>) {
    *announcement = Announcement::default();
    events.0.clear();
}

fn note_decisions(
    (clock, whistles, state, book): (Res<Clock>, Res<Whistles>, Res<MatchState>, Res<RuleBook>),
    mut announcement: ResMut<Announcement>,
    mut events: ResMut<TimelineEvents>,
) {
    let last_tick = clock.tick.saturating_sub(1);
    let fresh = whistles.heard.iter().rev().take_while(|(tick, _)| *tick == last_tick).count();
    for (_, decision) in whistles.heard.iter().skip(whistles.heard.len() - fresh) {
        announcement.say(decision.to_string(), weight(decision));
        if is_event(decision) {
            events.0.push(TimelineEvent { decision: *decision, played: played(&state, &book) });
        }
    }
}

fn let_announcement_pass(time: Res<Time<Real>>, mut announcement: ResMut<Announcement>) {
    announcement.pass(time.delta_secs());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;
    use crate::world::referee::Phase;

    #[test]
    fn a_goal_is_not_talked_over_by_the_kick_off_that_follows() {
        let mut announcement = Announcement::default();
        for decision in [
            Decision::Goal { by: Team::Home, score: [1, 0] },
            Decision::RobotsPlaced { kick_off: Some(Team::Away) },
            Decision::PhaseChanged(Phase::Ready),
        ] {
            announcement.say(decision.to_string(), weight(&decision));
        }
        assert_eq!(announcement.text(), Some("Goal for home, 1:0"));
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
