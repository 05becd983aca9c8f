//! Messages and spans in words, for labels and tooltips.

use super::locks::{Hold, Span};
use crate::app::view::format;
use crate::clock::Clock;
use crate::comms::radio::{Outcome, Transmission};
use crate::ids::RobotId;

/// What stands at an arrow: the kind, and which attempt it belongs to.
pub fn label(message: &Transmission) -> String {
    match message.sequence {
        Some(sequence) => format!("{} {sequence}", message.kind),
        None => message.kind.to_string(),
    }
}

/// All that there is to tell of a message.
pub fn story(message: &Transmission, clock: &Clock) -> String {
    let head = format!("{} from {} to {}", label(message), message.from, message.to);
    let sent = format!("sent at {}", moment(message.sent, clock));
    let late = if message.late { ", late" } else { "" };
    let doubled = if message.doubled { "\na second copy was under way too" } else { "" };
    let outcome = match message.outcome {
        Outcome::Arrived(tick) => {
            let took = 1000.0 * format::span(message.sent, tick, clock.dt);
            format!("arrived after {took:.0} ms{late}")
        }
        Outcome::InFlight(_) => format!("on its way{late}"),
        Outcome::Lost(loss) => format!("lost: {loss}"),
    };
    format!("{head}\n{sent}\n{outcome}{doubled}")
}

/// All that there is to tell of a span.
pub fn story_of(span: &Span, clock: &Clock) -> String {
    let RobotId { team, .. } = span.robot;
    let head = match span.hold {
        Hold::Locked { by, sequence } => {
            format!("{} is locked by {team} {by}, attempt {sequence}", span.robot)
        }
        Hold::Attempt { sequence } => format!("{} tries to swap roles, attempt {sequence}", span.robot),
    };
    let lasted = match span.until {
        Some(until) => format!("for {:.0} ms", 1000.0 * format::span(span.from, until, clock.dt)),
        None => "and still so".into(),
    };
    format!("{head}\nfrom {}, {lasted}", moment(span.from, clock))
}

/// A tick as seconds of the match.
pub fn moment(tick: u64, clock: &Clock) -> String {
    format!("{:.2} s", tick as f64 * f64::from(clock.dt))
}

#[cfg(test)]
mod tests {
    use super::super::samples::{home, transmission};
    use super::*;
    use crate::comms::messages::MessageKind;
    use crate::comms::radio::Loss;

    #[test]
    fn a_message_tells_its_kind_its_attempt_and_its_fate() {
        let clock = Clock::new(60.0);
        let arrived = transmission(MessageKind::AckLock, 2, 1, 60, Outcome::Arrived(63));
        assert_eq!(label(&arrived), "ACKLOCK 7");
        let told = "ACKLOCK 7 from home 2 to home 1\nsent at 1.00 s\narrived after 50 ms";
        assert_eq!(story(&arrived, &clock), told);
        let lost = transmission(MessageKind::Goalie, 2, 1, 60, Outcome::Lost(Loss::Jammed));
        assert!(story(&lost, &clock).ends_with("lost: jammed"));
    }

    #[test]
    fn a_lock_tells_whose_it_is_and_how_long_it_lasted() {
        let hold = Hold::Locked { by: 1, sequence: 7 };
        let span = Span { robot: home(2), hold, from: 60, until: Some(90) };
        let told = "home 2 is locked by home 1, attempt 7\nfrom 1.00 s, for 500 ms";
        assert_eq!(story_of(&span, &Clock::new(60.0)), told);
    }
}
