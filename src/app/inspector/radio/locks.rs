//! Locks and attempts to swap roles, over time.

use bevy::prelude::*;

use super::history::{self, History, HistorySpan};
use crate::app::view::state::AfterTick;
use crate::clock::Clock;
use crate::ids::RobotId;
use crate::mind::teamwork::Swapping;
use crate::protocol::role_swap::{AttemptPhase, Lock, Sequence};

pub(super) fn plugin(app: &mut App) {
    app.add_plugins((history::plugin::<Lock>, history::plugin::<SwapAttempt>)).add_systems(AfterTick, look);
}

/// A robot has initiated an attempt to swap roles, which is not over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SwapAttempt {
    pub sequence: Sequence,
}

/// All that there is to tell of a lock.
pub fn lock_story(span: &HistorySpan<Lock>, clock: &Clock) -> String {
    let HistorySpan { robot, what: Lock { by, sequence }, .. } = *span;
    span.story(&format!("{robot} is locked by {} {by}, attempt {sequence}", robot.team), clock)
}

/// All that there is to tell of an attempt.
pub fn attempt_story(span: &HistorySpan<SwapAttempt>, clock: &Clock) -> String {
    let head = format!("{} tries to swap roles, attempt {}", span.robot, span.what.sequence);
    span.story(&head, clock)
}

fn look(
    clock: Res<Clock>,
    mut locks: ResMut<History<Lock>>,
    mut attempts: ResMut<History<SwapAttempt>>,
    robots: Query<(&RobotId, &Swapping)>,
) {
    let tick = clock.tick.saturating_sub(1);
    for (robot, swapping) in &robots {
        locks.note(tick, *robot, swapping.machine.lock());
        let attempt = match swapping.machine.phase() {
            AttemptPhase::Idle => None,
            AttemptPhase::WaitingForLocks { sequence } | AttemptPhase::WaitingForAcks { sequence } => {
                Some(SwapAttempt { sequence })
            }
        };
        attempts.note(tick, *robot, attempt);
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::home;
    use super::*;

    #[test]
    fn a_lock_tells_whose_it_is_and_how_long_it_lasted() {
        let span =
            HistorySpan { robot: home(2), what: Lock { by: 1, sequence: 7 }, from: 60, until: Some(90) };
        let told = "home 2 is locked by home 1, attempt 7\nfrom 1.00 s, for 500 ms";
        assert_eq!(lock_story(&span, &Clock::new(60.0)), told);
    }

    #[test]
    fn an_attempt_tells_that_it_lasts() {
        let span = HistorySpan { robot: home(2), what: SwapAttempt { sequence: 7 }, from: 60, until: None };
        let told = "home 2 tries to swap roles, attempt 7\nfrom 1.00 s, and still so";
        assert_eq!(attempt_story(&span, &Clock::new(60.0)), told);
    }
}
