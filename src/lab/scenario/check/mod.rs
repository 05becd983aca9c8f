//! From a scenario file to a scenario: looks every name up and checks every number. The first fault is reported with its
//! place in the file.

mod expectations;
mod places;
mod script;
mod sides;
#[cfg(test)]
mod tests;

pub(super) use script::check_event;

use std::collections::BTreeMap;

use bevy::prelude::Vec2;

use super::condition::Expectation;
use super::event::{Dependency, TimedEvent};
use super::file::{BallPlaces, Referee, ScenarioFile, Seeds};
use super::watch::ticks;
use crate::comms::radio::FaultRule;
use crate::data::{Bound, DataError, Field, Source, check_count, no_such};
use crate::game::TeamPlan;
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::pitch::{BallKind, Pitch};
use crate::rng::LARGEST_SEED;
use crate::robot::RobotKind;
use crate::world::physics::Footprint;

type Checked<T> = Result<T, DataError>;

/// A scenario that can be played: every name is known, every number is sound.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// What it shows, as a sentence.
    pub name: String,
    /// Where the claim comes from.
    pub source: String,
    /// More about it, for people.
    pub description: String,
    /// The file's name.
    pub radio: String,
    /// The seeds that it is played with; where something must be met with a probability, only as many of them as decide it.
    pub seeds: Vec<u64>,
    /// With how many of the seeds it may fail, at each place of the ball.
    pub may_fail: usize,
    /// How long it takes.
    pub seconds: f32,
    /// Whether the rules of a match are enforced.
    pub referee: Referee,
    /// The robots that take part in the order of their numbers, home first.
    pub sides: [Option<Vec<ScenarioPlayer>>; 2],
    /// Where the ball starts, in the pitch frame: one run for each, with each seed.
    pub places: Vec<Vec2>,
    /// Of the ball at the start, m/s in the pitch frame.
    pub velocity: Vec2,
    /// What the radio does to which packets.
    pub faults: Vec<FaultRule>,
    /// In the order of their times.
    pub script: Vec<TimedEvent>,
    /// What must hold.
    pub expect: Vec<Expectation>,
    /// What it is about: without it, it must fail.
    pub depends_on: Option<Dependency>,
}

impl Scenario {
    /// How many ticks of `dt` seconds it takes.
    pub fn ticks(&self, dt: f32) -> u64 {
        ticks(self.seconds, dt)
    }

    /// Where the ball starts in the first run.
    pub fn first_place(&self) -> Vec2 {
        self.places.first().copied().unwrap_or_default()
    }

    /// The same with one seed, with the ball at the first place only, where all of it must be met.
    pub fn with_one_seed(&self, seed: u64) -> Scenario {
        Scenario {
            seeds: vec![seed],
            places: self.places.iter().take(1).copied().collect(),
            may_fail: 0,
            expect: self.expect.iter().map(|expectation| expectation.with_one_seed().clone()).collect(),
            ..self.clone()
        }
    }

    /// All robots that take part, in order.
    pub fn players(&self) -> impl Iterator<Item = &ScenarioPlayer> {
        self.sides.iter().flatten().flatten()
    }
}

/// A robot that takes part.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioPlayer {
    /// Who.
    pub id: RobotId,
    /// In the pitch frame.
    pub pose: Pose,
    /// The strategy's role for its number if not given.
    pub role: Option<String>,
    /// Whether it starts switched on.
    pub on: bool,
}

/// What the files that a scenario names hold.
#[derive(Clone, Debug)]
pub struct Known<'a> {
    /// The pitch.
    pub pitch: &'a Pitch,
    /// The ball.
    pub ball: &'a BallKind,
    /// Home first; empty for a side that does not play.
    pub teams: [KnownTeam<'a>; 2],
    /// The names of all radios.
    pub radios: Vec<String>,
    /// The names of all strategies.
    pub strategies: Vec<String>,
}

