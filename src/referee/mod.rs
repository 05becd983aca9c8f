//! The Referee stage: looks at the truth, applies the rules, and carries out what they decide.
//!
//! The rules are pure and live beside this file; here they get to see bodies and move them, as the people around a pitch do.

mod decision;
mod rulebook;
mod rules;
mod state;

use std::collections::VecDeque;

use bevy::ecs::query::QueryData;
use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;
use smallvec::SmallVec;

pub use decision::{Decision, PlacementReason, RemovalReason};
pub use rulebook::RuleBook;
pub use rules::{Laws, Observation, RULES, Rule, referee};
pub use state::{MatchState, Phase, Removal};

use crate::ball::{Ball, Rolling};
use crate::behaviour::Activity;
use crate::clock::Clock;
use crate::drive::{RobotBodies, WheelCommand};
use crate::geometry::{Pose, Twist};
use crate::ids::{RobotId, Team};
use crate::motor::SteeringIntent;
use crate::perception::Memory;
use crate::physics::Bodies;
use crate::pitch::Pitch;
use crate::schedule::{Tick, TickSystems};
use crate::sense::{Eyesight, Percepts};
use crate::strategy::Strategies;
use crate::teamwork::Role;
use crate::world_model::WorldModel;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Whistles>()
        .init_resource::<Calls>()
        .add_systems(Tick, (judge, place_ball, place_robots).chain().in_set(TickSystems::Referee));
}

/// On a robot that the referee has taken off the pitch.
#[derive(Component, Clone, Copy, Debug)]
pub struct OffPitch;

/// The last decisions, oldest first, with their ticks.
#[derive(Resource, Clone, Debug, Default)]
pub struct Whistles {
    pub heard: VecDeque<(u64, Decision)>,
}

/// Decisions that are kept for people to see.
const HEARD: usize = 64;

/// The decisions of this tick, until they are carried out.
#[derive(Resource, Clone, Debug, Default)]
pub struct Calls(pub Vec<Decision>);

fn judge(
    clock: Res<Clock>,
    (pitch, book): (Res<Pitch>, Res<RuleBook>),
    mut state: ResMut<MatchState>,
    (mut calls, mut whistles): (ResMut<Calls>, ResMut<Whistles>),
    ball: Single<(&Ball, &Pose)>,
    robots: Query<(&RobotId, &Pose), Without<OffPitch>>,
) {
    let (ball, ball_pose) = *ball;
    let mut seen: SmallVec<[(RobotId, Vec2); 8]> =
        robots.iter().map(|(id, pose)| (*id, pose.position)).collect();
    seen.sort_unstable_by_key(|(id, _)| *id);
    let laws = Laws { pitch: &pitch, book: &book, ball_radius: ball.kind.radius };
    let observation = Observation { ball: ball_pose.position, robots: &seen };
    calls.0.clear();
    referee(&laws, &observation, f64::from(clock.dt), &mut state, &mut calls.0);
    for call in &calls.0 {
        if whistles.heard.len() == HEARD {
            whistles.heard.pop_front();
        }
        whistles.heard.push_back((clock.tick, *call));
    }
}

fn place_ball(
    calls: Res<Calls>,
    mut bodies: Bodies,
    ball: Single<(&RapierRigidBodyHandle, &mut Pose, &mut Twist, &mut Rolling), With<Ball>>,
) {
    let (handle, mut pose, mut twist, mut rolling) = ball.into_inner();
    for call in &calls.0 {
        if let Decision::BallPlaced { at, .. } = call {
            *pose = Pose { position: *at, heading: 0.0 };
            *twist = Twist::default();
            *rolling = Rolling::default();
            bodies.place(handle, *pose);
        }
    }
}

/// Everything of a robot that changes when people carry it.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct Carried {
    entity: Entity,
    id: &'static RobotId,
    handles: &'static RobotBodies,
    pose: &'static mut Pose,
    twist: &'static mut Twist,
    wheels: &'static mut WheelCommand,
    intent: &'static mut SteeringIntent,
    model: &'static mut WorldModel,
    eyesight: &'static mut Eyesight,
    percepts: &'static mut Percepts,
    role: &'static Role,
    activity: &'static mut Activity,
    memory: &'static mut Memory,
}

fn place_robots(
    clock: Res<Clock>,
    (pitch, state, strategies, calls): (Res<Pitch>, Res<MatchState>, Res<Strategies>, Res<Calls>),
    mut bodies: Bodies,
    mut commands: Commands,
    mut robots: Query<Carried, Without<Ball>>,
) {
    for call in &calls.0 {
        for mut robot in &mut robots {
            let id = *robot.id;
            let ends = state.attacking(id.team);
            let at = match *call {
                Decision::RobotsPlaced { kick_off } if !state.is_removed(id) => {
                    ends.turn_pose(kick_off_pose(&strategies, id, kick_off))
                }
                Decision::RobotReturned { robot, at } if robot == id => at,
                Decision::RobotRemoved { robot, .. } if robot == id => beside_the_pitch(&pitch, id),
                _ => continue,
            };
            match call {
                Decision::RobotReturned { .. } => {
                    commands.entity(robot.entity).remove::<OffPitch>();
                }
                Decision::RobotRemoved { .. } => {
                    commands.entity(robot.entity).insert(OffPitch);
                }
                _ => {}
            }
            robot.put_down(at, ends.turn_pose(at), &mut bodies);
            let strategy = strategies.of(id.team);
            let history = std::mem::take(&mut robot.activity.history);
            *robot.activity = Activity { history, ..Activity::new(strategy, robot.role.0, clock.tick) };
            *robot.memory = Memory::new(strategy.slots);
        }
    }
}

impl CarriedItem<'_, '_> {
    fn put_down(&mut self, at: Pose, in_team_frame: Pose, bodies: &mut Bodies) {
        bodies.place(&self.handles.unit, at);
        if let Some(trailer) = &self.handles.trailer {
            bodies.place(trailer, at);
        }
        *self.pose = at;
        *self.twist = Twist::default();
        *self.wheels = WheelCommand::default();
        *self.intent = SteeringIntent::Stop;
        *self.model = WorldModel::told(in_team_frame);
        *self.percepts = Percepts::default();
        self.eyesight.blink();
    }
}

/// A robot's place at a kick-off, in its team frame, looking at the opponents' goal.
fn kick_off_pose(strategies: &Strategies, id: RobotId, kick_off: Team) -> Pose {
    let places = &strategies.of(id.team).kick_off;
    let places = if kick_off == id.team { &places.ours } else { &places.theirs };
    let place = places.get(usize::from(id.number)).copied().unwrap_or_default();
    Pose { position: place, heading: 0.0 }
}

/// Where a robot waits that was taken off.
fn beside_the_pitch(pitch: &Pitch, id: RobotId) -> Pose {
    let side = if id.team == Team::Home { -1.0 } else { 1.0 };
    let y = pitch.half_size().y + pitch.walls.thickness + 0.6;
    Pose::new(side * (1.0 + f32::from(id.number)), y, -std::f32::consts::FRAC_PI_2)
}
