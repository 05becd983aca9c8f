//! Whom each robot believed to have booked the ball during the last minute: looked up after each tick, for people to see.

use bevy::prelude::*;

use crate::app::view::state::{AfterTick, MatchBegun};
use crate::clock::Clock;
use crate::ids::{PlayerNumber, RobotId};
use crate::mind::teamwork::Booking;
use crate::protocol::b3p::B3p;
use crate::robot::Robot;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<BeliefHistory>().add_observer(forget_match).add_systems(AfterTick, look);
}

/// The spans of the last minute, in the order in which they began.
#[derive(Resource, Clone, Debug, Default)]
pub struct BeliefHistory {
    spans: Vec<Span>,
}

/// A time during which a robot believed one thing of the booking.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// The one that believed it.
    pub robot: RobotId,
    pub belief: Belief,
    /// The first tick.
    pub from: u64,
    /// The first tick after it; none if it lasts.
    pub until: Option<u64>,
}

/// That a robot has booked the ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Belief {
    pub booker: PlayerNumber,
    /// The robot itself has, and goes to the ball.
    pub goes: bool,
}

impl Belief {
    /// What a robot believes in a tick; nothing, if it takes the ball to be free.
    fn of(machine: &B3p, tick: u64) -> Option<Belief> {
        let known = machine.booking().filter(|_| machine.is_booked(tick))?;
        Some(Belief { booker: known.robot_booker, goes: machine.goes() })
    }
}

/// How long spans are kept, s.
const KEPT: f32 = 60.0;

impl BeliefHistory {
    /// Takes note of what a robot believes in a tick.
    fn note(&mut self, tick: u64, robot: RobotId, belief: Option<Belief>) {
        let open = self.spans.iter_mut().rev().find(|span| span.robot == robot && span.until.is_none());
        match open {
            Some(span) if Some(span.belief) == belief => return,
            Some(span) => span.until = Some(tick),
            None => {}
        }
        if let Some(belief) = belief {
            self.spans.push(Span { robot, belief, from: tick, until: None });
        }
    }

    /// Forgets what ended before a tick.
    fn forget(&mut self, before: u64) {
        self.spans.retain(|span| span.until.is_none_or(|until| until >= before));
    }

    pub fn spans(&self) -> impl Iterator<Item = &Span> {
        self.spans.iter()
    }
}

fn forget_match(_: On<MatchBegun>, mut history: ResMut<BeliefHistory>) {
    history.spans.clear();
}

fn look(clock: Res<Clock>, mut history: ResMut<BeliefHistory>, robots: Query<(&RobotId, &Robot, &Booking)>) {
    let tick = clock.tick.saturating_sub(1);
    for (id, robot, booking) in &robots {
        let belief = Belief::of(&booking.0, tick).filter(|_| !robot.condition.crashed);
        history.note(tick, *id, belief);
    }
    history.forget(tick.saturating_sub(clock.ticks(KEPT)));
}

#[cfg(test)]
mod tests {
    use super::super::samples::home;
    use super::*;

    const MATE: Option<Belief> = Some(Belief { booker: 1, goes: false });
    const OWN: Option<Belief> = Some(Belief { booker: 2, goes: true });

    #[test]
    fn a_belief_lasts_from_the_tick_that_shows_it_to_the_first_that_does_not() {
        let mut history = BeliefHistory::default();
        for (tick, belief) in [(1, None), (2, MATE), (3, MATE), (4, OWN), (6, None)] {
            history.note(tick, home(2), belief);
            history.note(tick, home(3), None);
        }
        let spans: Vec<_> = history.spans().map(|span| (Some(span.belief), span.from, span.until)).collect();
        assert_eq!(spans, [(MATE, 2, Some(4)), (OWN, 4, Some(6))]);
    }

    #[test]
    fn robots_have_beliefs_of_their_own() {
        let mut history = BeliefHistory::default();
        history.note(1, home(2), OWN);
        history.note(1, home(3), MATE);
        history.note(2, home(3), None);
        let open: Vec<_> = history.spans().map(|span| (span.robot, span.until)).collect();
        assert_eq!(open, [(home(2), None), (home(3), Some(2))]);
    }

    #[test]
    fn what_is_long_over_is_forgotten_and_what_lasts_is_not() {
        let mut history = BeliefHistory::default();
        history.note(1, home(2), MATE);
        history.note(5, home(2), None);
        history.note(5, home(3), MATE);
        history.forget(6);
        assert_eq!(history.spans().map(|span| span.robot).collect::<Vec<_>>(), [home(3)]);
    }
}
