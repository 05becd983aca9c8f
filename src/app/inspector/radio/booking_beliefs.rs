//! Whom each robot believed to have booked the ball.

use bevy::prelude::*;

use super::history::{self, History, HistorySpan};
use crate::app::view::state::AfterTick;
use crate::clock::Clock;
use crate::ids::{PlayerNumber, RobotId};
use crate::mind::teamwork::Booking;
use crate::protocol::b3p::B3p;
use crate::robot::Robot;

pub(super) fn plugin(app: &mut App) {
    app.add_plugins(history::plugin::<BookingBelief>).add_systems(AfterTick, look);
}

/// That a robot has booked the ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BookingBelief {
    pub booker: PlayerNumber,
    /// The robot itself has, and goes to the ball.
    pub goes: bool,
}

impl BookingBelief {
    /// What a robot believes in a tick; nothing, if it takes the ball to be free.
    fn of(machine: &B3p, tick: u64) -> Option<BookingBelief> {
        let known = machine.booking().filter(|_| machine.is_booked(tick))?;
        Some(BookingBelief { booker: known.robot_booker, goes: machine.goes() })
    }
}

/// All that there is to tell of a belief.
pub fn story(span: &HistorySpan<BookingBelief>, clock: &Clock) -> String {
    let HistorySpan { robot, what: BookingBelief { booker, goes }, .. } = *span;
    let head = match (goes, booker == robot.number) {
        (true, _) => format!("{robot} has booked the ball and goes to it"),
        (false, true) => format!("{robot} has booked the ball but does not see it"),
        (false, false) => format!("{robot} believes that {booker} has booked the ball"),
    };
    span.story(&head, clock)
}

fn look(
    clock: Res<Clock>,
    mut history: ResMut<History<BookingBelief>>,
    robots: Query<(&RobotId, &Robot, &Booking)>,
) {
    let tick = clock.tick.saturating_sub(1);
    for (id, robot, booking) in &robots {
        let belief = BookingBelief::of(&booking.0, tick).filter(|_| !robot.health.crashed);
        history.note(tick, *id, belief);
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::home;
    use super::*;

    #[test]
    fn a_span_tells_who_believed_what_and_how_long() {
        let clock = Clock::new(60.0);
        let span = |booker, goes, until| {
            let what = BookingBelief { booker, goes };
            story(&HistorySpan { robot: home(2), what, from: 60, until }, &clock)
        };
        let told = "home 2 believes that 1 has booked the ball\nfrom 1.00 s, for 500 ms";
        assert_eq!(span(1, false, Some(90)), told);
        assert!(span(2, true, None).ends_with("goes to it\nfrom 1.00 s, and still so"));
        assert!(span(2, false, None).contains("does not see it"));
    }
}
