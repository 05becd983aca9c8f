//! The Motor stage: the assemblage of a robot's activity becomes a steering intent.
//!
//! Each schema turns beliefs into a vector, a weight beside it says how much it counts, and the assemblage combines them. The
//! single contributions are kept for people to see.

mod evaluate;
#[cfg(test)]
mod tests;

use bevy::prelude::*;

use evaluate::evaluate;

use crate::ball::Ball;
use crate::behaviour::{Activity, Mind, perception};
use crate::clock::Clock;
use crate::geometry::{angle, wrap_angle};
use crate::ids::RobotId;
use crate::perception::{Memory, Perception};
use crate::pitch::Pitch;
use crate::rng::{Dice, Seed};
use crate::robot::OffPitch;
use crate::schedule::{Tick, TickSystems};
use crate::schemas::combine::{weighted_sum, winner_take_all};
use crate::strategy::{Assemblage, Combination, State, Strategies, Turn};

pub(super) fn plugin(app: &mut App) {
    app.add_systems(Tick, run_assemblages.in_set(TickSystems::Motor));
}

/// Where a robot wants to go. Headings are in the odometry's frame, so that the drive can follow them between decisions.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub enum SteeringIntent {
    #[default]
    Stop,
    /// A heading in radians, and a share of the top speed from -1 to 1; 0 turns on the spot, negative drives in reverse.
    Steer { heading: f32, speed: f32 },
    /// Turn on the spot, rad/s.
    Spin(f32),
}

/// What each schema of the running assemblage wants, in the team frame, and what became of it.
#[derive(Component, Clone, Debug, Default, PartialEq)]
pub struct Contributions {
    /// In the order of the assemblage's terms, unweighted.
    pub vectors: Vec<Vec2>,
    pub sum: Vec2,
}

/// The dice of a robot's noise schemas.
#[derive(Component, Clone, Debug)]
pub struct MotorDice(Dice);

impl MotorDice {
    pub fn new(seed: Seed, robot: RobotId) -> MotorDice {
        MotorDice(Dice::new(seed, "motor", Some(robot)))
    }
}

/// Sums shorter than this mean to stand still.
const STANDSTILL: f32 = 0.05;
/// Slowest that a robot with somewhere to go drives, as a share of its activity's speed.
const CRAWL: f32 = 0.25;

type Moved<'a> = (Mind, &'a Activity, &'a mut SteeringIntent, &'a mut Contributions, &'a mut MotorDice);

fn run_assemblages(
    clock: Res<Clock>,
    pitch: Res<Pitch>,
    strategies: Res<Strategies>,
    ball: Single<&Ball>,
    mut robots: Query<Moved, Without<OffPitch>>,
) {
    for (mut mind, activity, mut intent, mut contributions, mut dice) in &mut robots {
        let wits = &mind.wits;
        if !wits.robot.decides(&clock) {
            continue;
        }
        let strategy = strategies.of(wits.id.team);
        let senses = perception(wits, activity, strategy, (&clock, &pitch, &ball));
        let state = strategy.state(activity.machine(strategy), activity.state);
        let memory = &mut *mind.memory;
        match state.assemblage {
            Some(index) => {
                combine(&strategy.assemblages[index], &senses, memory, &mut dice.0, &mut contributions);
            }
            None => {
                contributions.vectors.clear();
                contributions.sum = Vec2::ZERO;
            }
        }
        *intent = intend(contributions.sum, state, &senses, memory, wits.odometry.pose.heading);
    }
}

fn combine(
    assemblage: &Assemblage,
    senses: &Perception,
    memory: &mut Memory,
    dice: &mut Dice,
    contributions: &mut Contributions,
) {
    contributions.vectors.clear();
    for term in &assemblage.terms {
        let vector = evaluate(&term.schema, senses, memory, dice).unwrap_or(Vec2::ZERO);
        contributions.vectors.push(vector);
    }
    let weighted = (assemblage.terms.iter().zip(&contributions.vectors)).map(|(term, v)| (term.weight, *v));
    contributions.sum = match assemblage.combination {
        Combination::WeightedSum => weighted_sum(weighted),
        Combination::WinnerTakeAll => winner_take_all(weighted),
    };
}

/// From the vector of an assemblage to what the drive is told.
fn intend(
    sum: Vec2,
    state: &State,
    senses: &Perception,
    memory: &mut Memory,
    odometry_heading: f32,
) -> SteeringIntent {
    let turned =
        |direction: Vec2| odometry_heading + wrap_angle(angle(direction) - senses.model.pose.heading);
    if sum.length() >= STANDSTILL {
        let speed = state.speed * sum.length().clamp(CRAWL, 1.0);
        let speed = if state.reverse { -speed } else { speed };
        return SteeringIntent::Steer { heading: turned(if state.reverse { -sum } else { sum }), speed };
    }
    if state.assemblage.is_none() && state.reverse {
        return SteeringIntent::Steer { heading: odometry_heading, speed: -state.speed };
    }
    match &state.turn {
        Turn::Stay => SteeringIntent::Stop,
        Turn::Spin(rate) => SteeringIntent::Spin(*rate),
        Turn::Face(point) => match senses.relative(point, memory).filter(|offset| *offset != Vec2::ZERO) {
            Some(offset) => SteeringIntent::Steer { heading: turned(offset), speed: 0.0 },
            None => SteeringIntent::Stop,
        },
    }
}