/// What a strategy holds.
#[derive(Clone, Debug, Default)]
pub struct KnownTeam<'a> {
    /// Where each of its robots stands at its own kick-off.
    pub kick_off: &'a [Vec2],
    /// Places of all players, by name.
    pub line_ups: BTreeMap<&'a str, &'a [Vec2]>,
    /// `None` for a side that does not play.
    pub kind: Option<&'a RobotKind>,
    /// The names of its strategy's roles.
    pub roles: Vec<&'a str>,
    /// The states of all its machines.
    pub activities: Vec<&'a str>,
}

impl<'a> KnownTeam<'a> {
    /// What the strategy of a team holds, and its robots' kind.
    pub(in crate::lab::scenario) fn of(team: &'a TeamPlan) -> KnownTeam<'a> {
        let strategy = &team.strategy;
        let states = strategy.machines.iter().flat_map(|machine| {
            let composites = machine.composites.iter().map(|state| state.name.as_str());
            composites.chain(machine.states.iter().map(|state| state.name.as_str()))
        });
        KnownTeam {
            kick_off: &strategy.kick_off.ours,
            line_ups: strategy.line_ups.iter().map(|(name, places)| (name.as_str(), &places[..])).collect(),
            kind: Some(&team.kind),
            roles: strategy.roles.iter().map(|role| role.name.as_str()).collect(),
            activities: states.collect(),
        }
    }
}

/// Checks a scenario file.
///
/// # Errors
/// The first fault, with its line and field.
pub fn check(file: &ScenarioFile, source: &Source, known: &Known) -> Checked<Scenario> {
    let root = Field::root();
    let name = source.required(&file.name, &root, "name")?;
    let seconds = source.required(&file.seconds, &root, "seconds")?;
    let ball = source.required(&file.ball, &root, "ball")?;
    let mut checker = Checker { source, known, seconds, seeds: 0, robots: Vec::new(), standing: Vec::new() };
    if name.trim().is_empty() {
        return checker.fault(&root.key("name"), "must say what the scenario shows");
    }
    source.within(&root.key("seconds"), seconds, Bound::SECONDS.positive())?;
    let is_tested = file.expect.iter().any(|expectation| expectation.probability().is_some());
    let usual = if is_tested { Seeds::Count(SEEDS_OF_A_TEST) } else { Seeds::default() };
    let seeds = checker.seeds(file.seeds.clone().unwrap_or(usual).to_vec(), &root.key("seeds"))?;
    checker.seeds = seeds.len();
    if is_tested && file.may_fail.is_some() {
        let message = "does not go with `Probability`, by which expectations say how often they are met";
        return checker.fault(&root.key("may_fail"), message);
    }
    let may_fail = usize::from(file.may_fail.unwrap_or_default());
    if may_fail >= seeds.len() {
        let message = format!("must be less than the number of seeds, {}", seeds.len());
        return checker.fault(&root.key("may_fail"), message);
    }
    let radio = file.radio.clone().unwrap_or_else(|| "perfect".into());
    if !known.radios.contains(&radio) {
        return checker.fault(&root.key("radio"), no_such("radio", &radio, &known.radios));
    }
    let home = source.required(&file.home, &root, "home")?;
    let home = checker.side(Team::Home, &home, &root.key("home"))?;
    let away = match &file.away {
        Some(away) => Some(checker.side(Team::Away, away, &root.key("away"))?),
        None => None,
    };
    let places = checker.places(&ball.at, &root.key("ball").key("at"))?;
    source.vector_within(&root.key("ball").key("velocity"), ball.velocity, Bound::VELOCITY)?;
    checker.stand_apart(&places)?;
    for (i, rule) in file.faults.iter().enumerate() {
        checker.rule(rule, &root.key("faults").index(i))?;
    }
    for (i, event) in file.script.iter().enumerate() {
        checker.event(event, &root.key("script").index(i))?;
    }
    if file.expect.is_empty() {
        return checker.fault(&root.key("expect"), "a scenario that expects nothing cannot fail");
    }
    for (i, expectation) in file.expect.iter().enumerate() {
        checker.expectation(expectation, &root.key("expect").index(i))?;
    }
    let mut script = file.script.clone();
    script.sort_by(|a, b| a.at.total_cmp(&b.at));
    Ok(Scenario {
        name,
        source: source.required(&file.source, &root, "source")?,
        description: file.description.clone().unwrap_or_default(),
        radio,
        seeds,
        may_fail,
        seconds,
        referee: file.referee.unwrap_or_default(),
        sides: [Some(home), away],
        places,
        velocity: ball.velocity,
        faults: file.faults.clone(),
        script,
        expect: file.expect.clone(),
        depends_on: file.depends_on,
    })
}

/// Seeds of a scenario.
const MOST_SEEDS: usize = 10_000;
/// The most seeds that are played until a probability is shown or refuted, where the file does not say.
const SEEDS_OF_A_TEST: u16 = 500;
/// Places of the ball in a scenario.
const MOST_PLACES: usize = 10_000;

struct Checker<'a> {
    source: &'a Source,
    known: &'a Known<'a>,
    /// How long the scenario takes.
    seconds: f32,
    /// The number of its seeds.
    seeds: usize,
    /// Those that take part, as far as the file has been read.
    robots: Vec<RobotId>,
    standing: Vec<PlacedBody>,
}

