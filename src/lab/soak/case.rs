//! One match of a soak, drawn by its seed.

use bevy::prelude::Vec2;

use super::pool::{FAULTS, SoakPool, SoakSide};
use super::trouble::Trouble;
use crate::game::record::Invariant;
use crate::ids::Team;
use crate::lab::scenario::{
    BallFile, BallPlaces, Condition, Expectation, PlayerFile, Referee, ScenarioFile, Seeds, SideFile,
};
use crate::rng::{Dice, Seed};

/// What must settle has settled so long after the faults, s: with the bound of an invariant on top.
pub(super) const SETTLE: f32 = 10.0;
/// How long a match takes, s.
pub(super) const LENGTH: f32 = FAULTS + SETTLE + 20.0;

/// What must settle when the faults have ended.
const LIVENESS: [Invariant; 3] = [Invariant::OneRobotARole, Invariant::NoRoleVacant, Invariant::BookerPlays];

impl SoakSide {
    fn file(&self, team: Team) -> SideFile {
        let (frame, facing) = match team {
            Team::Home => (1.0, 0.0),
            Team::Away => (-1.0, 180.0),
        };
        let place = |(number, at): (u8, &Vec2)| PlayerFile {
            number,
            // Without negative zeros.
            at: *at * frame + Vec2::ZERO,
            facing,
            role: None,
            off: false,
        };
        SideFile {
            strategy: Some(self.strategy.clone()),
            robot: Some(self.robot.clone()),
            sensing: Some(self.sensing.clone()),
            players: Some((0..).zip(&self.places[team.index()]).map(place).collect()),
            ..SideFile::default()
        }
    }
}

impl SoakPool {
    /// The match of a seed.
    pub fn draw(&self, seed: u64) -> ScenarioFile {
        let mut dice = Dice::new(Seed(seed), "soak", None);
        let sides = Team::BOTH.map(|_| &self.sides[dice.below(self.sides.len())]);
        let radio = self.radios[dice.below(self.radios.len())].clone();
        let mut trouble = Trouble { pool: self, sides, dice: &mut dice };
        let (script, faults) = (trouble.script(), trouble.rules());
        let safety = Invariant::ALL.into_iter().filter(|invariant| invariant.is_safety());
        let safety = safety.map(|invariant| never(invariant, 0.0, "no radio may break it"));
        let settled = FAULTS + SETTLE;
        let liveness = LIVENESS.map(|invariant| never(invariant, settled, "the faults have ended"));
        ScenarioFile {
            name: Some(format!("Soak {seed}")),
            source: Some("touchline soak".into()),
            game: Some(self.game.clone()),
            radio: Some(radio),
            seeds: Some(Seeds::List(vec![seed])),
            seconds: Some(LENGTH),
            referee: Some(Referee::Nobody),
            home: Some(sides[0].file(Team::Home)),
            away: Some(sides[1].file(Team::Away)),
            ball: Some(BallFile { at: BallPlaces::One(Vec2::ZERO), velocity: Vec2::ZERO }),
            faults,
            script,
            expect: safety.chain(liveness).collect(),
            ..ScenarioFile::default()
        }
    }
}

fn never(invariant: Invariant, from: f32, because: &str) -> Expectation {
    let what = Condition::Broken { invariant, team: None };
    Expectation::Never { what, from, until: None, because: because.into() }
}
