//! What robots believe of their team, and swap machines between a strategy and a restart.

use super::*;
use crate::clock::Clock;
use crate::comms::messages::Values;
use crate::data::{AssetFolder, AssetKind};
use crate::ids::{RobotId, Team};
use crate::protocol::role_swap::{Assignment, Phase};
use crate::rng::Seed;
use crate::strategy::Strategy;
use crate::testing::idle;

fn picture() -> TeamPicture {
    TeamPicture::of(Assignment::new([0, 1, 2, 3]))
}

#[test]
fn a_robot_said_to_have_a_role_changes_with_whoever_was_believed_to_have_it() {
    let mut picture = picture();
    picture.note_role(1, 3);
    assert_eq!(picture.roles, Assignment::new([0, 3, 2, 1]));
    picture.note_role(1, 3);
    assert_eq!(picture.roles, Assignment::new([0, 3, 2, 1]));
    picture.note_role(7, 1);
    assert_eq!(picture.roles, Assignment::new([0, 3, 2, 1]), "the team has no robot 7");
}

#[test]
fn values_grow_old() {
    let mut picture = picture();
    let values = Values { time: 5, robot: 2, values: vec![0.5, 1.0], wish: Some(1) };
    picture.values.push((2, values, 60));
    let clock = Clock { tick: 90, ..Clock::new(60.0) };
    let known = picture.values_of(2, &clock).expect("robot 2 told them");
    assert!((known.age - 0.5).abs() < 1e-5 && known.wish == Some(1));
    assert_eq!(picture.values_of(3, &clock), None);
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
        assert_eq!((machine.phase(), machine.lock()), (Phase::Idle, None));
    }
}
