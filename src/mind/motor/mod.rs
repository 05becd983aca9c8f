//! The Motor stage: the assemblage of a robot's activity becomes a steering intent.
//!
//! Each schema turns beliefs into a vector, a weight beside it says how much it counts, and the assemblage combines them. The
//! single contributions are kept for people to see.

mod combining;
mod evaluate;
mod head;
mod ready;
#[cfg(test)]
mod tests;

use crate::robot::SteeringIntent;
use bevy::ecs::query::QueryData;
use bevy::prelude::*;

use combining::Combining;
pub use combining::Contributions;
use ready::walk_to_place;

use crate::clock::Clock;
use crate::geometry::{angle, wrap_angle};
use crate::ids::RobotId;
use crate::mind::perception::{Decider, Memory, Perception, perception};
use crate::pitch::BallKind;
use crate::pitch::Pitch;
use crate::rng::{Dice, DiceStirred, Seed};
use crate::robot::{KickIntent, OffPitch, RobotKind, RobotStart, RobotState};
use crate::schedule::{Tick, TickSystems};
use crate::state::RegisterState;
use crate::strategy::{Activity, State, Strategies, Turn};

pub(super) fn plugin(app: &mut App) {
    app.match_component::<Contributions>().reflected().starts(|_: &RobotStart, _| Contributions::default());
    app.match_component::<MotorDice>()
        .starts(|start: &RobotStart, _| MotorDice::new(start.seed, start.id))
        .on(|dice, stirred: &DiceStirred, _| dice.0.stir(*stirred));
    app.add_systems(Tick, (run_assemblages, head::aim_heads).in_set(TickSystems::Motor));
}

/// The dice of a robot's noise schemas.
#[derive(Component, Clone, Debug)]
pub struct MotorDice(Dice);

impl MotorDice {
    /// The dice of a robot.
    pub fn new(seed: Seed, robot: RobotId) -> MotorDice {
        MotorDice(Dice::new(seed, "motor", Some(robot)))
    }
}

/// Sums shorter than this mean to stand still.
const STANDSTILL: f32 = 0.05;
/// Slowest that a robot with somewhere to go drives, as a share of its activity's speed.
const CRAWL: f32 = 0.25;

type Moved<'a> = (Decider, &'a Activity, Intents, &'a mut Contributions, &'a mut MotorDice);

/// What a robot wants its motors to do.
#[derive(QueryData)]
#[query_data(mutable)]
struct Intents {
    steering: &'static mut SteeringIntent,
    kick: &'static mut KickIntent,
}

fn run_assemblages(
    clock: Res<Clock>,
    pitch: Res<Pitch>,
    strategies: Res<Strategies>,
    ball: Res<BallKind>,
    mut robots: Query<Moved, Without<OffPitch>>,
) {
    for (mut mind, activity, mut intents, mut contributions, mut dice) in &mut robots {
        let input = &mind.input;
        if !input.robot.decides(&clock) {
            continue;
        }
        let strategy = strategies.of(input.id.team);
        let senses = perception(input, activity, strategy, (&clock, &pitch, &ball));
        let state = strategy.state(activity.machine(strategy), activity.state);
        let memory = &mut *mind.memory;
        match state.assemblage {
            Some(index) => {
                let mut motor = Combining { strategy, senses: &senses, memory, dice: &mut dice.0 };
                *contributions = motor.combine(&strategy.assemblages[index]);
            }
            None => {
                contributions.vectors.clear();
                contributions.sum = Vec2::ZERO;
            }
        }
        if let (RobotState::Ready, Some(place)) = (input.orders.state, input.orders.place) {
            contributions.vectors.clear();
            *intents.kick = KickIntent::Nothing;
            *intents.steering = walk_to_place(input.model, place, input.odometry.pose.heading);
            continue;
        }
        *intents.kick = kick_of(state, &input.robot.kind);
        *intents.steering = intend(contributions.sum, state, &senses, memory, input.odometry.pose.heading);
    }
}

/// What a state wants done to the ball, as far as a robot's kind can do it.
fn kick_of(state: &State, kind: &RobotKind) -> KickIntent {
    let index = |name: &String| kind.kicks.keys().position(|known| known == name);
    match state.kicks.iter().find_map(index) {
        Some(index) => KickIntent::Kick(index),
        None if state.hold && kind.chin.is_some() => KickIntent::Hold,
        None => KickIntent::Nothing,
    }
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
    let faced = match &state.turn {
        Turn::Face(point) => senses.relative(point, memory).filter(|offset| *offset != Vec2::ZERO),
        Turn::Stay | Turn::Spin(_) => None,
    };
    if sum.length() >= STANDSTILL {
        let speed = state.speed * sum.length().clamp(CRAWL, 1.0);
        let speed = if state.reverse { -speed } else { speed };
        let heading = turned(if state.reverse { -sum } else { sum });
        return SteeringIntent::Steer { heading, facing: faced.map_or(heading, turned), speed };
    }
    if state.assemblage.is_none() && state.reverse {
        let heading = odometry_heading;
        return SteeringIntent::Steer { heading, facing: heading, speed: -state.speed };
    }
    match &state.turn {
        Turn::Spin(rate) => SteeringIntent::Spin(*rate),
        Turn::Stay | Turn::Face(_) => faced.map_or(SteeringIntent::Stop, |offset| {
            let heading = turned(offset);
            SteeringIntent::Steer { heading, facing: heading, speed: 0.0 }
        }),
    }
}
