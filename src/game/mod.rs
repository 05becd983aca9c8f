//! A match: read as a [`MatchPlan`], started in a world, played tick by tick.

mod carry;
mod files;
mod line_up;
pub mod net;
mod plan;
pub mod record;
pub mod requests;
mod situation;
mod spawn;
mod team;

use bevy::prelude::*;
pub(crate) use files::{checked, file_named, read_addresses};
pub use plan::{Choice, DEFAULT_MATCH, MatchFile, MatchPlan};
pub(crate) use team::read_strategy_alone;
pub use team::{TeamFile, TeamPlan};

pub use situation::{Placed, Situation};

use crate::clock::Clock;
use crate::comms::radio::{Channel, FaultRules};
use crate::comms::tcm::Addresses;
use crate::game::record::Record;
use crate::game::requests::{RequestLog, Script};
use crate::ids::{MatchEntity, RobotId, Team};
use crate::rng::Seed;
use crate::schedule::{self, Tick};
use crate::state;
use crate::strategy::Strategies;
use crate::world::physics::open_world;
use crate::world::referee::{MatchState, Phase};
use crate::{comms, mind, pitch, robot, world};
use spawn::{spawn_ball, spawn_mind, spawn_robot};

/// Everything that a match needs, without a window.
pub fn simulation(app: &mut App) {
    let game = (carry::plugin, requests::plugin, net::plugin, record::plugin);
    let contract = (schedule::plugin, pitch::plugin, robot::plugin);
    app.add_plugins((contract, world::plugin, comms::plugin, mind::plugin, game));
}

/// Ends the match in this world, if there is one, and starts another from the beginning.
pub fn start_match(world: &mut World, plan: &MatchPlan) {
    let mut old = world.query_filtered::<Entity, With<MatchEntity>>();
    for entity in old.iter(world).collect::<Vec<_>>() {
        world.despawn(entity);
    }
    net::close(world);
    begin(world, plan);
    begin_match(world, plan);
    open_world(world, &plan.pitch, MatchEntity);
    spawn_ball(world, plan);
    for id in plan.robots() {
        spawn_robot(world, plan, id);
    }
    net::prepare(world, plan);
}

/// Puts one robot of a match into this world, without a body and without anybody else, for a process of its own.
pub fn start_mind(world: &mut World, plan: &MatchPlan, robot: RobotId) -> Entity {
    begin(world, plan);
    spawn_mind(world, plan, robot)
}

/// Inserts the resources of a match and of a mind alone: those that start empty, and those of the plan.
fn begin(world: &mut World, plan: &MatchPlan) {
    state::begin(world);
    world.insert_resource(Seed(plan.seed));
    world.insert_resource(plan.pitch.clone());
    world.insert_resource(plan.ball);
    world.insert_resource(Strategies(plan.teams.each_ref().map(|team| team.strategy.clone())));
    world.insert_resource(Addresses(plan.directory()));
    world.insert_resource(plan.tcm);
}

/// Inserts the resources of a match that start from the plan.
fn begin_match(world: &mut World, plan: &MatchPlan) {
    let seed = Seed(plan.seed);
    world.insert_resource(plan.rules.clone());
    world.insert_resource(match &plan.situation {
        Some(situation) => MatchState::in_play(Team::Home, &plan.rules, situation.refereed),
        None => MatchState::new(Team::Home, &plan.rules),
    });
    world.insert_resource(Record::new(seed, plan.robots()));
    world.insert_resource(Script::new(&plan.script));
    world.insert_resource(Channel::new(seed, plan.radio.clone()));
    world.insert_resource(FaultRules::new(plan.faults.iter().cloned()));
    if let Some(mut log) = world.get_resource_mut::<RequestLog>() {
        log.0.clear();
    }
}

/// A match without a window, run as fast as it can.
pub struct Match {
    app: App,
}

impl Match {
    /// Starts a match in an app of its own.
    pub fn new(plan: &MatchPlan) -> Match {
        let mut app = App::new();
        app.add_plugins(simulation);
        app.finish();
        app.cleanup();
        start_match(app.world_mut(), plan);
        Match { app }
    }

    /// Plays one tick.
    pub fn tick(&mut self) {
        let world = self.app.world_mut();
        world.run_schedule(Tick);
        // Otherwise the world remembers every message that has ever been delivered.
        world.clear_trackers();
    }

    /// Whether the last half is over.
    pub fn is_over(&self) -> bool {
        self.app.world().resource::<MatchState>().phase == Phase::Finished
    }

    /// The world of the match.
    pub fn world(&self) -> &World {
        self.app.world()
    }

    /// The world of the match, to be changed.
    pub fn world_mut(&mut self) -> &mut World {
        self.app.world_mut()
    }

    /// Where the match stands.
    pub fn state(&self) -> &MatchState {
        self.app.world().resource::<MatchState>()
    }

    /// What was recorded so far.
    pub fn record(&self) -> &Record {
        self.app.world().resource::<Record>()
    }

    /// The match's clock.
    pub fn clock(&self) -> Clock {
        *self.app.world().resource::<Clock>()
    }
}
