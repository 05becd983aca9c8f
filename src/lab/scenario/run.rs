//! Plays a scenario headless and judges it.

use std::hash::{BuildHasher, Hash};
use std::time::Instant;

use bevy::prelude::*;
use xxhash_rust::xxh3::Xxh3DefaultBuilder;

use super::event::Dependency;
use super::judge::{Judge, Verdict};
use super::plan::ScenarioPlan;
use super::report::{ScenarioReport, ScenarioRun};
use super::scene::{RobotScene, Scene};
use super::tally::{ProbabilityCount, Tally};
use crate::clock::Clock;
use crate::comms::radio::RadioRecord;
use crate::game::Match;
use crate::game::record::{Invariants, Record};
use crate::geometry::{Pose, Twist};
use crate::ids::RobotId;
use crate::mind::teamwork::{Booking, BookingStatus, Carrier, Swapping, TeamModel};
use crate::pitch::Pitch;
use crate::robot::Robot;
use crate::strategy::{Activity, Role, Strategies, Strategy};
use crate::world::ball::Ball;
use crate::world::referee::MatchState;

/// Looks on while a scenario is played, and may stop it.
pub trait RunWatcher {
    /// A run begins, with the ball at a place and with a seed.
    fn begin(&mut self, _run: (Vec2, u64), _game: &mut Match) {}
    /// A tick was played.
    fn after_tick(&mut self, _game: &mut Match) {}
    /// The run is decided, or its time is over.
    fn end(&mut self) {}
    /// Whether to stop.
    fn stops(&self) -> bool {
        false
    }
}

/// Two that look on.
impl<A: RunWatcher, B: RunWatcher> RunWatcher for (&mut A, &mut B) {
    fn begin(&mut self, run: (Vec2, u64), game: &mut Match) {
        self.0.begin(run, game);
        self.1.begin(run, game);
    }

    fn after_tick(&mut self, game: &mut Match) {
        self.0.after_tick(game);
        self.1.after_tick(game);
    }

    fn end(&mut self) {
        self.0.end();
        self.1.end();
    }

    fn stops(&self) -> bool {
        self.0.stops() || self.1.stops()
    }
}

struct NoWatcher;

impl RunWatcher for NoWatcher {}

impl ScenarioPlan {
    /// Plays the scenario with the ball at each of its places and with each of its seeds, or until all that must be met with a probability
    /// is decided.
    pub fn run(&self, without: Option<Dependency>) -> ScenarioReport {
        self.run_watched(without, &mut NoWatcher)
    }

    /// As [`ScenarioPlan::run`], or until a watcher stops it: then the run of that moment does not count.
    pub fn run_watched(&self, without: Option<Dependency>, watcher: &mut impl RunWatcher) -> ScenarioReport {
        let plan = without.map_or_else(|| self.clone(), |dependency| self.without(dependency));
        let mut report = ScenarioReport {
            file: self.origin.to_string(),
            variant: self.origin.variant.clone(),
            name: self.scenario.name.clone(),
            without,
            may_fail: self.scenario.may_fail,
            probabilities: ProbabilityCount::all_of(&self.scenario),
            interrupted: false,
            runs: Vec::new(),
        };
        for place in &self.scenario.places {
            if plan.play_place(*place, &mut report, watcher).is_none() {
                report.interrupted = true;
                break;
            }
        }
        report
    }

    /// Plays the scenario with the ball at one place, with all of its seeds or until every probability is decided; `None` if it is
    /// stopped before.
    fn play_place(
        &self,
        place: Vec2,
        report: &mut ScenarioReport,
        watcher: &mut impl RunWatcher,
    ) -> Option<()> {
        let mut tally = Tally::new(&report.probabilities);
        for seed in &self.scenario.seeds {
            let start = Instant::now();
            let verdict = self.play_watched(place, *seed, watcher)?;
            tally.add(&verdict);
            report.runs.push(ScenarioRun { place, seed: *seed, verdict, took: start.elapsed() });
            if tally.is_decided() {
                break;
            }
        }
        Some(())
    }

