//! Puts a match, or the mind of one robot, into a world.

use bevy::prelude::*;

use super::net;
use super::plan::MatchPlan;
use super::record::Record;
use super::requests::{RequestLog, Script};
use super::spawn::{spawn_ball, spawn_mind, spawn_robot};
use crate::comms::radio::{Channel, FaultRules};
use crate::comms::tcm::Addresses;
use crate::ids::{MatchEntity, RobotId, Team};
use crate::rng::{Dice, Seed};
use crate::state;
use crate::strategy::{Strategies, StrategySources};
use crate::world::physics::{open_world, turn_to_poses};
use crate::world::referee::MatchState;
use crate::world::sense::{HallLight, Light};

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
    for id in in_drawn_order(plan) {
        spawn_robot(world, plan, id);
    }
    // There are bodies, so it runs.
    let _ = world.run_system_cached(turn_to_poses);
    net::prepare(world, plan);
}

/// The robots of a match, one team after the other; a coin decides which is first. Rapier solves contacts one after the other in
/// the order in which bodies are registered, which must favour neither side over many seeds.
fn in_drawn_order(plan: &MatchPlan) -> Vec<RobotId> {
    let away_first = Dice::new(Seed(plan.seed), "registration", None).chance(0.5);
    let first = if away_first { Team::Away } else { Team::Home };
    let mut robots: Vec<RobotId> = plan.robots().collect();
    robots.sort_by_key(|id| id.team != first);
    robots
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
    world.insert_resource(StrategySources(plan.teams.each_ref().map(|team| team.strategy_texts.clone())));
    world.insert_resource(Addresses(plan.directory()));
    world.insert_resource(plan.tcm);
}

/// Inserts the resources of a match that start from the plan.
fn begin_match(world: &mut World, plan: &MatchPlan) {
    let seed = Seed(plan.seed);
    world.insert_resource(plan.rules.clone());
    world.insert_resource(HallLight::new(Light::new(plan.light), seed));
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
