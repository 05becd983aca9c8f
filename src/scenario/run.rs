//! Plays a scenario headless and judges it.

use std::hash::{BuildHasher, Hash};
use std::time::Instant;

use bevy::prelude::*;
use xxhash_rust::xxh3::Xxh3DefaultBuilder;

use super::event::Dependency;
use super::judge::{Judge, Verdict};
use super::plan::ScenarioPlan;
use super::report::{Report, Run};
use super::scene::{RobotScene, Scene};
use crate::ball::Ball;
use crate::behaviour::Activity;
use crate::clock::Clock;
use crate::game::Match;
use crate::geometry::{Pose, Twist};
use crate::ids::RobotId;
use crate::pitch::Pitch;
use crate::radio::MessageCounts;
use crate::referee::MatchState;
use crate::robot::Robot;
use crate::strategy::{Strategies, Strategy};
use crate::teamwork::{Booking, Role, Standing, Swapping, TeamPicture};

impl ScenarioPlan {
    /// Plays the scenario with each of its seeds.
    pub fn run(&self, without: Option<Dependency>) -> Report {
        let plan = without.map_or_else(|| self.clone(), |dependency| self.without(dependency));
        let runs = self.scenario.seeds.iter().map(|seed| {
            let start = Instant::now();
            let verdict = plan.play(*seed);
            Run { seed: *seed, verdict, took: start.elapsed() }
        });
        Report {
            file: self.path.display().to_string(),
            name: self.scenario.name.clone(),
            without,
            runs: runs.collect(),
        }
    }

    /// Plays the scenario with one seed, until everything is decided.
    pub fn play(&self, seed: u64) -> Verdict {
        let mut game = Match::new(&self.with_seed(seed));
        let dt = game.clock().dt;
        let mut judge = Judge::new(&self.scenario, dt);
        for _ in 0..self.scenario.ticks(dt) {
            game.tick();
            observe(game.world_mut(), &mut judge);
            if judge.is_decided() {
                break;
            }
        }
        judge.verdict()
    }
}

type Seen<'a> = (
    &'a RobotId,
    &'a Robot,
    &'a Pose,
    &'a Twist,
    &'a Role,
    &'a Activity,
    &'a TeamPicture,
    Option<&'a Swapping>,
    Option<&'a Booking>,
);

/// Shows a judge the tick that is just over.
pub fn observe(world: &mut World, judge: &mut Judge) {
    let mut ball = world.query_filtered::<(&Pose, &Twist), With<Ball>>();
    let mut robots = world.query::<Seen>();
    let world = &*world;
    let Ok((ball, motion)) = ball.single(world) else { return };
    let strategies = world.resource::<Strategies>();
    let mut scenes: Vec<RobotScene> =
        robots.iter(world).map(|seen| robot_scene(seen, strategies.of(seen.0.team))).collect();
    scenes.sort_unstable_by_key(|robot| robot.id);
    judge.observe(&Scene {
        tick: world.resource::<Clock>().tick,
        pitch: world.resource::<Pitch>(),
        ball: ball.position,
        ball_velocity: motion.linear,
        robots: scenes,
        score: world.resource::<MatchState>().score,
        messages: world.resource::<MessageCounts>(),
    });
}

fn robot_scene<'a>(
    (id, robot, pose, twist, role, activity, picture, swapping, booking): Seen,
    strategy: &'a Strategy,
) -> RobotScene<'a> {
    let configuration = swapping.and_then(|swapping| swapping.machine.configuration());
    RobotScene {
        id: *id,
        pose: *pose,
        speed: twist.linear.length(),
        on: !robot.condition.crashed,
        role: &strategy.roles[role.0].name,
        acting_as: &strategy.roles[activity.acting_as].name,
        activity: &strategy.state(activity.machine(strategy), activity.state).name,
        claims: picture.has_ball,
        holder: if picture.has_ball { Some(id.number) } else { picture.carrier.map(|(number, _)| number) },
        goes: booking.is_some_and(|booking| booking.0.goes()),
        booker: match picture.booking {
            Standing::Own => Some(id.number),
            Standing::Mate(number) => Some(number),
            Standing::Free => None,
        },
        locked_by: swapping.and_then(|swapping| swapping.machine.lock()).map(|lock| lock.by),
        configuration: configuration.map(fingerprint),
    }
}

fn fingerprint(value: &impl Hash) -> u64 {
    Xxh3DefaultBuilder.hash_one(value)
}
