//! What must hold of every match is looked at in every match, and what breaks it is found.

use bevy::prelude::*;
use bevy_rapier2d::prelude::*;
use touchline::data::AssetFolder;
use touchline::game::record::{Invariant, Invariants};
use touchline::game::{Choice, Match, MatchPlan, Placed, Situation};
use touchline::geometry::Pose;
use touchline::ids::{RobotId, Team};
use touchline::lab::scenario::{RunWatcher, ScenarioPlan, ScenarioRef};
use touchline::robot::RobotBodies;
use touchline::world::ball::Ball;

use crate::support::{assets, friendly};

/// What the runs of a scenario have broken.
#[derive(Default)]
struct Broken {
    runs: Vec<Invariants>,
}

impl RunWatcher for Broken {
    fn begin(&mut self, _: (Vec2, u64), game: &mut Match) {
        self.runs.push(game.world().resource::<Invariants>().clone());
    }

    fn after_tick(&mut self, game: &mut Match) {
        if let Some(last) = self.runs.last_mut() {
            last.clone_from(game.world().resource::<Invariants>());
        }
    }
}

/// In how many of its runs a variant of a scenario breaks an invariant of home, and in how many there are.
fn broken_by(name: &str, variant: &str, invariant: Invariant) -> (usize, usize) {
    let assets = assets();
    let plans = ScenarioPlan::read_all(&assets, &ScenarioRef::named(&assets, name)).expect("it is sound");
    let plan = plans.iter().find(|plan| plan.origin.variant.as_deref() == Some(variant));
    let mut broken = Broken::default();
    plan.expect("it has the variant").run_watched(None, &mut broken);
    let is_broken = |run: &&Invariants| run.broken.contains_key(&(invariant, Some(Team::Home)));
    (broken.runs.iter().filter(is_broken).count(), broken.runs.len())
}

#[test]
fn the_papers_swap_breaks_where_two_messages_are_lost_and_the_hardened_one_does_not() {
    let name = "counterexample_03_two_generals_two_losses";
    let (broken, runs) = broken_by(name, "paper", Invariant::OneRobotARole);
    assert_eq!(broken, runs, "a role is doubled for good");
    assert_eq!(broken_by(name, "hardened", Invariant::OneRobotARole).0, 0);
}

fn played(assets: &AssetFolder, choice: Choice) -> Invariants {
    let plan = MatchPlan::read(assets, &choice).expect("the match is sound");
    let mut game = Match::new(&plan);
    while !game.is_over() {
        game.tick();
    }
    game.world().resource::<Invariants>().clone()
}

#[test]
fn several_robots_drive_at_a_booked_ball_for_longer_where_nobody_hears_of_a_booking() {
    let seconds = |radio: &str| {
        let choice = Choice {
            file: Some("four_legged_2005".into()),
            radio: Some(radio.into()),
            half_minutes: Some(1.0),
            ..Choice::default()
        };
        let invariants = played(&assets(), choice);
        assert!(!invariants.is_unsafe(), "{:?}", invariants.breaches);
        let count = invariants.broken.get(&(Invariant::OneAtBookedBall, Some(Team::Home)));
        count.map_or(0.0, |count| count.seconds)
    };
    let (heard, unheard) = (seconds("perfect"), seconds("dead"));
    assert!(unheard > 5.0 + heard, "{unheard} s without a radio, {heard} s with one");
}

#[test]
fn whatever_radio_and_strategy_what_is_safe_stays_safe() {
    for (home, away, radio) in [
        ("hammerheads_swap", "hammerheads_swap_paper", "awful"),
        ("art", "cs_freiburg", "bursty"),
        ("italian_golem", "rmit", "awful"),
    ] {
        let choice = Choice {
            home: Some(home.into()),
            away: Some(away.into()),
            radio: Some(radio.into()),
            half_minutes: Some(1.0),
            ..Choice::default()
        };
        let invariants = played(&assets(), choice);
        assert!(!invariants.is_unsafe(), "{home} against {away}: {:?}", invariants.breaches);
        let inside = invariants.broken.keys().any(|(invariant, _)| *invariant == Invariant::RobotsAreSolid);
        assert!(!inside, "{home} against {away}: {:?}", invariants.breaches);
    }
}

/// Two robots that stand apart, the ball, and one of their bodies that is held for so many ticks, so far from the away robot, m; what is
/// broken then.
fn held(what: Held, apart: f32, ticks: u32) -> Invariants {
    let mut plan = friendly(1, 1.0);
    let robots = [RobotId::new(Team::Home, 1), RobotId::new(Team::Away, 2)];
    let placed = robots.map(|id| {
        let x = if id.team == Team::Home { -1.0 } else { 1.0 };
        (id, Placed { pose: Pose::new(x, 1.0, 0.0), on: true })
    });
    plan.situation = Some(Situation {
        refereed: false,
        robots: placed.into_iter().collect(),
        ball: Vec2::new(0.0, -1.0),
        velocity: Vec2::ZERO,
    });
    let mut game = Match::new(&plan);
    for _ in 0..ticks {
        let world = game.world_mut();
        let mut bodies = world.query::<(&RobotId, &RobotBodies)>();
        let [one, other] = robots.map(|robot| {
            let found = bodies.iter(world).find(|(id, _)| **id == robot);
            found.map(|(_, bodies)| bodies.unit.0).expect("it has a body")
        });
        let mut balls = world.query_filtered::<&RapierRigidBodyHandle, With<Ball>>();
        let moved = match what {
            Held::Robot => one,
            Held::Ball => balls.single(world).expect("there is one ball").0,
        };
        let mut sets = world.query::<&mut RapierRigidBodySet>();
        let mut set = sets.single_mut(world).expect("one physical world");
        let there = set.bodies[other].translation() + Vec2::new(0.0, apart);
        set.bodies[moved].set_translation(there, true);
        game.tick();
    }
    game.world().resource::<Invariants>().clone()
}

#[derive(Clone, Copy)]
enum Held {
    Robot,
    Ball,
}

/// The robots that each breach of an invariant is about.
fn told(invariants: Invariants, invariant: Invariant) -> Vec<Vec<RobotId>> {
    let found = invariants.breaches.into_iter().filter(|it| it.invariant == invariant);
    found.map(|breach| breach.robots).collect()
}

#[test]
fn a_robot_that_is_held_in_another_one_is_told_and_one_that_stands_beside_it_is_not() {
    let told = |apart, ticks| told(held(Held::Robot, apart, ticks), Invariant::RobotsAreSolid);
    let [one, other] = [RobotId::new(Team::Home, 1), RobotId::new(Team::Away, 2)];
    assert_eq!(told(0.1, 60), [vec![one], vec![other]]);
    assert!(told(0.1, 20).is_empty(), "as short as a push");
    assert!(told(1.0, 60).is_empty());
}

#[test]
fn a_ball_that_is_held_in_a_robot_is_told_and_one_that_lies_beside_it_is_not() {
    let told = |apart, ticks| told(held(Held::Ball, apart, ticks), Invariant::BallIsSolid);
    assert_eq!(told(0.1, 60), [Vec::new()], "it is nobody's");
    assert!(told(0.1, 20).is_empty(), "as short as a push");
    assert!(told(1.0, 60).is_empty());
}
