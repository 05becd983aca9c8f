//! Messages in words, for labels and tooltips.

use crate::app::view::format;
use crate::clock::Clock;
use crate::comms::radio::{Outcome, Transmission};

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
    let sent = format!("sent at {}", format::moment(message.sent, clock.dt));
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

#[cfg(test)]
mod tests {
    use super::super::samples::transmission;
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
}
