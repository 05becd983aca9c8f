//! Who reads and writes what in a tick: everything that belongs to a match is registered, and is written by one stage.

use std::collections::{BTreeMap, BTreeSet};

use bevy::ecs::component::ComponentId;
use bevy::ecs::schedule::SystemSet;
use bevy::ecs::system::System;
use bevy::prelude::*;
use bevy_rapier2d::prelude::{RapierRigidBodyHandle, RapierRigidBodySet};
use touchline::comms::radio::{Channel, FaultRules, RadioRecord};
use touchline::comms::tcm::{MessageBudgets, Registry, Tcm, TcmClient};
use touchline::game::Match;
use touchline::game::net::{LeaguePorts, UdpCarrier};
use touchline::ids::{MatchEntity, RobotId};
use touchline::mind::perception::Memory;
use touchline::robot::{HeadIntent, KickIntent, RobotBodies, SteeringIntent, Trailer};
use touchline::schedule::{Tick, TickSystems};
use touchline::state::StateRegister;
use touchline::strategy::{Activity, Role};
use touchline::world::ball::{Ball, Rolling};
use touchline::world::referee::PenaltiesDue;
use touchline::world::sense::HallLight;

use crate::support::friendly;

use TickSystems::*;

const STAGES: [TickSystems; 12] = [
    Script, Deliver, Sense, WorldModel, Teamwork, Behaviour, Motor, Drive, Physics, Referee, Transmit, Record,
];

/// What the systems of one stage read and write.
#[derive(Default)]
struct Access {
    all: BTreeSet<ComponentId>,
    written: BTreeSet<ComponentId>,
}

/// By stage, in their order. What commands and observers do is not in it.
fn accesses(game: &mut Match) -> Vec<(TickSystems, Access)> {
    game.world_mut().schedule_scope(Tick, |world, schedule| {
        let keys: Vec<_> = schedule.graph().systems.iter().map(|(key, ..)| key).collect();
        let mut by_system = BTreeMap::new();
        for key in keys {
            let system = schedule.graph_mut().systems.get_mut(key).expect("it was just listed");
            by_system.insert(key, system.initialize(world));
        }
        schedule.initialize(world).expect("the schedule can be built");
        let of_stage = |stage: &TickSystems| {
            let mut access = Access::default();
            let systems = schedule.graph().systems_in_set(stage.intern()).expect("each stage has systems");
            for set in systems.iter().filter_map(|key| by_system.get(key)) {
                let combined = set.combined_access();
                let bounded = "no system of a tick may take hold of everything";
                access.all.extend(combined.try_reads_and_writes().expect(bounded).iter());
                access.written.extend(combined.try_writes().expect(bounded).iter());
            }
            (*stage, access)
        };
        STAGES.iter().map(of_stage).collect()
    })
}

/// The name of a component; Bevy knows it only with its `debug` feature, as in a build with a window.
fn name(game: &Match, id: ComponentId) -> String {
    let world = game.world();
    let registered = world.resource::<StateRegister>().kinds().iter().find(|kind| kind.id == id);
    let unknown = || world.components().get_info(id).map_or_else(String::new, |info| info.name().to_string());
    registered.map_or_else(unknown, |kind| kind.name.to_owned())
}

fn id_of<T: Component>(game: &mut Match) -> ComponentId {
    game.world_mut().register_component::<T>()
}

/// What systems use and no snapshot holds, since it stays as it is during a match, or cannot be copied.
fn unregistered(game: &mut Match) -> Vec<ComponentId> {
    let fixed = [
        id_of::<Name>(game),
        id_of::<MatchEntity>(game),
        id_of::<RobotId>(game),
        id_of::<Trailer>(game),
        id_of::<Ball>(game),
        id_of::<RobotBodies>(game),
        id_of::<RapierRigidBodyHandle>(game),
        // The types of data that modules wait for.
        id_of::<Registry>(game),
        // Bevy's mark of resources.
        id_of::<bevy::ecs::resource::IsResource>(game),
    ];
    // Sockets: a match over a network cannot be rewound.
    let sockets = [id_of::<UdpCarrier>(game), id_of::<LeaguePorts>(game)];
    fixed.into_iter().chain(sockets).collect()
}

/// What stages use and nobody has registered, with the stage.
fn forgotten(game: &mut Match) -> Vec<(TickSystems, String)> {
    let known = unregistered(game);
    let accesses = accesses(game);
    let kinds: BTreeSet<_> =
        game.world().resource::<StateRegister>().kinds().iter().map(|kind| kind.id).chain(known).collect();
    let unknown = |access: &Access| access.all.difference(&kinds).copied().collect::<Vec<_>>();
    let of_stage = |(stage, access): &(TickSystems, Access)| {
        unknown(access).into_iter().map(|id| (*stage, name(game, id))).collect::<Vec<_>>()
    };
    accesses.iter().flat_map(of_stage).collect()
}

