//! Messages in words, for labels and tooltips.

use crate::app::view::format;
use crate::clock::Clock;
use crate::comms::radio::{Transmission, TransmissionState};

/// All that there is to tell of a message.
pub fn story(message: &Transmission, clock: &Clock) -> String {
    let head = format!("{} from {} to {}", message.label(), message.packet.from, message.packet.to);
    let sent = format!("sent at {}", format::moment(message.sent, clock.dt));
    let late = if message.late { ", late" } else { "" };
    let doubled = if message.doubled { "\na second copy was under way too" } else { "" };
    let outcome = match message.state {
        TransmissionState::Arrived(tick) => {
            let took = 1000.0 * format::span(message.sent, tick, clock.dt);
            format!("arrived after {took:.0} ms{late}")
        }
        TransmissionState::InFlight(_) => format!("on its way{late}"),
        TransmissionState::Lost(loss) => format!("lost: {loss}"),
    };
    format!("{head}\n{sent}\n{outcome}{doubled}")
}

#[cfg(test)]
mod tests {
    use super::super::samples::transmitted;
    use super::*;
    use crate::comms::messages::{GoalSide, GoalieBehaviour, GoalieNews, TeamMessage};
    use crate::comms::radio::Loss;
    use crate::protocol::role_swap::{self, Holding};

    #[test]
    fn a_message_tells_its_kind_its_attempt_and_whether_it_arrived() {
        let clock = Clock::new(60.0);
        let ack = role_swap::Message::AckLock { sequence: 7, holds: Holding::Role(1) };
        let arrived = transmitted(&TeamMessage::RoleSwap(ack), 2, 1, 60, TransmissionState::Arrived(63));
        assert_eq!(arrived.label(), "ACKLOCK 7");
        let told = "ACKLOCK 7 from home 2 to home 1\nsent at 1.00 s\narrived after 50 ms";
        assert_eq!(story(&arrived, &clock), told);
        let (behaviour, side) = (GoalieBehaviour::Leaving, GoalSide::Left);
        let news = TeamMessage::Goalie(GoalieNews { time: 0, robot: 2, behaviour, side });
        let lost = transmitted(&news, 2, 1, 60, TransmissionState::Lost(Loss::Jammed));
        assert_eq!(lost.label(), "goalie");
        assert!(story(&lost, &clock).ends_with("lost: jammed"));
    }
}