/// A body, where it stands, and where the file says so.
struct PlacedBody {
    name: String,
    footprint: Footprint,
    pose: Pose,
    field: Field,
}

impl Checker<'_> {
    fn fault<T>(&self, at: &Field, message: impl Into<String>) -> Checked<T> {
        Err(self.source.error_at(at, message))
    }

    fn on_pitch(&self, point: Vec2, at: &Field) -> Checked<()> {
        self.source.vector_within(at, point, Bound::PLACE)?;
        if self.known.pitch.holds(point, 0.0) {
            return Ok(());
        }
        self.fault(at, format!("({}, {}) is not on the pitch", point.x, point.y))
    }

    /// A time within the scenario.
    fn time(&self, time: f32, at: &Field) -> Checked<()> {
        self.source.within(at, time, Bound::SECONDS)?;
        if time <= self.seconds {
            return Ok(());
        }
        self.fault(at, format!("{time} s is after the end, which is at {} s", self.seconds))
    }

    fn robot(&self, robot: RobotId, at: &Field) -> Checked<()> {
        if self.robots.contains(&robot) {
            return Ok(());
        }
        let mut known = self.robots.clone();
        known.sort_unstable();
        self.fault(at, no_such("robot", &robot.to_string(), known.iter().map(RobotId::to_string)))
    }

    fn maybe_robot(&self, robot: Option<RobotId>, at: &Field) -> Checked<()> {
        robot.map_or(Ok(()), |robot| self.robot(robot, at))
    }

    fn role(&self, team: Team, role: &str, at: &Field) -> Checked<()> {
        let roles = &self.known.teams[team.index()].roles;
        if roles.contains(&role) { Ok(()) } else { self.fault(at, no_such("role", role, roles)) }
    }

    fn seeds(&self, seeds: Vec<u64>, at: &Field) -> Checked<Vec<u64>> {
        self.source.locate(at, check_count("", "the number of seeds", seeds.len(), 1..=MOST_SEEDS))?;
        if let Some(i) = seeds.iter().position(|seed| *seed > LARGEST_SEED) {
            return self.fault(&at.index(i), format!("must be at most {LARGEST_SEED}, not {}", seeds[i]));
        }
        match seeds.iter().enumerate().find(|(i, seed)| seeds[..*i].contains(seed)) {
            Some((i, seed)) => self.fault(&at.index(i), format!("the seed {seed} is given twice")),
            None => Ok(seeds),
        }
    }

    fn places(&self, places: &BallPlaces, at: &Field) -> Checked<Vec<Vec2>> {
        self.source.locate(at, check_count("", "the number of places", places.count(), 1..=MOST_PLACES))?;
        let known = places.to_vec();
        for (i, place) in known.iter().enumerate() {
            self.on_pitch(*place, at)?;
            if known[..i].contains(place) {
                return self.fault(at, format!("({}, {}) is given twice", place.x, place.y));
            }
        }
        Ok(known)
    }
}
