//! The hands around the pitch: put ball and robots where the referee's decisions want them, right after the decisions.

use bevy::ecs::query::QueryData;
use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;

use crate::ball::{Ball, Rolling};
use crate::behaviour::Activity;
use crate::clock::Clock;
use crate::geometry::{Pose, Twist};
use crate::ids::{RobotId, Team};
use crate::motor::SteeringIntent;
use crate::perception::Memory;
use crate::physics::Bodies;
use crate::pitch::Pitch;
use crate::referee::{Calls, Decision, MatchState, judge};
use crate::robot::{OffPitch, RobotBodies, WheelCommand};
use crate::schedule::{Tick, TickSystems};
use crate::sense::{Eyesight, Percepts};
use crate::strategy::{Strategies, Strategy};
use crate::teamwork::Role;
use crate::world_model::WorldModel;

pub(super) fn plugin(app: &mut App) {
    app.add_systems(Tick, (place_ball, place_robots).chain().after(judge).in_set(TickSystems::Referee));
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
        // In order, since Rapier remembers the order in which bodies are touched.
        for mut robot in robots.iter_mut().sort::<&RobotId>() {
            let id = *robot.id;
            let ends = state.attacking(id.team);
            let at = match *call {
                Decision::RobotsPlaced { kick_off } if !state.is_removed(id) => {
                    ends.turn_pose(kick_off_pose(strategies.of(id.team), id, kick_off))
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
fn kick_off_pose(strategy: &Strategy, id: RobotId, kick_off: Team) -> Pose {
    let places = if kick_off == id.team { &strategy.kick_off.ours } else { &strategy.kick_off.theirs };
    let place = places.get(usize::from(id.number)).copied().unwrap_or_default();
    Pose { position: place, heading: 0.0 }
}

/// Where a robot waits before the match, and after it was taken off.
pub(super) fn beside_the_pitch(pitch: &Pitch, id: RobotId) -> Pose {
    let side = if id.team == Team::Home { -1.0 } else { 1.0 };
    let y = pitch.half_size().y + pitch.walls.thickness + 0.6;
    Pose::new(side * (1.0 + f32::from(id.number)), y, -std::f32::consts::FRAC_PI_2)
}
