//! The requests of a branch, and what they are called.

use crate::game::requests::{BodyChange, RadioChange, Request, RobotChange};

/// A request with the tick that carried it out, or is to.
#[derive(Clone, Debug, PartialEq)]
pub struct LoggedRequest {
    /// The tick.
    pub tick: u64,
    /// What was asked for.
    pub request: Request,
    /// Whether a script asked for it; else a person did, a changed file, or somebody over a network.
    pub scripted: bool,
}

/// What a person has done by a request, in a few words; none for what no person does.
pub fn meddling(request: &Request) -> Option<String> {
    Some(match request {
        Request::TakeOver(robot) | Request::HandBack(robot) | Request::Steer { robot, .. } => {
            format!("{robot} driven")
        }
        Request::SetWeight { team, .. } => format!("a weight of {team}"),
        Request::Robot(robot, change) => robot_words(&robot.to_string(), change),
        Request::Radio(change) => radio_words(change),
        Request::Body(BodyChange::Ball { .. }) => "the ball carried".into(),
        Request::Body(BodyChange::Push { robot, .. }) => format!("{robot} pushed"),
        Request::Body(BodyChange::Kidnap { robot, .. }) => format!("{robot} carried"),
        Request::Light(_) => "the light".into(),
        Request::StirDice(_) => "other dice".into(),
        Request::ChangeStrategy { team, .. } => format!("the strategy of {team}"),
        Request::RefereeBox { .. } | Request::Remote(..) | Request::Datagram(_) => return None,
    })
}

fn robot_words(robot: &str, change: &RobotChange) -> String {
    match change {
        RobotChange::Fail(failure) => format!("{robot}: {failure:?}").to_lowercase(),
        RobotChange::Revive(_) => format!("{robot} revived"),
        RobotChange::Penalise => format!("{robot} penalised"),
        RobotChange::Swap(_) => format!("{robot} swaps"),
        RobotChange::Recalibrate(_) => format!("{robot} calibrated"),
        RobotChange::Mislead { .. } => format!("{robot} misled"),
        RobotChange::SetCamera(_) => format!("the camera of {robot}"),
        RobotChange::SetColours(_) => format!("the colours of {robot}"),
        RobotChange::PlayHere { .. } => format!("{robot} played here"),
    }
}

fn radio_words(change: &RadioChange) -> String {
    match change {
        RadioChange::Change(radio) => format!("radio {}", radio.name),
        RadioChange::ExtraLoss(_) => "extra loss".into(),
        RadioChange::ExtraDelay(_) => "extra delay".into(),
        RadioChange::Jam(_) => "the radio jammed".into(),
        RadioChange::CutOff(robot) | RadioChange::Reconnect(robot) => format!("{robot} cut off"),
        RadioChange::Part(_) | RadioChange::Heal => "a partition".into(),
        RadioChange::Fault(_) => "a fault rule".into(),
        RadioChange::Drop(_) => "a message dropped".into(),
        RadioChange::Deliver(_) => "a message delivered".into(),
    }
}

/// Whether it is about who drives, and how.
pub(super) fn is_of_a_seat(request: &Request) -> bool {
    matches!(request, Request::TakeOver(_) | Request::HandBack(_) | Request::Steer { .. })
}
