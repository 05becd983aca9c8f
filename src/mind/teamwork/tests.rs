//! What robots believe of their team, and swap machines between a strategy and a restart.

use std::sync::Arc;

use super::*;
use crate::clock::Clock;
use crate::comms::messages::{Inbox, Received, TeamMessage, Values};
use crate::data::{AssetFolder, AssetKind};
use crate::ids::{RobotId, Team};
use crate::protocol::arbitration::Bid;
use crate::protocol::role_swap::{Assignment, AttemptPhase};
use crate::rng::Seed;
use crate::robot::{Health, Robot, RobotFailure};
use crate::strategy::Strategy;
use crate::testing::{cye, idle, perfect_sensing};

fn model() -> TeamModel {
    TeamModel::of(Assignment::new([0, 1, 2, 3]))
}

#[test]
fn a_robot_said_to_have_a_role_changes_with_whoever_was_believed_to_have_it() {
    let mut team = model();
    team.note_role(1, 3);
    assert_eq!(team.roles, Assignment::new([0, 3, 2, 1]));
    team.note_role(1, 3);
    assert_eq!(team.roles, Assignment::new([0, 3, 2, 1]));
    team.note_role(7, 1);
    assert_eq!(team.roles, Assignment::new([0, 3, 2, 1]), "the team has no robot 7");
}

#[test]
fn values_grow_old() {
    let mut team = model();
    let values = Values { time: 5, robot: 2, values: vec![0.5, 1.0], wish: Some(1) };
    team.values.push((2, values, 60));
    let clock = Clock { tick: 90, ..Clock::new(60.0) };
    let known = team.values_of(2, &clock).expect("robot 2 told them");
    assert!((known.age - 0.5).abs() < 1e-5 && known.wish == Some(1));
    assert_eq!(team.values_of(3, &clock), None);
}

#[test]
fn what_actions_are_worth_to_team_mates_is_known_with_its_age() {
    let mut team = model();
    let values = Values { time: 5, robot: 2, values: vec![0.0, 1.5, 0.5, 0.25], wish: None };
    team.values.push((2, values, 60));
    let clock = Clock { tick: 120, ..Clock::new(60.0) };
    let bids: Vec<Bid> = team.bids(&clock).collect();
    assert_eq!(bids.len(), 1);
    assert_eq!((bids[0].number, &bids[0].values[..]), (2, &[0.0, 1.5, 0.5, 0.25][..]));
    assert!((bids[0].age - 1.0).abs() < 1e-5);
}

#[test]
fn a_strategy_without_role_swaps_has_no_swap_machines() {
    assert!(Swapping::new(&idle(), RobotId::new(Team::Home, 0), Seed(1)).is_none());
}

#[test]
fn the_shipped_team_with_swaps_starts_in_the_roles_of_kick_off_and_idle() {
    let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
    let path = assets.file(AssetKind::Strategy, "hammerheads_swap");
    let strategy = Strategy::read(&assets, &path, None).strategy.expect("the shipped strategy is sound");
    for number in 0..4 {
        let swapping = Swapping::new(&strategy, RobotId::new(Team::Home, number), Seed(1));
        let machine = swapping.expect("it swaps roles").machine;
        assert_eq!(usize::from(machine.role()), strategy.players[usize::from(number)]);
        assert_eq!((machine.phase(), machine.lock()), (AttemptPhase::Idle, None));
    }
}

#[test]
fn an_inbox_is_empty_after_each_decision_and_while_its_robot_does_not_hear() {
    let mut app = App::new();
    app.add_plugins(crate::schedule::plugin).add_systems(Tick, listen::take_messages);
    let clock = *app.world().resource::<Clock>();
    let robot = Robot::new(Arc::new(cye()), Arc::new(perfect_sensing()), &clock);
    let entity = app.world_mut().spawn((robot.clone(), Inbox::default())).id();
    let mut waiting = |tick: u64, health: Health| {
        app.world_mut().resource_mut::<Clock>().tick = tick;
        let mut body = app.world_mut().entity_mut(entity);
        body.get_mut::<Robot>().expect("it is a robot").health = health;
        let message = TeamMessage::Text("go".into());
        body.get_mut::<Inbox>().expect("it has one").0.push(Received { from: 1, message });
        app.world_mut().run_schedule(Tick);
        app.world().entity(entity).get::<Inbox>().expect("it has one").0.len()
    };
    let (decides, rests): (Vec<u64>, Vec<u64>) = (0..9).partition(|tick| robot.is_due(*tick));
    assert!(decides.len() > 1 && rests.len() > decides.len());
    let well = Health::default();
    let mut before = 0;
    for tick in 0..9 {
        let expected = if decides.contains(&tick) { 0 } else { before + 1 };
        before = waiting(tick, well);
        assert_eq!(before, expected, "tick {tick}");
    }
    assert_eq!(waiting(rests[0], well.with(RobotFailure::Deaf)), 0);
}
