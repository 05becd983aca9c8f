//! Scenarios: small scenes with a script and expectations, by which teamwork is tested.
//!
//! A file in `assets/scenarios` is parsed into a [`ScenarioFile`] and checked into a [`Scenario`]. While it is played, a
//! [`Judge`] looks at the [`Scene`] of each tick; its [`Verdict`]s over all seeds make a [`ScenarioReport`].

mod capture;
mod check;
mod condition;
mod event;
mod file;
mod finding;
mod judge;
mod plan;
mod report;
mod run;
mod scene;
mod script;
#[cfg(test)]
mod stage;
mod tally;
mod watch;
mod words;

pub use capture::CapturedMoment;
pub use check::{Known, KnownTeam, Scenario, ScenarioPlayer, check};
pub use condition::{Area, Condition, Expectation, Packets, Thing};
pub use event::{Dependency, Event, TimedEvent};
pub use file::{BallFile, BallPlaces, PlayerFile, Referee, ScenarioFile, Seeds, SideFile};
pub use judge::{Failure, Judge, Verdict};
pub use plan::{ScenarioPlan, ScenarioRef};
pub(in crate::lab) use plan::{has, switch_off};
pub use report::{ScenarioReport, ScenarioRow, ScenarioRun, junit, rows};
pub use run::{RunWatcher, observe};
pub use scene::{RobotScene, Scene};
pub(in crate::lab) use script::{check_event_of_match, requests};
pub use tally::{ProbabilityCount, ScenarioOutcome};
