//! From a scenario file to matches that can be played, one for each seed.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use bevy::prelude::*;

use super::check::{Known, KnownTeam, Scenario, Side, check};
use super::event::{Dependency, Event};
use super::file::{Referee, ScenarioFile, SideFile};
use crate::clock::{Clock, TICK_HZ};
use crate::comms::radio::{Partition, Radio};
use crate::data::{AssetFolder, AssetKind, DataError, Field, Source};
use crate::game::requests::{BodyChange, RadioChange, Request, RobotChange};
use crate::game::{Choice, MatchPlan, Placed, Situation, TeamFile, TeamPlan, checked, file_named};
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::pitch::{BallKind, Pitch};
use crate::protocol::role_swap::{PaperRules, Reassignment, RoleIndex};
use crate::robot::RobotFailure;
use crate::strategy::Strategy;
use crate::strategy::teamwork::Protocol;

/// A scenario with everything that its matches need.
#[derive(Clone, Debug)]
pub struct ScenarioPlan {
    pub path: PathBuf,
    pub scenario: Scenario,
    /// The match, with the first seed.
    match_plan: MatchPlan,
}

impl ScenarioPlan {
    /// Reads a scenario and all files that it names.
    ///
    /// # Errors
    /// The first file that is missing or wrong, with the place of the fault.
    pub fn read(assets: &AssetFolder, path: &Path) -> Result<ScenarioPlan, DataError> {
        let source = Source::read(path)?;
        let file: ScenarioFile = source.parse()?;
        let game = file_named(assets, &source, AssetKind::Match, ("game", &file.game))?;
        let usual = MatchPlan::read_file(assets, &game, &Choice::default())?;
        let pitch = match &file.pitch {
            Some(name) => {
                checked(&file_named(assets, &source, AssetKind::Pitch, ("pitch", name))?, Pitch::fault)?
            }
            None => usual.pitch.clone(),
        };
        let home = team(assets, &source, ("home", &file.home), (&pitch, &usual.ball))?;
        let away = file.away.as_ref().map_or(("home", &file.home), |away| ("away", away));
        let away = team(assets, &source, away, (&pitch, &usual.ball))?;
        let known = Known {
            pitch: &pitch,
            ball: &usual.ball,
            teams: [known(&home), if file.away.is_some() { known(&away) } else { KnownTeam::default() }],
            radios: assets.names(AssetKind::Radio),
        };
        let scenario = check(&file, &source, &known)?;
        let mut match_plan = MatchPlan {
            name: scenario.name.clone(),
            pitch,
            radio: checked(&assets.file(AssetKind::Radio, &scenario.radio), Radio::fault)?,
            teams: [home, away],
            seed: scenario.seeds.first().copied().unwrap_or(1),
            situation: Some(situation(&scenario)),
            faults: scenario.faults.clone(),
            ..usual
        };
        for (team, side) in Team::BOTH.into_iter().zip(&scenario.sides) {
            if let Some(side) = side {
                let at = Field::root().key(team.to_string());
                let cast = match_plan.teams[team.index()].cast(cast(side));
                cast.map_err(|message| source.error_at(&at, message))?;
            }
        }
        match_plan.script = script(assets, &scenario, &match_plan)?;
        let plan = ScenarioPlan { path: path.to_owned(), scenario, match_plan };
        match plan.scenario.depends_on {
            Some(dependency) if !plan.has(dependency) => {
                let at = Field::root().key("depends_on");
                Err(source.error_at(&at, format!("{dependency} is not on in the home team's strategy")))
            }
            _ => Ok(plan),
        }
    }

    /// The match with a seed, and with the ball at the first of its places.
    pub fn with_seed(&self, seed: u64) -> MatchPlan {
        MatchPlan { seed, ..self.match_plan.clone() }
    }

    /// The match with a seed and with the ball at a place.
    pub(super) fn with_ball_at(&self, place: Vec2, seed: u64) -> MatchPlan {
        let mut plan = self.with_seed(seed);
        if let Some(situation) = &mut plan.situation {
            situation.ball = place;
        }
        plan
    }

