//! From the events of a script to the requests of a match.

use std::sync::Arc;

use super::check::{Known, KnownTeam, check_event};
use super::event::{Event, TimedEvent};
use crate::clock::{Clock, TICK_HZ};
use crate::comms::radio::Partition;
use crate::data::{AssetFolder, AssetKind, DataError, Field, Source};
use crate::game::requests::{BodyChange, RadioChange, Request, RobotChange};
use crate::game::{MatchPlan, checked};
use crate::geometry::Pose;
use crate::ids::RobotId;
use crate::protocol::role_swap::{Reassignment, RoleIndex};
use crate::robot::RobotFailure;
use crate::robot::pilot::Pilot;
use crate::strategy::{Strategy, StrategyReading};

/// What is asked of a match when, by tick.
///
/// # Errors
/// If the file of a radio has a fault.
pub(in crate::lab) fn requests(
    assets: &AssetFolder,
    script: &[TimedEvent],
    plan: &MatchPlan,
) -> Result<Vec<(u64, Request)>, DataError> {
    let clock = Clock::new(TICK_HZ);
    let requests = script.iter().map(|event| {
        let tick = (event.at / clock.dt).round() as u64;
        Ok((tick, request(assets, &event.what, plan)?))
    });
    requests.collect()
}

/// Checks an event that stands in a file and is to happen in a whole match.
///
/// # Errors
/// The first thing that the match does not have, or the first number that is out of bounds.
pub(in crate::lab) fn check_event_of_match(
    assets: &AssetFolder,
    (source, at): (&Source, &Field),
    event: &TimedEvent,
    plan: &MatchPlan,
) -> Result<(), DataError> {
    let known = Known {
        pitch: &plan.pitch,
        ball: &plan.ball,
        teams: plan.teams.each_ref().map(KnownTeam::of),
        radios: assets.names(AssetKind::Radio),
        strategies: assets.names(AssetKind::Strategy),
    };
    check_event((source, at), event, &known, plan.robots().collect())
}

fn role(strategy: &Strategy, name: &str) -> Option<RoleIndex> {
    let index = strategy.roles.iter().position(|role| role.name == name)?;
    RoleIndex::try_from(index).ok()
}

fn request(assets: &AssetFolder, event: &Event, plan: &MatchPlan) -> Result<Request, DataError> {
    let fail = |robot: RobotId, failure| Request::Robot(robot, RobotChange::Fail(failure));
    Ok(match event {
        Event::Crash(robot) => fail(*robot, RobotFailure::Crashed),
        Event::Freeze(robot) => fail(*robot, RobotFailure::Frozen),
        Event::Deaf(robot) => fail(*robot, RobotFailure::Deaf),
        Event::Mute(robot) => fail(*robot, RobotFailure::Mute),
        Event::Penalise(robot) => Request::Robot(*robot, RobotChange::Penalise),
        Event::Revive { robot, memory } => Request::Robot(*robot, RobotChange::Revive(*memory)),
        Event::CutOff(robot) => Request::Radio(RadioChange::CutOff(*robot)),
        Event::Reconnect(robot) => Request::Radio(RadioChange::Reconnect(*robot)),
        Event::Partition(one, other) => Request::Radio(RadioChange::Part(Partition {
            reason: "the scenario's script".into(),
            one: one.iter().copied().collect(),
            other: other.iter().copied().collect(),
        })),
        Event::Heal => Request::Radio(RadioChange::Heal),
        Event::Jam(jammed) => Request::Radio(RadioChange::Jam(*jammed)),
        Event::Radio(name) => {
            Request::Radio(RadioChange::Change(checked(assets, &assets.file(AssetKind::Radio, name))?))
        }
        Event::Ball { at, velocity } => Request::Body(BodyChange::Ball { at: *at, velocity: *velocity }),
        Event::Push { robot, by } => Request::Body(BodyChange::Push { robot: *robot, by: *by }),
        Event::Kidnap { robot, to, facing } => {
            let to = Pose { position: *to, heading: facing.to_radians() };
            Request::Body(BodyChange::Kidnap { robot: *robot, to })
        }
        Event::Mislead { robot, by, turn } => {
            Request::Robot(*robot, RobotChange::Mislead { by: *by, turn: turn.to_radians() })
        }
        Event::InitiateSwap { robot, roles } => {
            let strategy = &plan.team(robot.team).strategy;
            let pair = |(from, to): &(String, String)| Some((role(strategy, from)?, role(strategy, to)?));
            let pairs = roles.iter().filter_map(pair).collect();
            Request::Robot(*robot, RobotChange::Swap(Reassignment::Roles(pairs)))
        }
        Event::TakeOver(robot) => Request::TakeOver(*robot),
        Event::Steer { robot, throttle, aside, turn, kick } => {
            let pilot = Pilot { throttle: *throttle, aside: *aside, turn: *turn, head: None, kick: *kick };
            Request::Steer { robot: *robot, pilot }
        }
        Event::HandBack(robot) => Request::HandBack(*robot),
        Event::Strategy { team, name } => {
            let StrategyReading { strategy, texts, .. } = plan.read_other(*team, assets, name);
            Request::ChangeStrategy { team: *team, strategy: Arc::new(strategy?), texts }
        }
    })
}
