//! What a person wants a match to stop at, as data and in words. Pure.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::ids::RobotId;
use crate::world::referee::Decision;

/// The match stops after the tick in which this happens.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Breakpoint {
    /// Whether it stops the match.
    #[serde(default = "is_on")]
    pub on: bool,
    /// The robot that it is about; all of them without one.
    #[serde(default)]
    pub who: Option<RobotId>,
    /// What has to happen.
    pub at: StopAt,
}

/// What a match may stop at.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum StopAt {
    /// A robot comes to a state of a machine.
    State { machine: String, state: String },
    /// A robot takes a transition from one state to the state that it names; one with this condition, if there is one.
    Transition {
        machine: String,
        from: String,
        go: String,
        #[serde(default)]
        when: Option<String>,
    },
    /// A feature of a robot's strategy becomes true: one of the file's names, or the condition of a transition.
    Feature(String),
    /// Something happens to a message of a kind. Its sender and its receiver are meant.
    Message { kind: String, event: MessageEvent },
    /// The referee decides something; anything, without a kind.
    Whistle(Option<WhistleKind>),
}

/// What may happen to a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum MessageEvent {
    /// It is sent, whatever becomes of it.
    Sent,
    /// It reaches its receiver.
    Arrived,
    /// It gets lost as it is sent.
    Lost,
}

impl MessageEvent {
    pub const ALL: [MessageEvent; 3] = [MessageEvent::Sent, MessageEvent::Arrived, MessageEvent::Lost];

    pub fn words(self) -> &'static str {
        match self {
            MessageEvent::Sent => "is sent",
            MessageEvent::Arrived => "arrives",
            MessageEvent::Lost => "gets lost",
        }
    }
}

macro_rules! whistles {
    ($($pattern:pat => $kind:ident $words:literal;)*) => {
        /// A kind of decision of the referee.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        pub enum WhistleKind {
            $(#[doc = $words] $kind,)*
        }

        impl WhistleKind {
            pub const ALL: [WhistleKind; [$(WhistleKind::$kind),*].len()] = [$(WhistleKind::$kind),*];

            pub fn words(self) -> &'static str {
                match self { $(WhistleKind::$kind => $words),* }
            }

            pub fn of(decision: &Decision) -> WhistleKind {
                match decision { $($pattern => WhistleKind::$kind),* }
            }
        }
    };
}

whistles! {
    Decision::Goal { .. } => Goal "a goal";
    Decision::NoGoal { .. } => NoGoal "a goal that does not count";
    Decision::Untouched { .. } => Untouched "nobody touches the ball";
    Decision::BallPlaced { .. } => BallPlaced "the ball is placed";
    Decision::RobotsPlaced { .. } => RobotsPlaced "robots go to their places";
    Decision::RobotPlaced { .. } => RobotPlaced "a robot is put on its place";
    Decision::RobotWarned { .. } => RobotWarned "a robot is warned";
    Decision::RobotRemoved { .. } => RobotRemoved "a robot must leave";
    Decision::RobotReturned { .. } => RobotReturned "a robot returns";
    Decision::PhaseChanged(_) => PhaseChanged "another phase begins";
    Decision::HalfEnded { .. } => HalfEnded "a half ends";
    Decision::MatchFinished { .. } => MatchFinished "the match ends";
}

fn is_on() -> bool {
    true
}

impl Breakpoint {
    /// One that stops the match, for a robot or for all.
    pub fn new(who: Option<RobotId>, at: StopAt) -> Breakpoint {
        Breakpoint { on: true, who, at }
    }

    /// Whether it is about a robot, or about all.
    pub fn concerns(&self, robot: RobotId) -> bool {
        self.who.is_none_or(|who| who == robot)
    }
}

impl fmt::Display for StopAt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StopAt::State { machine, state } => write!(f, "comes to {state} ({machine})"),
            StopAt::Transition { machine, from, go, when: None } => {
                write!(f, "goes from {from} to {go} ({machine})")
            }
            StopAt::Transition { machine, from, go, when: Some(when) } => {
                write!(f, "goes from {from} to {go}, because {when} ({machine})")
            }
            StopAt::Feature(feature) => write!(f, "finds that {feature}"),
            StopAt::Message { kind, event } => write!(f, "{kind} {}", event.words()),
            StopAt::Whistle(None) => f.write_str("any whistle"),
            StopAt::Whistle(Some(kind)) => write!(f, "whistle: {}", kind.words()),
        }
    }
}

impl fmt::Display for Breakpoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let who = self.who.map(|robot| robot.to_string());
        match (&self.at, who) {
            (StopAt::Message { .. } | StopAt::Whistle(_), None) => write!(f, "{}", self.at),
            (StopAt::Message { .. }, Some(who)) => write!(f, "{}, from or to {who}", self.at),
            (StopAt::Whistle(_), Some(who)) => write!(f, "{}, about {who}", self.at),
            (_, who) => write!(f, "{} {}", who.as_deref().unwrap_or("any robot"), self.at),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    #[test]
    fn breakpoints_read_like_sentences() {
        let robot = Some(RobotId::new(Team::Home, 2));
        let message = StopAt::Message { kind: "ACKSWAP".into(), event: MessageEvent::Sent };
        let way = |when: Option<&str>| StopAt::Transition {
            machine: "halfback".into(),
            from: "track".into(),
            go: "acquire".into(),
            when: when.map(str::to_owned),
        };
        for (who, at, words) in [
            (None, way(None), "any robot goes from track to acquire (halfback)"),
            (
                robot,
                way(Some("ball_mine")),
                "home 2 goes from track to acquire, because ball_mine (halfback)",
            ),
            (robot, StopAt::Feature("stuck".into()), "home 2 finds that stuck"),
            (None, message.clone(), "ACKSWAP is sent"),
            (robot, message, "ACKSWAP is sent, from or to home 2"),
            (None, StopAt::Whistle(Some(WhistleKind::Goal)), "whistle: a goal"),
            (robot, StopAt::Whistle(None), "any whistle, about home 2"),
        ] {
            assert_eq!(Breakpoint::new(who, at).to_string(), words);
        }
    }
}
