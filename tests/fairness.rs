//! No side has an advantage: what happens between two robots does not depend on which of them comes first in the program's order.

use std::collections::BTreeMap;
use std::f32::consts::PI;

use bevy::prelude::*;
use touchline::game::requests::{Request, Requests};
use touchline::game::{Choice, Match, MatchPlan, Placed, Situation};
use touchline::geometry::Pose;
use touchline::ids::{RobotId, Team};
use touchline::rng::{Dice, Seed};
use touchline::robot::KickIntent;
use touchline::robot::handling::Handling;
use touchline::robot::pilot::Pilot;

use crate::support::{assets, ball};

/// A match of two AIBOs that stand on opposite sides of a ball on the centre spot and look at it.
struct Duels {
    plan: MatchPlan,
}

impl Duels {
    fn new() -> Duels {
        let choice = Choice {
            file: Some("four_legged_2005".into()),
            home: Some("chaos_plain".into()),
            away: Some("chaos_plain".into()),
            seed: 1,
            ..Choice::default()
        };
        Duels { plan: MatchPlan::read(&assets(), &choice).expect("the shipped match is sound") }
    }

    /// The home robot stands `apart` metres west of the ball and `aside` metres to its own left; the other one is its image.
    fn start(&mut self, seed: u64, apart: f32, aside: f32) -> Match {
        self.plan.seed = seed;
        let at = Vec2::new(-apart, aside);
        let placed = |at: Vec2, heading| Placed { pose: Pose::new(at.x, at.y, heading), on: true };
        let robots = BTreeMap::from([
            (RobotId::new(Team::Home, 1), placed(at, 0.0)),
            (RobotId::new(Team::Away, 1), placed(-at, PI)),
        ]);
        self.plan.situation =
            Some(Situation { refereed: false, robots, ball: Vec2::ZERO, velocity: Vec2::ZERO });
        Match::new(&self.plan)
    }
}

/// Both robots, driven by people, want the same of the ball for some ticks.
fn both(game: &mut Match, kick: KickIntent, ticks: usize) {
    for team in Team::BOTH {
        game.world_mut().resource_mut::<Requests>().ask(Request::TakeOver(RobotId::new(team, 1)));
    }
    for _ in 0..ticks {
        for team in Team::BOTH {
            let pilot = Pilot { kick, ..Pilot::default() };
            let robot = RobotId::new(team, 1);
            game.world_mut().resource_mut::<Requests>().ask(Request::Steer { robot, pilot });
        }
        game.tick();
    }
}

/// How often home did better among `decided` cases, as standard deviations off a half.
fn deviation(home: usize, decided: usize) -> f64 {
    (2.0 * home as f64 - decided as f64) / (decided as f64).sqrt()
}

/// The chest kick that both begin in one tick meets the ball in one tick. If one of the two counted more, it would win nearly all of
/// the 60 cases.
#[test]
fn two_kicks_in_one_tick_send_the_ball_to_either_side_alike() {
    let mut duels = Duels::new();
    let chest = duels.plan.teams[0].kind.kicks.keys().position(|name| name == "chest").expect("it can kick");
    let (mut east, mut decided) = (0, 0);
    for seed in 1..=60 {
        let mut game = duels.start(seed, 0.2, 0.0);
        both(&mut game, KickIntent::Kick(chest), 30);
        let x = ball(&mut game).0.position.x;
        decided += usize::from(x != 0.0);
        east += usize::from(x > 0.0);
    }
    let deviation = deviation(east, decided);
    assert!(decided > 40 && deviation.abs() < 3.3, "{east} of {decided}, {deviation:.1} deviations");
}

/// Two chins that go down in one tick. If one of the two counted more, it would win all of the cases in which both get there.
#[test]
fn of_two_chins_in_one_tick_either_gets_the_ball_alike_and_never_both() {
    let mut duels = Duels::new();
    let mut caught = [0; 2];
    for seed in 1..=80 {
        let mut game = duels.start(seed, 0.2, 0.0);
        both(&mut game, KickIntent::Hold, 30);
        let mut robots = game.world_mut().query::<(&RobotId, &Handling)>();
        let holders: Vec<Team> = robots
            .iter(game.world())
            .filter(|(_, handling)| handling.holds())
            .map(|(id, _)| id.team)
            .collect();
        assert!(holders.len() <= 1, "seed {seed}: both hold the ball");
        holders.iter().for_each(|team| caught[team.index()] += 1);
    }
    let decided = caught[0] + caught[1];
    let deviation = deviation(caught[0], decided);
    assert!(decided > 40 && deviation.abs() < 3.3, "{caught:?}, {deviation:.1} deviations");
}

/// Duels from mirrored starts, played by the shipped strategy without booking: whoever brings the ball 0.8 m toward its goal wins.
///
/// With 500 decided duels a side whose true share of wins is 0.60 is found in 88 of 100 such tests, one with 0.57 in 43, and one
/// with 0.523, as measured over 4,000 duels when kicks were carried out in the order of robots, in 1: it takes thousands of duels
/// to see that little, and the two tests above to see where it came from.
#[test]
fn mirrored_duels_are_won_by_either_side_alike() {
    let (mut duels, mut wins) = (Duels::new(), [0; 2]);
    for seed in 1..=DUELS {
        let aside = 0.6 * (Dice::new(Seed(seed), "start", None).uniform() - 0.5);
        let mut game = duels.start(seed, 0.8, aside);
        let end = (0..1200).find_map(|_| {
            game.tick();
            let x = ball(&mut game).0.position.x;
            (x.abs() > 0.8).then_some(x)
        });
        match end {
            Some(x) if x > 0.0 => wins[0] += 1,
            Some(_) => wins[1] += 1,
            None => {}
        }
    }
    let decided = wins[0] + wins[1];
    let deviation = deviation(wins[0], decided);
    assert!(decided >= 500 && deviation.abs() < 3.3, "{wins:?}, {deviation:.1} deviations");
}

/// As many as it takes for 500 that are decided.
const DUELS: u64 = 750;
