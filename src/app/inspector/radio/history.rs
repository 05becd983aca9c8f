//! What robots were in, or believed, during the last minute, span by span: looked up after each tick, for people to see.

use bevy::prelude::*;

use crate::app::view::format;
use crate::app::view::state::{AfterTick, MatchBegun};
use crate::clock::Clock;
use crate::ids::RobotId;
use crate::lab::rewind::GoesBack;

/// Keeps a history of one kind of thing.
pub(super) fn plugin<T: HistoryValue>(app: &mut App) {
    app.init_resource::<History<T>>().goes_back::<History<T>>();
    app.add_observer(forget_match::<T>).add_systems(AfterTick, forget_old::<T>);
}

/// What a robot may be in for a while.
pub trait HistoryValue: Copy + PartialEq + Send + Sync + 'static {}

impl<T: Copy + PartialEq + Send + Sync + 'static> HistoryValue for T {}

/// The spans of the last minute, in the order in which they began.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct History<T: HistoryValue> {
    spans: Vec<HistorySpan<T>>,
}

/// A time during which one thing held of a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HistorySpan<T> {
    pub robot: RobotId,
    pub what: T,
    /// The first tick.
    pub from: u64,
    /// The first tick after it; none if it lasts.
    pub until: Option<u64>,
}

/// How long spans are kept, s.
const KEPT: f32 = 60.0;

impl<T: HistoryValue> Default for History<T> {
    fn default() -> History<T> {
        History { spans: Vec::new() }
    }
}

impl<T: HistoryValue> History<T> {
    /// Takes note of what holds of a robot in a tick.
    pub fn note(&mut self, tick: u64, robot: RobotId, what: Option<T>) {
        let open = self.spans.iter_mut().rev().find(|span| span.robot == robot && span.until.is_none());
        match open {
            Some(span) if Some(span.what) == what => return,
            Some(span) => span.until = Some(tick),
            None => {}
        }
        if let Some(what) = what {
            self.spans.push(HistorySpan { robot, what, from: tick, until: None });
        }
    }

    /// Forgets what ended before a tick.
    fn forget(&mut self, before: u64) {
        self.spans.retain(|span| span.until.is_none_or(|until| until >= before));
    }

    pub fn spans(&self) -> impl Iterator<Item = &HistorySpan<T>> {
        self.spans.iter()
    }
}

impl<T> HistorySpan<T> {
    /// All that there is to tell of it, below what it is.
    pub fn story(&self, head: &str, clock: &Clock) -> String {
        let lasted = match self.until.map(|until| format::span(self.from, until, clock.dt)) {
            None => "and still so".into(),
            Some(seconds) if seconds < 1.0 => format!("for {:.0} ms", 1000.0 * seconds),
            Some(seconds) => format!("for {}", format::seconds(seconds)),
        };
        format!("{head}\nfrom {}, {lasted}", format::moment(self.from, clock.dt))
    }
}

fn forget_match<T: HistoryValue>(_: On<MatchBegun>, mut history: ResMut<History<T>>) {
    history.spans.clear();
}

fn forget_old<T: HistoryValue>(clock: Res<Clock>, mut history: ResMut<History<T>>) {
    history.forget(clock.tick.saturating_sub(1 + clock.ticks(KEPT)));
}

#[cfg(test)]
mod tests {
    use super::super::samples::home;
    use super::*;

    #[test]
    fn a_span_lasts_from_the_tick_that_shows_it_to_the_first_that_does_not() {
        let mut history = History::default();
        for (tick, what) in [(1, None), (2, Some('a')), (3, Some('a')), (4, Some('b')), (6, None)] {
            history.note(tick, home(2), what);
            history.note(tick, home(3), None);
        }
        let spans: Vec<_> = history.spans().map(|span| (span.what, span.from, span.until)).collect();
        assert_eq!(spans, [('a', 2, Some(4)), ('b', 4, Some(6))]);
    }

    #[test]
    fn robots_have_spans_of_their_own() {
        let mut history = History::default();
        history.note(1, home(2), Some('a'));
        history.note(1, home(3), Some('b'));
        history.note(2, home(3), None);
        let open: Vec<_> = history.spans().map(|span| (span.robot, span.until)).collect();
        assert_eq!(open, [(home(2), None), (home(3), Some(2))]);
    }

    #[test]
    fn what_is_long_over_is_forgotten_what_lasts_is_not_and_another_match_begins_with_nothing() {
        let mut app = App::new();
        app.init_schedule(AfterTick).add_plugins(plugin::<char>);
        let mut clock = Clock::new(60.0);
        let mut history = app.world_mut().resource_mut::<History<char>>();
        history.note(1, home(2), Some('a'));
        history.note(5, home(2), None);
        history.note(5, home(3), Some('a'));
        for (tick, robots) in [(5 + clock.ticks(KEPT), 2), (7 + clock.ticks(KEPT), 1)] {
            clock.tick = tick;
            app.insert_resource(clock);
            app.world_mut().run_schedule(AfterTick);
            assert_eq!(app.world().resource::<History<char>>().spans().count(), robots);
        }
        app.world_mut().trigger(MatchBegun);
        assert_eq!(*app.world().resource::<History<char>>(), History::default());
    }

    #[test]
    fn a_span_tells_when_it_began_and_how_long_it_lasted() {
        let span = |until| HistorySpan { robot: home(2), what: 'a', from: 60, until };
        let told = |until| span(until).story("home 2 is locked", &Clock::new(60.0));
        assert_eq!(told(Some(90)), "home 2 is locked\nfrom 1.00 s, for 500 ms");
        assert_eq!(told(Some(150)), "home 2 is locked\nfrom 1.00 s, for 1.5 s");
        assert_eq!(told(None), "home 2 is locked\nfrom 1.00 s, and still so");
    }
}
