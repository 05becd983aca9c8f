//! One match of a soak, drawn by its seed.

use bevy::prelude::Vec2;

use crate::game::record::Invariant;
use crate::ids::{RobotId, Team};
use crate::lab::scenario::{
    BallFile, BallPlaces, Condition, Event, Expectation, PlayerFile, Referee, ScenarioFile, Seeds, SideFile,
    TimedEvent,
};
use crate::rng::{Dice, Seed};
use crate::robot::Restart;

/// The faults end after this time, s.
pub(super) const FAULTS: f32 = 40.0;
/// What must settle has settled so long after the faults, s: with the bound of an invariant on top.
pub(super) const SETTLE: f32 = 10.0;
/// How long a match takes, s.
pub(super) const LENGTH: f32 = FAULTS + SETTLE + 20.0;
/// A match has so many faults.
const FEW: usize = 3;
const MANY: usize = 14;
/// A robot is off at the end of the faults, and stays so, with this probability. Two of a team are always on.
const STAYS_OFF: f32 = 0.2;

/// What must settle when the faults have ended.
const LIVENESS: [Invariant; 3] = [Invariant::OneRobotARole, Invariant::NoRoleVacant, Invariant::BookerPlays];

/// A side that can be drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SoakSide {
    pub strategy: String,
    pub robot: String,
    pub sensing: String,
    /// The roles of its players, by number.
    pub roles: Vec<String>,
    pub swaps: bool,
    /// Where its players stand for their own kick-off and for the other team's, by number, m in the team frame.
    pub places: [Vec<Vec2>; 2],
}

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

/// What can be drawn on one pitch.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SoakPool {
    /// The match whose pitch, ball and rules there are.
    pub game: String,
    /// Half of the field, m.
    pub half_size: Vec2,
    pub sides: Vec<SoakSide>,
    pub radios: Vec<String>,
}

impl SoakPool {
    /// The match of a seed.
    pub fn draw(&self, seed: u64) -> ScenarioFile {
        let mut dice = Dice::new(Seed(seed), "soak", None);
        let sides = Team::BOTH.map(|_| &self.sides[dice.below(self.sides.len())]);
        let radio = self.radios[dice.below(self.radios.len())].clone();
        let faults = FEW + dice.below(MANY - FEW + 1);
        let mut script: Vec<TimedEvent> = (0..faults)
            .map(|_| {
                let at = tenth(FAULTS * dice.uniform());
                TimedEvent { at, what: self.fault(sides, &mut dice) }
            })
            .collect();
        script.sort_by(|a, b| a.at.total_cmp(&b.at));
        script.extend(peace(sides, &mut dice).into_iter().map(|what| TimedEvent { at: FAULTS, what }));
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
            script,
            expect: safety.chain(liveness).collect(),
            ..ScenarioFile::default()
        }
    }

    fn fault(&self, sides: [&SoakSide; 2], dice: &mut Dice) -> Event {
        let team = Team::BOTH[dice.below(2)];
        let side = sides[team.index()];
        let robot = RobotId::new(team, dice.below(side.roles.len()) as u8);
        let place = |dice: &mut Dice| {
            let mut along = |half: f32| tenth((2.0 * dice.uniform() - 1.0) * (half - 0.6));
            Vec2::new(along(self.half_size.x), along(self.half_size.y))
        };
        match dice.below(14) {
            0 | 1 => Event::Crash(robot),
            2 => Event::Revive { robot, memory: Restart::Kept },
            3 => Event::Revive { robot, memory: Restart::Lost },
            4 => Event::Freeze(robot),
            5 => Event::Deaf(robot),
            6 => Event::Mute(robot),
            7 => Event::CutOff(robot),
            8 => Event::Partition(vec![robot], all_but(robot, side)),
            9 => Event::Jam(dice.chance(0.5)),
            10 => Event::Radio(self.radios[dice.below(self.radios.len())].clone()),
            11 => Event::Ball { at: place(dice), velocity: Vec2::ZERO },
            12 if side.swaps => swap(robot, side, dice),
            12 => Event::Reconnect(robot),
            _ => Event::Push { robot, by: Vec2::new(tenth(dice.uniform()), tenth(dice.uniform())) },
        }
    }
}

fn all_but(robot: RobotId, side: &SoakSide) -> Vec<RobotId> {
    let team = (0..side.roles.len() as u8).map(|number| RobotId::new(robot.team, number));
    team.filter(|other| *other != robot).collect()
}

/// Two roles of the team are exchanged.
fn swap(robot: RobotId, side: &SoakSide, dice: &mut Dice) -> Event {
    let one = dice.below(side.roles.len());
    let other = (one + 1 + dice.below(side.roles.len() - 1)) % side.roles.len();
    let [one, other] = [&side.roles[one], &side.roles[other]].map(String::clone);
    Event::InitiateSwap { robot, roles: vec![(one.clone(), other.clone()), (other, one)] }
}

/// The end of all faults; some robots are off and stay so.
fn peace(sides: [&SoakSide; 2], dice: &mut Dice) -> Vec<Event> {
    let mut events = vec![Event::Heal, Event::Jam(false), Event::Radio("good".into())];
    for team in Team::BOTH {
        let players = sides[team.index()].roles.len();
        let core = dice.below(players);
        for number in 0..players {
            let robot = RobotId::new(team, number as u8);
            let is_core = number == core || number == (core + 1) % players;
            events.push(Event::Reconnect(robot));
            events.push(Event::Revive { robot, memory: Restart::Kept });
            if dice.chance(STAYS_OFF) && !is_core {
                events.push(Event::Crash(robot));
            }
        }
    }
    events
}

fn never(invariant: Invariant, from: f32, because: &str) -> Expectation {
    let what = Condition::Broken { invariant, team: None };
    Expectation::Never { what, from, until: None, because: because.into() }
}

fn tenth(value: f32) -> f32 {
    (value * 10.0).round() / 10.0
}