    /// The same scenario without what it is said to depend on, in all teams.
    pub fn without(&self, dependency: Dependency) -> ScenarioPlan {
        let mut plan = self.clone();
        for team in &mut plan.match_plan.teams {
            switch_off(Arc::make_mut(&mut team.strategy), dependency);
        }
        plan
    }

    fn has(&self, dependency: Dependency) -> bool {
        let teamwork = &self.match_plan.team(Team::Home).strategy.teamwork;
        match dependency.mechanism() {
            Some(mechanism) => teamwork.has(mechanism),
            None => teamwork.role_swap.as_ref().is_some_and(|swap| swap.protocol == Protocol::Hardened),
        }
    }
}

fn switch_off(strategy: &mut Strategy, dependency: Dependency) {
    let teamwork = &mut strategy.teamwork;
    match dependency.mechanism() {
        Some(mechanism) => teamwork.mechanisms = teamwork.mechanisms.without(mechanism),
        None => {
            if let Some(swap) = &mut teamwork.role_swap {
                swap.protocol = Protocol::Paper(PaperRules::default());
            }
        }
    }
}

fn team(
    assets: &AssetFolder,
    source: &Source,
    (side, file): (&str, &SideFile),
    (pitch, ball): (&Pitch, &BallKind),
) -> Result<TeamPlan, DataError> {
    let SideFile { strategy, robot, sensing, .. } = file;
    let (strategy, robot, sensing) = (strategy.clone(), robot.clone(), sensing.clone());
    let names = TeamFile { strategy, robot, sensing, team_number: None };
    names.check(assets, source, side, true)?;
    TeamPlan::read(assets, &names, pitch, ball)
}

fn known(team: &TeamPlan) -> KnownTeam<'_> {
    let strategy = &team.strategy;
    let states = strategy.machines.iter().flat_map(|machine| &machine.states);
    KnownTeam {
        players: strategy.players.len(),
        kind: Some(&team.kind),
        roles: strategy.roles.iter().map(|role| role.name.as_str()).collect(),
        activities: states.map(|state| state.name.as_str()).collect(),
    }
}

/// The roles that a scenario gives to the players of a side, by number.
fn cast(side: &Side) -> Vec<(u8, String)> {
    side.players.iter().filter_map(|player| Some((player.id.number, player.role.clone()?))).collect()
}

fn role(strategy: &Strategy, name: &str) -> Option<RoleIndex> {
    let index = strategy.roles.iter().position(|role| role.name == name)?;
    RoleIndex::try_from(index).ok()
}

fn situation(scenario: &Scenario) -> Situation {
    let placed = |player: &super::check::Player| (player.id, Placed { pose: player.pose, on: player.on });
    Situation {
        refereed: scenario.referee == Referee::Whole,
        robots: scenario.players().map(placed).collect(),
        ball: scenario.first_place(),
        velocity: scenario.velocity,
    }
}

fn script(
    assets: &AssetFolder,
    scenario: &Scenario,
    plan: &MatchPlan,
) -> Result<Vec<(u64, Request)>, DataError> {
    let clock = Clock::new(TICK_HZ);
    let requests = scenario.script.iter().map(|event| {
        let tick = (event.at / clock.dt).round() as u64;
        Ok((tick, request(assets, &event.what, plan)?))
    });
    requests.collect()
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
            Request::Radio(RadioChange::Change(checked(&assets.file(AssetKind::Radio, name), Radio::fault)?))
        }
        Event::Ball { at, velocity } => Request::Body(BodyChange::Ball { at: *at, velocity: *velocity }),
        Event::Push { robot, by } => Request::Body(BodyChange::Push { robot: *robot, by: *by }),
        Event::Kidnap { robot, to, facing } => {
            let to = Pose { position: *to, heading: facing.to_radians() };
            Request::Body(BodyChange::Kidnap { robot: *robot, to })
        }
        Event::InitiateSwap { robot, roles } => {
            let strategy = &plan.team(robot.team).strategy;
            let pair = |(from, to): &(String, String)| Some((role(strategy, from)?, role(strategy, to)?));
            let pairs = roles.iter().filter_map(pair).collect();
            Request::Robot(*robot, RobotChange::Swap(Reassignment::Roles(pairs)))
        }
    })
}
