//! What goes wrong in a match of a soak, and how it ends.

use bevy::prelude::Vec2;

use super::pool::{FAULTS, SoakPool, SoakSide};
use crate::comms::radio::{Act, FaultRule, Which};
use crate::comms::tcm::DataType;
use crate::ids::{RobotId, Team};
use crate::lab::scenario::{Event, TimedEvent};
use crate::rng::Dice;
use crate::robot::{KickIntent, Restart};

/// A match has so many faults.
const FEW: usize = 3;
const MANY: usize = 14;
/// And up to so many rules for single packets.
const RULES: usize = 3;
/// A rule delays packets by up to this, s. What is said during the faults is heard before all must have settled.
const LATE: f32 = 8.0;
/// Somebody at the controls moves the levers so often, and in steps of so long, s.
const MOVES: usize = 8;
const MOVE: f32 = 0.2;
/// A robot is off at the end of the faults, and stays so, with this probability. Two of a team are always on.
const STAYS_OFF: f32 = 0.2;
/// The kinds of packets for which there are rules.
const STEPS: [DataType; 5] =
    [DataType::LOCK, DataType::ACK_LOCK, DataType::SWAP, DataType::ACK_SWAP, DataType::BOOK];

/// What goes wrong between two sides.
pub(super) struct Trouble<'a> {
    pub pool: &'a SoakPool,
    pub sides: [&'a SoakSide; 2],
    pub dice: &'a mut Dice,
}

impl Trouble<'_> {
    /// Faults at all times, and their end.
    pub fn script(&mut self) -> Vec<TimedEvent> {
        let faults = FEW + self.dice.below(MANY - FEW + 1);
        let mut script: Vec<TimedEvent> = Vec::new();
        for _ in 0..faults {
            let at = tenth(FAULTS * self.dice.uniform());
            script.extend(self.fault(at));
        }
        script.retain(|event| event.at < FAULTS);
        script.sort_by(|a, b| a.at.total_cmp(&b.at));
        script.extend(self.peace().into_iter().map(|what| TimedEvent { at: FAULTS, what }));
        script
    }

    /// Rules for single packets, until the faults end.
    pub fn rules(&mut self) -> Vec<FaultRule> {
        let rules = self.dice.below(RULES + 1);
        let mut rule = || {
            let robot = self.robot();
            let nth = 1 + self.dice.below(4) as u32;
            FaultRule {
                kind: Some(STEPS[self.dice.below(STEPS.len())]),
                from: self.dice.chance(0.7).then_some(robot),
                to: None,
                between: Some((0.0, FAULTS)),
                which: [Which::All, Which::Nth(nth), Which::From(nth)][self.dice.below(3)],
                act: match self.dice.below(3) {
                    0 => Act::Drop,
                    1 => Act::Delay(tenth(LATE * self.dice.uniform())),
                    _ => Act::Duplicate(tenth(LATE * self.dice.uniform())),
                },
            }
        };
        (0..rules).map(|_| rule()).collect()
    }

    fn robot(&mut self) -> RobotId {
        let team = Team::BOTH[self.dice.below(2)];
        RobotId::new(team, self.dice.below(self.sides[team.index()].roles.len()) as u8)
    }

    /// What goes wrong at a time, and with what it goes on.
    fn fault(&mut self, at: f32) -> Vec<TimedEvent> {
        let robot = self.robot();
        let side = self.sides[robot.team.index()];
        let what = match self.dice.below(18) {
            0 | 1 => Event::Crash(robot),
            2 => Event::Revive { robot, memory: Restart::Kept },
            3 => Event::Revive { robot, memory: Restart::Lost },
            4 => Event::Freeze(robot),
            5 => Event::Deaf(robot),
            6 => Event::Mute(robot),
            7 => Event::CutOff(robot),
            8 => Event::Partition(vec![robot], all_but(robot, side)),
            9 => Event::Jam(self.dice.chance(0.5)),
            10 => Event::Radio(self.pool.radios[self.dice.below(self.pool.radios.len())].clone()),
            11 => Event::Ball { at: self.place(), velocity: Vec2::ZERO },
            12 if side.swaps => swap(robot, side, self.dice),
            12 => Event::Reconnect(robot),
            13 => {
                Event::Kidnap { robot, to: self.place(), facing: tenth(360.0 * self.dice.uniform() - 180.0) }
            }
            14 => Event::Mislead { robot, by: self.place(), turn: tenth(90.0 * self.dice.uniform() - 45.0) },
            15 => return self.drive(robot, at),
            16 => Event::Strategy { team: robot.team, name: self.another(side) },
            _ => Event::Push { robot, by: Vec2::new(tenth(self.dice.uniform()), tenth(self.dice.uniform())) },
        };
        vec![TimedEvent { at, what }]
    }

    fn place(&mut self) -> Vec2 {
        let half = self.pool.half_size;
        let mut along = |half: f32| tenth((2.0 * self.dice.uniform() - 1.0) * (half - 0.6));
        Vec2::new(along(half.x), along(half.y))
    }

    /// Somebody takes a robot over and moves the levers wildly.
    fn drive(&mut self, robot: RobotId, at: f32) -> Vec<TimedEvent> {
        let moves = 1 + self.dice.below(MOVES);
        let mut lever = |_| tenth(2.0 * self.dice.uniform() - 1.0);
        let levers: Vec<[f32; 3]> = (0..moves).map(|_| [0, 1, 2].map(&mut lever)).collect();
        let steer = |(nth, [throttle, aside, turn]): (u8, [f32; 3])| {
            let kick = if nth % 3 == 2 { KickIntent::Kick(0) } else { KickIntent::Nothing };
            let what = Event::Steer { robot, throttle, aside, turn, kick };
            TimedEvent { at: at + MOVE * f32::from(nth), what }
        };
        let takes_over = [TimedEvent { at, what: Event::TakeOver(robot) }];
        takes_over.into_iter().chain((0..).zip(levers).map(steer)).collect()
    }

    /// A strategy with the same roles: another one, or the same as if it had been read again.
    fn another(&mut self, side: &SoakSide) -> String {
        let alike = |other: &&SoakSide| other.roles == side.roles && other.swaps == side.swaps;
        let alike: Vec<&SoakSide> = self.pool.sides.iter().filter(alike).collect();
        alike[self.dice.below(alike.len())].strategy.clone()
    }

    /// The end of all faults; some robots are off and stay so.
    fn peace(&mut self) -> Vec<Event> {
        let mut events = vec![Event::Heal, Event::Jam(false), Event::Radio("good".into())];
        for team in Team::BOTH {
            let players = self.sides[team.index()].roles.len();
            let core = self.dice.below(players);
            for number in 0..players {
                let robot = RobotId::new(team, number as u8);
                let is_core = number == core || number == (core + 1) % players;
                events.push(Event::HandBack(robot));
                events.push(Event::Reconnect(robot));
                events.push(Event::Revive { robot, memory: Restart::Kept });
                if self.dice.chance(STAYS_OFF) && !is_core {
                    events.push(Event::Crash(robot));
                }
            }
        }
        events
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

fn tenth(value: f32) -> f32 {
    (value * 10.0).round() / 10.0
}
