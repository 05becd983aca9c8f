//! What happened in one tick, as far as breakpoints may be about it, and which breakpoint it hits. Pure.

use super::breakpoint::{Breakpoint, MessageEvent, StopAt, WhistleKind};
use crate::ids::RobotId;

/// What happened in a tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TickNews {
    /// By robot.
    pub entered: Vec<EnteredState>,
    pub taken: Vec<TakenWay>,
    /// Features that have become true.
    pub features: Vec<(RobotId, String)>,
    pub messages: Vec<MessageNews>,
    pub whistles: Vec<WhistleNews>,
}

/// A robot has come to a state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EnteredState {
    pub robot: RobotId,
    pub machine: String,
    pub state: String,
    /// Why, if it is known.
    pub because: Option<String>,
}

/// A robot has taken a transition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TakenWay {
    pub robot: RobotId,
    pub machine: String,
    /// The state that has the transition.
    pub from: String,
    /// The state that it names.
    pub go: String,
    pub when: String,
}

/// Something has happened to a message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MessageNews {
    pub kind: String,
    pub event: MessageEvent,
    pub from: RobotId,
    pub to: RobotId,
}

/// The referee has decided something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WhistleNews {
    pub kind: WhistleKind,
    /// The robot that it is about.
    pub robot: Option<RobotId>,
    /// What the referee said.
    pub sentence: String,
}

impl Breakpoint {
    /// Whether a moment hits it: then what happened, in words.
    pub fn hit(&self, moment: &TickNews) -> Option<String> {
        if !self.on {
            return None;
        }
        let is_meant = |robot: RobotId| self.who.is_none_or(|who| who == robot);
        match &self.at {
            StopAt::State { machine, state } => {
                let mut found = moment.entered.iter().filter(|entered| is_meant(entered.robot));
                let entered = found.find(|entered| (&entered.machine, &entered.state) == (machine, state))?;
                let because = entered.because.as_ref().map(|because| format!(", because {because}"));
                Some(format!("{} has come to {state}{}", entered.robot, because.unwrap_or_default()))
            }
            StopAt::Transition { machine, from, go, when } => {
                let mut found = moment.taken.iter().filter(|taken| is_meant(taken.robot));
                let taken = found.find(|taken| {
                    (&taken.machine, &taken.from, &taken.go) == (machine, from, go)
                        && when.as_ref().is_none_or(|when| *when == taken.when)
                })?;
                Some(format!("{} went from {from} to {go}, because {}", taken.robot, taken.when))
            }
            StopAt::Feature(feature) => {
                let mut found = moment.features.iter().filter(|(robot, _)| is_meant(*robot));
                let (robot, _) = found.find(|(_, known)| known == feature)?;
                Some(format!("{robot} finds that {feature}"))
            }
            StopAt::Message { kind, event } => {
                let mut found =
                    moment.messages.iter().filter(|news| is_meant(news.from) || is_meant(news.to));
                let news = found.find(|news| (&news.kind, &news.event) == (kind, event))?;
                Some(format!("{kind} from {} to {} {}", news.from, news.to, event.words()))
            }
            StopAt::Whistle(kind) => {
                let is_about = |news: &WhistleNews| self.who.is_none() || news.robot == self.who;
                let mut found = moment.whistles.iter().filter(|news| is_about(news));
                let news = found.find(|news| kind.is_none_or(|kind| kind == news.kind))?;
                Some(format!("the referee: {}", news.sentence))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    const ONE: RobotId = RobotId::new(Team::Home, 1);
    const TWO: RobotId = RobotId::new(Team::Home, 2);

    fn moment() -> TickNews {
        let text = str::to_owned;
        let (machine, when) = (text("halfback"), text("ball_mine"));
        TickNews {
            entered: vec![EnteredState {
                robot: TWO,
                machine: machine.clone(),
                state: text("acquire"),
                because: Some(when.clone()),
            }],
            taken: vec![TakenWay { robot: TWO, machine, from: text("track"), go: text("acquire"), when }],
            features: vec![(TWO, text("stuck"))],
            messages: vec![MessageNews { kind: text("LOCK"), event: MessageEvent::Sent, from: TWO, to: ONE }],
            whistles: vec![WhistleNews {
                kind: WhistleKind::RobotRemoved,
                robot: Some(TWO),
                sentence: text("Home 2 must leave: pushing"),
            }],
        }
    }

    fn hits(who: Option<RobotId>, at: &StopAt) -> Option<String> {
        Breakpoint::new(who, at.clone()).hit(&moment())
    }

    fn way(go: &str, when: Option<&str>) -> StopAt {
        let [machine, from] = ["halfback", "track"].map(str::to_owned);
        StopAt::Transition { machine, from, go: go.into(), when: when.map(str::to_owned) }
    }

    fn state(machine: &str) -> StopAt {
        StopAt::State { machine: machine.into(), state: "acquire".into() }
    }

    fn message(kind: &str, event: MessageEvent) -> StopAt {
        StopAt::Message { kind: kind.into(), event }
    }

    #[test]
    fn what_happened_to_the_robot_hits_and_says_why() {
        for (at, told) in [
            (state("halfback"), "home 2 has come to acquire, because ball_mine"),
            (way("acquire", None), "home 2 went from track to acquire, because ball_mine"),
            (way("acquire", Some("ball_mine")), "home 2 went from track to acquire, because ball_mine"),
            (StopAt::Feature("stuck".into()), "home 2 finds that stuck"),
            (message("LOCK", MessageEvent::Sent), "LOCK from home 2 to home 1 is sent"),
            (StopAt::Whistle(None), "the referee: Home 2 must leave: pushing"),
            (StopAt::Whistle(Some(WhistleKind::RobotRemoved)), "the referee: Home 2 must leave: pushing"),
        ] {
            assert_eq!(hits(None, &at).as_deref(), Some(told));
            assert_eq!(hits(Some(TWO), &at).as_deref(), Some(told));
            let off = Breakpoint { on: false, ..Breakpoint::new(None, at.clone()) };
            assert_eq!(off.hit(&moment()), None);
            assert_eq!(Breakpoint::new(None, at).hit(&TickNews::default()), None);
        }
    }

    #[test]
    fn what_happened_to_another_robot_or_otherwise_does_not_hit() {
        let other =
            [state("halfback"), way("acquire", None), StopAt::Feature("stuck".into()), StopAt::Whistle(None)];
        for at in other {
            assert_eq!(hits(Some(ONE), &at), None, "{at}");
        }
        assert!(
            hits(Some(ONE), &message("LOCK", MessageEvent::Sent)).is_some(),
            "its receiver is meant, too"
        );
        for at in [
            state("forward"),
            way("search", None),
            way("acquire", Some("stuck")),
            StopAt::Feature("ball_lost".into()),
            message("LOCK", MessageEvent::Arrived),
            message("SWAP", MessageEvent::Sent),
            StopAt::Whistle(Some(WhistleKind::Goal)),
        ] {
            assert_eq!(hits(None, &at), None, "{at}");
        }
    }
}