    /// Plays the scenario with the ball at one place and with one seed, until everything is decided.
    pub fn play(&self, place: Vec2, seed: u64) -> Verdict {
        self.play_watched(place, seed, &mut NoWatcher).unwrap_or_default()
    }

    /// As [`ScenarioPlan::play`]; `None` if it is stopped before.
    fn play_watched(&self, place: Vec2, seed: u64, watcher: &mut impl RunWatcher) -> Option<Verdict> {
        let mut game = Match::new(&self.with_ball_at(place, seed));
        watcher.begin((place, seed), &mut game);
        let dt = game.clock().dt;
        let mut judge = Judge::new(&self.scenario, place, dt);
        for _ in 0..self.scenario.ticks(dt) {
            if watcher.stops() {
                return None;
            }
            game.tick();
            watcher.after_tick(&mut game);
            observe(game.world_mut(), &mut judge);
            if judge.is_decided() {
                break;
            }
        }
        watcher.end();
        Some(judge.verdict())
    }
}

type Seen<'a> = (
    &'a RobotId,
    &'a Robot,
    &'a Pose,
    &'a Twist,
    &'a Role,
    &'a Activity,
    &'a TeamModel,
    Option<&'a Swapping>,
    Option<&'a Booking>,
);

/// Shows a judge the tick that is just over.
pub fn observe(world: &mut World, judge: &mut Judge) {
    let mut ball = world.query_filtered::<(&Pose, &Twist), With<Ball>>();
    let mut robots = world.query::<Seen>();
    let world = &*world;
    let Ok((ball, motion)) = ball.single(world) else { return };
    let (strategies, record) = (world.resource::<Strategies>(), world.resource::<Record>());
    let mut scenes: Vec<RobotScene> =
        robots.iter(world).map(|seen| robot_scene(seen, strategies.of(seen.0.team), record)).collect();
    scenes.sort_unstable_by_key(|robot| robot.id);
    judge.observe(&Scene {
        tick: world.resource::<Clock>().tick,
        pitch: world.resource::<Pitch>(),
        ball: ball.position,
        ball_velocity: motion.linear,
        ball_at_start: judge.ball_at_start(),
        robots: scenes,
        score: world.resource::<MatchState>().score,
        radio: world.resource::<RadioRecord>(),
        contacts: &record.contacts,
        invariants: world.resource::<Invariants>(),
    });
}

fn robot_scene<'a>(
    (id, robot, pose, twist, role, activity, team_model, swapping, booking): Seen,
    strategy: &'a Strategy,
    record: &Record,
) -> RobotScene<'a> {
    let machine = &strategy.machines[activity.machine(strategy)];
    let state = &machine.states[activity.state];
    let configuration = swapping.and_then(|swapping| swapping.machine.configuration());
    RobotScene {
        id: *id,
        pose: *pose,
        speed: twist.linear.length(),
        on: !robot.health.crashed,
        role: &strategy.roles[role.0].name,
        acting_as: &strategy.roles[activity.acting_as].name,
        activity: &state.name,
        within: machine.names_of(state).take(state.within.len()).collect(),
        claims: team_model.has_ball,
        holder: if team_model.has_ball {
            Some(id.number)
        } else {
            team_model.carrier.and_then(Carrier::number)
        },
        goes: booking.is_some_and(|booking| booking.0.goes()),
        drives: record.pursuit[id.team.index()].drives(id.number),
        booker: match team_model.booking {
            BookingStatus::Own => Some(id.number),
            BookingStatus::Mate(number) => Some(number),
            BookingStatus::Free => None,
        },
        locked_by: swapping.and_then(|swapping| swapping.machine.lock()).map(|lock| lock.by),
        configuration: configuration.map(fingerprint),
    }
}

fn fingerprint(value: &impl Hash) -> u64 {
    Xxh3DefaultBuilder.hash_one(value)
}
