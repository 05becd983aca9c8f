//! What is played in a duel: both strategies on either side of a match, and how each trial begins.

use std::collections::BTreeMap;

use bevy::prelude::{Vec2, With};

use super::choice::DuelChoice;
use super::judge::{DuelJudge, TrialResult};
use super::report::DuelReport;
use super::start::{BALL, mirrored_start, on_pitch};
use crate::data::{AssetFolder, DataError};
use crate::game::{Choice, Match, MatchPlan, Placed, Situation};
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::rng::{Dice, LARGEST_SEED, Seed};
use crate::world::ball::Ball;
use crate::world::physics::Footprint;

/// A duel that can be played.
#[derive(Clone, Debug)]
pub struct DuelPlan {
    /// The first side at home, and away.
    matches: [MatchPlan; 2],
    choice: DuelChoice,
}

impl DuelPlan {
    /// Reads everything that a duel needs.
    ///
    /// # Errors
    /// The first file that is missing or wrong, or the option that asks for what cannot be.
    pub fn read(assets: &AssetFolder, choice: &DuelChoice) -> Result<DuelPlan, DataError> {
        if !choice.trials.is_multiple_of(2) {
            let message = format!("must be even, not {}: each start is played on both sides", choice.trials);
            return Err(DataError::new("--trials", message));
        }
        let usual = MatchPlan::read(assets, &chosen(choice, &choice.home, &choice.away))?;
        let [home, away] = [0, 1].map(|side| usual.teams[side].names.strategy.clone());
        let swapped = MatchPlan::read(assets, &chosen(choice, &Some(away), &Some(home)))?;
        let plan = DuelPlan { matches: [usual, swapped], choice: choice.clone() };
        for (side, robots) in choice.teams.0.into_iter().enumerate() {
            let strategy = &plan.matches[0].teams[side].strategy;
            let players = strategy.players.len();
            if usize::from(robots) > players {
                let message =
                    format!("{robots} robots are more than the {players} players of {}", strategy.name);
                return Err(DataError::new("--robots", message));
            }
        }
        if plan.start(0).is_none() {
            return Err(DataError::new("--robots", "so many robots find no room around the ball"));
        }
        Ok(plan)
    }

    /// How many trials there are.
    pub fn trials(&self) -> u32 {
        self.choice.trials
    }

    /// The names of the strategies and of the kinds of their robots, the first side's first.
    pub fn names(&self) -> [[String; 2]; 2] {
        self.matches[0].teams.each_ref().map(|team| [team.strategy.name.clone(), team.kind.name.clone()])
    }

    /// The match of a trial, counted from 0, and the team that the first side is in it.
    pub fn trial(&self, number: u32) -> Option<(MatchPlan, Team)> {
        let first_is_home = number.is_multiple_of(2);
        let poses = on_pitch(self.start(number / 2)?, first_is_home);
        let mut plan = self.matches[usize::from(!first_is_home)].clone();
        plan.seed = self.seed(number);
        let robots: BTreeMap<RobotId, Placed> = (Team::BOTH.into_iter().zip(poses))
            .flat_map(|(team, poses)| {
                let players = plan.team(team).strategy.players.len();
                place_last(team, players, poses)
            })
            .collect();
        plan.situation = Some(Situation { refereed: false, robots, ball: BALL, velocity: Vec2::ZERO });
        Some((plan, if first_is_home { Team::Home } else { Team::Away }))
    }

    /// Plays a trial.
    pub fn play(&self, number: u32) -> Option<TrialResult> {
        let (plan, first) = self.trial(number)?;
        let mut game = Match::new(&plan);
        let mut judge = DuelJudge::new(self.choice.seconds);
        let dt = f64::from(game.clock().dt);
        loop {
            game.tick();
            let ball = ball_of(&mut game)?;
            if let Some(outcome) = judge.observe(ball.position, dt) {
                return Some(TrialResult { first, outcome });
            }
        }
    }

    /// Plays all trials, or until it is to stop; says after each how many are over.
    pub fn run(&self, mut goes_on: impl FnMut(u32) -> bool) -> DuelReport {
        let played = (0..self.trials()).map_while(|number| {
            let result = self.play(number)?;
            goes_on(number + 1).then_some(result)
        });
        DuelReport::new(self.names(), &self.choice, &played.collect::<Vec<_>>())
    }

    /// How both sides begin a pair of trials, in the frame of the first side.
    fn start(&self, pair: u32) -> Option<[Vec<Pose>; 2]> {
        let footprints = self.matches[0].teams.each_ref().map(|team| Footprint::of_robot(&team.kind));
        let mut dice = Dice::new(Seed(self.seed(2 * pair)), "duel", None);
        mirrored_start(self.choice.teams.0.map(usize::from), footprints.each_ref(), &mut dice)
    }

    fn seed(&self, number: u32) -> u64 {
        self.choice.seed.wrapping_add(u64::from(number)) & LARGEST_SEED
    }
}

fn chosen(choice: &DuelChoice, home: &Option<String>, away: &Option<String>) -> Choice {
    Choice {
        file: choice.file.clone(),
        home: home.clone(),
        away: away.clone(),
        seed: choice.seed,
        ..Choice::default()
    }
}

/// The players with the highest numbers take these places: the goalkeeper has the lowest.
fn place_last(team: Team, players: usize, poses: Vec<Pose>) -> impl Iterator<Item = (RobotId, Placed)> {
    let numbers = (0..players as u8).rev();
    let placed = move |(number, pose)| (RobotId::new(team, number), Placed { pose, on: true });
    numbers.zip(poses).map(placed)
}

fn ball_of(game: &mut Match) -> Option<Pose> {
    let world = game.world_mut();
    let mut balls = world.query_filtered::<&Pose, With<Ball>>();
    balls.single(world).ok().copied()
}
