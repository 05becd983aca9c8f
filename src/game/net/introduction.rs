//! The greeting of a match and a robot that is a process of its own: each tells the other what it plays, so that one of
//! another match, strategy or version is told apart before the first tick.

use std::fmt::Debug;

use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_64;

use crate::clock::Clock;
use crate::comms::tcm::{DataType, Module, data};
use crate::game::MatchPlan;
use crate::ids::RobotId;

/// The version of what matches and robots say to each other; another one whenever that changes.
const PROTOCOL: u16 = 3;

/// What one side plays. Its layout stays the same in all versions, so that they can tell each other apart.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Introduction {
    /// The version of the messages between a match and its robots.
    pub protocol: u16,
    /// Of the program.
    pub version: String,
    /// A number that this match has and the one before had not; a robot says that of the match that it answers.
    pub session: u32,
    /// What must be equal on both sides.
    pub particulars: Vec<Particular>,
}

/// One thing that has to be equal on both sides.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Particular {
    /// What it is about, for people.
    pub what: String,
    /// As people call it; empty if it has no name.
    pub name: String,
    /// Of its contents, if there is more to it than its name.
    pub fingerprint: Option<u64>,
}

impl Introduction {
    /// What a match is for one of its robots, and the robot for its match.
    pub fn new(plan: &MatchPlan, robot: RobotId, session: u32) -> Introduction {
        let team = plan.team(robot.team);
        let sensing = &team.senses(robot.number).sensing;
        let rate = (1.0 / Clock::default().dt).to_string();
        let particulars = vec![
            Particular::named("robot", robot.to_string()),
            Particular::named("match", plan.name.clone()),
            Particular::named("seed", plan.seed.to_string()),
            Particular::named("number of ticks a second", rate),
            Particular::of("pitch", "", &plan.pitch),
            Particular::of("ball", "", &plan.ball),
            Particular::of(&format!("strategy of {}", robot.team), &team.strategy.name, &team.strategy),
            Particular::of("kind of robot", &team.kind.name, &team.kind),
            Particular::of("sensing", &sensing.name, sensing),
            Particular::of("set-up of the team communication", "", &plan.tcm),
        ];
        Introduction { protocol: PROTOCOL, version: env!("CARGO_PKG_VERSION").into(), session, particulars }
    }

    /// The first thing in which two sides differ, as a part of a sentence; the session may differ.
    pub fn difference(&self, there: &Introduction) -> Option<String> {
        if (self.protocol, &self.version) != (there.protocol, &there.version) {
            return Some(format!("the version differs: here {}, there {}", self.program(), there.program()));
        }
        self.particulars.iter().find_map(|here| {
            let what = &here.what;
            let Some(there) = there.particulars.iter().find(|there| there.what == *what) else {
                return Some(format!("the {what} is not told"));
            };
            (here != there)
                .then(|| format!("the {what} differs: here {}, there {}", here.shown(), there.shown()))
        })
    }

    fn program(&self) -> String {
        format!("{} (protocol {})", self.version, self.protocol)
    }
}

impl Particular {
    fn named(what: &str, name: String) -> Particular {
        Particular { what: what.into(), name, fingerprint: None }
    }

    fn of(what: &str, name: &str, contents: &impl Debug) -> Particular {
        // Every number of the contents is written out in full, and all of them are in an order.
        let fingerprint = xxh3_64(format!("{contents:?}").as_bytes());
        Particular { what: what.into(), name: name.into(), fingerprint: Some(fingerprint) }
    }

    fn shown(&self) -> String {
        match (self.name.as_str(), self.fingerprint) {
            (name, None) => name.into(),
            ("", Some(contents)) => format!("{contents:016x}"),
            (name, Some(contents)) => format!("{name} ({contents:016x})"),
        }
    }
}

const INTRODUCTION: DataType = DataType(18);

data!(Introduction { INTRODUCTION, "introduction", Module::REMOTE_ROBOTS, Routine; (it) = it: Introduction; });

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::comms::tcm::Data;
    use crate::data::AssetFolder;
    use crate::game::Choice;
    use crate::ids::Team;

    const ROBOT: RobotId = RobotId::new(Team::Home, 1);

    fn plan() -> MatchPlan {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        MatchPlan::read(&assets, &Choice::default()).unwrap()
    }

    fn difference(change: impl Fn(&mut MatchPlan)) -> Option<String> {
        let (here, mut there) = (plan(), plan());
        change(&mut there);
        Introduction::new(&here, ROBOT, 1).difference(&Introduction::new(&there, ROBOT, 2))
    }

    #[test]
    fn what_a_robot_reads_of_its_match_has_to_be_equal_and_the_line_says_what_differs() {
        assert_eq!(difference(|_| {}), None);
        type Change = fn(&mut MatchPlan);
        let changes: [(&str, Change); 8] = [
            ("match", |plan| plan.name.push('2')),
            ("seed", |plan| plan.seed += 1),
            ("pitch", |plan| plan.pitch.goal.depth += 0.001),
            ("ball", |plan| plan.ball.radius += 0.001),
            ("strategy of home", |plan| {
                Arc::make_mut(&mut plan.teams[0].strategy).teamwork.talk.claim_every += 0.1
            }),
            ("kind of robot", |plan| Arc::make_mut(&mut plan.teams[0].kind).control_hz += 1.0),
            ("sensing", |plan| Arc::make_mut(&mut plan.teams[0].senses.sensing).memory.ball += 0.1),
            ("set-up of the team communication", |plan| plan.tcm.messages_per_tick += 1),
        ];
        for (what, change) in changes {
            let line = difference(change).unwrap_or_default();
            assert!(line.starts_with(&format!("the {what} differs: here ")), "{what}: {line}");
        }
        assert_eq!(difference(|plan| plan.rules.half_minutes += 1.0), None, "robots do not read it");
        assert_eq!(difference(|plan| plan.teams[1] = plan.teams[0].clone()), None, "the opponents' business");
    }

    #[test]
    fn another_robot_and_another_version_differ() {
        let one = Introduction::new(&plan(), ROBOT, 1);
        let other = Introduction::new(&plan(), RobotId::new(Team::Home, 2), 1);
        assert_eq!(one.difference(&other).as_deref(), Some("the robot differs: here home 1, there home 2"));
        let later = Introduction { protocol: PROTOCOL + 1, particulars: Vec::new(), ..one.clone() };
        let line = one.difference(&later).unwrap();
        assert!(line.starts_with("the version differs: here ") && line.ends_with("(protocol 4)"), "{line}");
        let silent = Introduction { particulars: Vec::new(), ..one.clone() };
        assert_eq!(one.difference(&silent).as_deref(), Some("the robot is not told"));
    }

    #[test]
    fn an_introduction_comes_back_as_it_was() {
        let introduction = Introduction::new(&plan(), ROBOT, 7);
        let (_, bytes) = introduction.serialise();
        assert_eq!(Introduction::unserialise(INTRODUCTION, &bytes), Some(introduction));
        assert_eq!(Introduction::unserialise(INTRODUCTION, &bytes[1..]), None);
    }
}
