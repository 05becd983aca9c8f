//! Tells a counterexample in plain sentences.

use stateright::{Checker, Model};
use touchline::ids::PlayerNumber;
use touchline::protocol::role_swap::{AttemptPhase, Configuration, Message, Order, RoleIndex, Timer};

use super::checks::Check;
use super::model::{Action, State};
use super::team::Team;

/// The shortest way to break a check.
pub struct Story {
    pub sentences: Vec<String>,
    pub end: State,
}

impl Story {
    /// The story of a shortest counterexample, which has this many steps: with one less the check holds. In a full run the
    /// checker's own discovery is seldom the shortest.
    pub fn of(team: Team, check: Check, steps: usize) -> Story {
        let checks = team.checks.iter().copied().chain([check]).collect();
        let team = Team { checks, ..team };
        // The first state has depth 1, and those at the target depth are not looked at any more.
        let find = |steps| {
            team.clone().checker().target_max_depth(steps + 2).spawn_bfs().join().discovery(check.name())
        };
        println!("Not so: {}", check.name());
        let path = find(steps).unwrap_or_else(|| panic!("{} is broken in {steps} steps", check.name()));
        let story = Story::told(&path.into_vec());
        assert!(find(steps - 1).is_none(), "a shorter story");
        assert_eq!(story.len(), steps);
        story
    }

    /// Tells a path of states, each with the step that leaves it.
    pub fn told(path: &[(State, Option<Action>)]) -> Story {
        let steps = path.windows(2).map(|pair| (&pair[0], &pair[1].0));
        let sentences: Vec<String> = steps
            .filter_map(|((before, action), after)| Some(sentence(before, action.as_ref()?, after)))
            .collect();
        let end = path.last().map(|(state, _)| state.clone()).expect("a path has states");
        for (step, sentence) in sentences.iter().enumerate() {
            println!("{:3}. {sentence}", step + 1);
        }
        let roles = end.robots.iter().zip(0..).map(|(robot, number)| {
            let down = if robot.up { "" } else { ", down" };
            format!("R{number} {}{down}", name(robot.machine.role()))
        });
        println!("     In the end: {}.", roles.collect::<Vec<_>>().join("; "));
        Story { sentences, end }
    }

    pub fn len(&self) -> usize {
        self.sentences.len()
    }

    pub fn roles(&self) -> Vec<RoleIndex> {
        self.end.robots.iter().map(|robot| robot.machine.role()).collect()
    }

    /// Whether a sentence contains these words.
    pub fn tells(&self, words: &str) -> bool {
        self.sentences.iter().any(|sentence| sentence.contains(words))
    }
}

fn name(role: RoleIndex) -> &'static str {
    ["halfback", "floater", "forward", "goalie"].get(usize::from(role)).unwrap_or(&"nothing")
}

fn sentence(before: &State, action: &Action, after: &State) -> String {
    let message = |place: &usize| {
        let envelope = &before.network.in_flight()[*place];
        let what = describe(&envelope.message, envelope.roll_back);
        (what, envelope.from, envelope.to)
    };
    match action {
        Action::Initiate { robot, asked, .. } => {
            let asked: Vec<String> = asked.iter().map(|robot| format!("R{robot}")).collect();
            let asked = if asked.is_empty() { "nobody".to_owned() } else { asked.join(" and ") };
            format!(
                "R{robot} decides to swap roles and asks {asked} for locks{}",
                outcome(before, after, *robot)
            )
        }
        Action::Deliver(place) | Action::DeliverAndKeep(place) => {
            let (what, from, to) = message(place);
            let copy =
                if matches!(action, Action::DeliverAndKeep(_)) { " (and will come again)" } else { "" };
            let outcome = match outcome(before, after, to) {
                _ if !before.robot(to).up => ", which is down".to_owned(),
                nothing if nothing.is_empty() => ", which ignores it".to_owned(),
                outcome => outcome,
            };
            format!("{what} from R{from} reaches R{to}{copy}{outcome}")
        }
        Action::Lose(place) => {
            let (what, from, to) = message(place);
            format!("the radio loses {what} from R{from} to R{to}")
        }
        Action::TimeOut(robot, timer) => {
            let timer = match timer {
                Timer::Lock => "lock timer",
                Timer::Locks => "timer for the locks",
                Timer::Acks => "timer for the acknowledgements",
            };
            format!("R{robot}'s {timer} runs out{}", outcome(before, after, *robot))
        }
        Action::Hear(robot, news) => {
            let Configuration { epoch, initiator, .. } = news;
            let outcome = outcome(before, after, *robot);
            format!("R{robot} hears of configuration {epoch}.{initiator} in a position message{outcome}")
        }
        Action::Crash { robot, unsent } => {
            let unsent: Vec<String> = unsent
                .iter()
                .map(|place| {
                    let (what, _, to) = message(place);
                    format!(", {what} to R{to} unsent")
                })
                .collect();
            format!("R{robot} crashes{}", unsent.concat())
        }
        Action::Restart(robot) => format!("R{robot} is back as {}", name(after.robot(*robot).machine.role())),
    }
}

fn describe(message: &Message, roll_back: bool) -> String {
    let back = if roll_back { "the roll-back " } else { "" };
    match message {
        Message::Lock { sequence } => format!("LOCK #{sequence}"),
        Message::AckLock { sequence, .. } => format!("ACKLOCK #{sequence}"),
        Message::Swap { sequence, order: Order::Role(role) } => {
            format!("{back}SWAP #{sequence} ({})", name(*role))
        }
        Message::Swap { sequence, .. } => format!("SWAP #{sequence}"),
        Message::AckSwap { sequence } => format!("ACKSWAP #{sequence}"),
    }
}

/// What the step changed for a robot, and what it sends.
fn outcome(before: &State, after: &State, robot: PlayerNumber) -> String {
    let (was, is) = (&before.robot(robot).machine, &after.robot(robot).machine);
    let mut outcomes = Vec::new();
    if was.role() != is.role() {
        outcomes.push(format!("becomes {}", name(is.role())));
    }
    match (was.lock(), is.lock()) {
        (None, Some(lock)) => outcomes.push(format!("is locked for R{}", lock.by)),
        (Some(_), None) => outcomes.push("is unlocked".to_owned()),
        _ => {}
    }
    match (was.phase(), is.phase()) {
        (AttemptPhase::WaitingForLocks { .. }, AttemptPhase::WaitingForAcks { .. }) => {
            outcomes.push("has all locks".to_owned())
        }
        (AttemptPhase::WaitingForLocks { .. } | AttemptPhase::WaitingForAcks { .. }, AttemptPhase::Idle) => {
            outcomes.push("ends its attempt".to_owned());
        }
        (phase, now) if phase == now && was.awaited().len() > is.awaited().len() => {
            outcomes.push("counts it".to_owned());
        }
        _ => {}
    }
    for envelope in after.network.in_flight() {
        let sent =
            |state: &State| state.network.in_flight().iter().filter(|other| *other == envelope).count();
        if envelope.from == robot && sent(after) > sent(before) {
            outcomes.push(format!(
                "sends {} to R{}",
                describe(&envelope.message, envelope.roll_back),
                envelope.to
            ));
        }
    }
    outcomes.dedup();
    if outcomes.is_empty() { String::new() } else { format!(": R{robot} {}", outcomes.join(", ")) }
}