#[test]
fn all_state_that_a_tick_uses_is_registered() {
    assert_eq!(forgotten(&mut Match::new(&friendly(1, 1.0))), []);
}

#[derive(Resource, Clone, Default)]
struct Whim(u32);

#[test]
fn state_that_nobody_registered_is_found() {
    let mut game = Match::new(&friendly(1, 1.0));
    game.world_mut().init_resource::<Whim>();
    game.world_mut().schedule_scope(Tick, |_, schedule| {
        schedule.add_systems((|mut whim: ResMut<Whim>| whim.0 += 1).in_set(Teamwork));
    });
    let found = forgotten(&mut game);
    assert!(matches!(&found[..], [(Teamwork, _)]), "{found:?}");
}

#[test]
fn a_match_has_all_resources_that_start_with_it() {
    let mut game = Match::new(&friendly(1, 1.0));
    // They are there where a network is, or where somebody keeps the requests.
    let optional = ["BoxNews", "MessageBudgets", "RequestLog"];
    let world = game.world_mut();
    let kinds = world.resource::<StateRegister>().kinds().to_vec();
    let resources = kinds.iter().filter(|kind| kind.is_resource && !optional.contains(&kind.name));
    let missing = resources.filter(|kind| !world.contains_resource_by_id(kind.id)).map(|kind| kind.name);
    assert_eq!(missing.collect::<Vec<_>>(), [""; 0]);
}

const ELSEWHERE: &str = "a robot in another process decides there, and its news come as requests";

/// What several stages write, and why.
fn shared(game: &mut Match) -> Vec<(ComponentId, &'static [TickSystems], &'static str)> {
    vec![
        (id_of::<RapierRigidBodySet>(game), &[Drive, Physics], "wheels and legs push what the step moves"),
        (id_of::<Rolling>(game), &[Drive, Physics], "a kick sets the ball rolling, the carpet slows it down"),
        (id_of::<Memory>(game), &[Behaviour, Motor], "features and schemas share operators"),
        (id_of::<TcmClient>(game), &[Teamwork, Transmit], "a queue: modules put in, the TCM takes out"),
        (id_of::<PenaltiesDue>(game), &[Script, Referee], "a queue: requests put in, the referee takes out"),
        (id_of::<Tcm>(game), &[Deliver, Transmit], "one module that receives first and sends last"),
        (id_of::<RadioRecord>(game), &[Deliver, Transmit], "what was sent, and what became of it"),
        (id_of::<UdpCarrier>(game), &[Script, Deliver, Transmit], "a socket receives and sends"),
        (id_of::<MessageBudgets>(game), &[Script, Transmit], ELSEWHERE),
        (id_of::<SteeringIntent>(game), &[Script, Motor], ELSEWHERE),
        (id_of::<KickIntent>(game), &[Script, Motor], ELSEWHERE),
        (id_of::<HeadIntent>(game), &[Script, Motor], ELSEWHERE),
        (id_of::<Role>(game), &[Script, Teamwork], ELSEWHERE),
        (id_of::<Activity>(game), &[Script, Behaviour], ELSEWHERE),
        (id_of::<touchline::mind::world_model::WorldModel>(game), &[Script, WorldModel], ELSEWHERE),
        (id_of::<Channel>(game), &[Script, Transmit], "requests change the radio, packets move its dice"),
        (id_of::<HallLight>(game), &[Script, Sense], "requests change the light, and it drifts"),
        (id_of::<FaultRules>(game), &[Script, Transmit], "requests add rules, packets use them up"),
    ]
}

/// What more stages write than may, with those stages; and what is allowed and not needed.
fn offences(game: &mut Match) -> Vec<(String, Vec<TickSystems>)> {
    let shared = shared(game);
    let mut writers: BTreeMap<ComponentId, Vec<TickSystems>> = BTreeMap::new();
    for (stage, access) in accesses(game) {
        access.written.into_iter().for_each(|id| writers.entry(id).or_default().push(stage));
    }
    let allowed =
        |id: &ComponentId| shared.iter().find(|(shared, ..)| shared == id).map(|(_, stages, _)| *stages);
    let fits = |(id, stages): &(&ComponentId, &Vec<TickSystems>)| match allowed(id) {
        Some(allowed) => allowed == &stages[..],
        None => stages.len() == 1,
    };
    let wrong = writers.iter().filter(|writer| !fits(writer));
    wrong.map(|(id, stages)| (name(game, *id), stages.clone())).collect()
}

#[test]
fn each_component_and_resource_is_written_by_one_stage() {
    assert_eq!(offences(&mut Match::new(&friendly(1, 1.0))), []);
}

#[test]
fn a_second_writer_is_found() {
    let mut game = Match::new(&friendly(1, 1.0));
    game.world_mut().schedule_scope(Tick, |_, schedule| {
        schedule
            .add_systems((|mut log: ResMut<touchline::world::referee::Calls>| log.0.clear()).in_set(Sense));
    });
    assert_eq!(offences(&mut game), [("Calls".to_owned(), vec![Sense, Referee])]);
}
