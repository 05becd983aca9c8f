//! Who was locked, and who tried to swap roles, during the last minute: looked up after each tick, for people to see.

use bevy::prelude::*;

use crate::app::view::state::AfterTick;
use crate::clock::Clock;
use crate::ids::{PlayerNumber, RobotId};
use crate::mind::teamwork::Swapping;
use crate::protocol::role_swap::{Phase, Sequence};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<LockHistory>().add_systems(AfterTick, look);
}

/// The spans of the last minute, in the order in which they began.
#[derive(Resource, Clone, Debug, Default)]
pub struct LockHistory {
    spans: Vec<Span>,
    last_tick: u64,
}

/// A time during which a robot was taken up with a swap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    pub robot: RobotId,
    pub hold: Hold,
    /// The first tick.
    pub from: u64,
    /// The first tick after it; none if it lasts.
    pub until: Option<u64>,
}

/// What a robot is taken up with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// A team mate has its lock.
    Locked { by: PlayerNumber, sequence: Sequence },
    /// It has initiated an attempt, which is not over.
    Attempt { sequence: Sequence },
}

/// How long spans are kept, s.
const KEPT: f32 = 60.0;

impl Hold {
    fn is_lock(self) -> bool {
        matches!(self, Hold::Locked { .. })
    }
}

impl LockHistory {
    /// Forgets everything if time has gone back: another match.
    fn begin(&mut self, tick: u64) {
        if tick < self.last_tick {
            self.spans.clear();
        }
        self.last_tick = tick;
    }

    /// Takes note of a robot in a tick: its lock and its attempt.
    fn note(&mut self, tick: u64, robot: RobotId, lock: Option<Hold>, attempt: Option<Hold>) {
        for (is_lock, hold) in [(true, lock), (false, attempt)] {
            let open = |span: &&mut Span| {
                span.robot == robot && span.until.is_none() && span.hold.is_lock() == is_lock
            };
            if let Some(span) = self.spans.iter_mut().rev().find(open) {
                if Some(span.hold) == hold {
                    continue;
                }
                span.until = Some(tick);
            }
            if let Some(hold) = hold {
                self.spans.push(Span { robot, hold, from: tick, until: None });
            }
        }
    }

    fn forget(&mut self, before: u64) {
        self.spans.retain(|span| span.until.is_none_or(|until| until >= before));
    }

    pub fn spans(&self) -> impl Iterator<Item = &Span> {
        self.spans.iter()
    }
}

fn look(clock: Res<Clock>, mut history: ResMut<LockHistory>, robots: Query<(&RobotId, &Swapping)>) {
    let tick = clock.tick.saturating_sub(1);
    history.begin(tick);
    for (robot, swapping) in &robots {
        let lock = swapping.machine.lock();
        let lock = lock.map(|lock| Hold::Locked { by: lock.by, sequence: lock.sequence });
        let attempt = match swapping.machine.phase() {
            Phase::Idle => None,
            Phase::WaitingForLocks { sequence } | Phase::WaitingForAcks { sequence } => {
                Some(Hold::Attempt { sequence })
            }
        };
        history.note(tick, *robot, lock, attempt);
    }
    history.forget(tick.saturating_sub(clock.ticks(KEPT)));
}

#[cfg(test)]
mod tests {
    use super::super::samples::home;
    use super::*;

    const LOCKED: Option<Hold> = Some(Hold::Locked { by: 1, sequence: 7 });

    #[test]
    fn a_lock_lasts_from_the_tick_that_shows_it_to_the_first_that_does_not() {
        let mut history = LockHistory::default();
        for (tick, lock) in [(1, None), (2, LOCKED), (3, LOCKED), (4, None)] {
            history.note(tick, home(2), lock, None);
            history.note(tick, home(3), None, None);
        }
        let hold = LOCKED.unwrap();
        assert_eq!(history.spans, [Span { robot: home(2), hold, from: 2, until: Some(4) }]);
    }

    #[test]
    fn a_lock_that_changes_hands_within_a_tick_is_two_spans() {
        let mut history = LockHistory::default();
        let other = Some(Hold::Locked { by: 3, sequence: 8 });
        history.note(1, home(2), LOCKED, None);
        history.note(2, home(2), other, None);
        let ends: Vec<_> = history.spans().map(|span| (span.from, span.until)).collect();
        assert_eq!(ends, [(1, Some(2)), (2, None)]);
    }

    #[test]
    fn an_initiator_may_be_locked_as_well() {
        let mut history = LockHistory::default();
        let attempt = Some(Hold::Attempt { sequence: 7 });
        history.note(1, home(2), LOCKED, attempt);
        history.note(2, home(2), None, attempt);
        assert_eq!(history.spans.len(), 2);
        assert_eq!(history.spans[0].until, Some(2));
        assert_eq!(history.spans[1].until, None);
    }

    #[test]
    fn what_is_long_over_is_forgotten_and_another_match_begins_with_nothing() {
        let mut history = LockHistory::default();
        history.begin(10);
        history.note(10, home(2), LOCKED, None);
        history.note(12, home(2), None, None);
        history.note(12, home(3), LOCKED, None);
        history.forget(13);
        assert_eq!(history.spans().map(|span| span.robot).collect::<Vec<_>>(), [home(3)]);
        history.begin(0);
        assert_eq!(history.spans().count(), 0);
    }
}
