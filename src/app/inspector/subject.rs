//! The robot that is looked at, with everything that there is to see of it, and the truth beside it.
//!
//! Read-only: the inspector changes nothing but by requests.

use bevy::ecs::query::QueryData;
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use smallvec::SmallVec;

use crate::app::view::format;
use crate::app::view::state::Selected;
use crate::clock::Clock;
use crate::comms::radio::Interference;
use crate::geometry::{Attacking, Pose, Twist};
use crate::ids::RobotId;
use crate::mind::motor::Contributions;
use crate::mind::teamwork::{Booking, Swapping, TeamModel};
use crate::mind::world_model::WorldModel;
use crate::pitch::BallKind;
use crate::pitch::Pitch;
use crate::robot::handling::Handling;
use crate::robot::pilot::Pilot;
use crate::robot::{DriveCommand, Head, Odometry, OffPitch, Orders, Percepts, Robot, SteeringIntent};
use crate::strategy::{Activity, Assemblage, Role, State, Strategies, Strategy};
use crate::world::ball::Ball;
use crate::world::referee::MatchState;
use crate::world::sense::Eyesight;

/// Everything that there is to see of a robot.
#[derive(QueryData)]
pub struct Subject {
    pub entity: Entity,
    pub id: &'static RobotId,
    pub robot: &'static Robot,
    pub role: &'static Role,
    pub activity: &'static Activity,
    pub pose: &'static Pose,
    pub twist: &'static Twist,
    pub model: &'static WorldModel,
    pub percepts: &'static Percepts,
    pub eyesight: &'static Eyesight,
    pub odometry: &'static Odometry,
    pub contributions: &'static Contributions,
    pub intent: &'static SteeringIntent,
    pub command: &'static DriveCommand,
    pub head: &'static Head,
    pub handling: &'static Handling,
    pub orders: &'static Orders,
    pub team_model: &'static TeamModel,
    pub booking: Option<&'static Booking>,
    pub swapping: Option<&'static Swapping>,
    pub piloted: Has<Pilot>,
    pub off_pitch: Has<OffPitch>,
}

/// The match, as far as the inspector looks at it.
#[derive(SystemParam)]
pub struct InspectedMatch<'w, 's> {
    pub clock: Res<'w, Clock>,
    pub state: Res<'w, MatchState>,
    pub strategies: Res<'w, Strategies>,
    pub pitch: Res<'w, Pitch>,
    pub selected: Res<'w, Selected>,
    interference: Res<'w, Interference>,
    subjects: Query<'w, 's, Subject>,
    kind: Res<'w, BallKind>,
    ball: Query<'w, 's, (Entity, &'static Pose, &'static Twist), With<Ball>>,
}

/// The true ball, in the team frame of the robot that is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrueBall {
    pub position: Vec2,
    pub velocity: Vec2,
    pub radius: f32,
}

/// The selected robot, with the truth in its team frame.
pub struct SelectedRobot<'a> {
    pub of: SubjectItem<'a, 'a>,
    pub id: RobotId,
    pub strategy: &'a Strategy,
    pub state: &'a MatchState,
    pub clock: Clock,
    pub ends: Attacking,
    /// Whether the radio reaches it no more.
    pub cut_off: bool,
    /// Where it truly is, in its team frame.
    pub pose: Pose,
    pub ball: Option<TrueBall>,
    /// The other robots on the pitch, by id.
    pub others: SmallVec<[(RobotId, Vec2); 16]>,
}

impl InspectedMatch<'_, '_> {
    /// What there is to see of the selected robot; none without a selection, or where the robot has gone.
    pub fn looked(&self) -> Option<SelectedRobot<'_>> {
        self.looked_with(|_, pose| pose)
    }

    /// The same, with every body where `placed` puts it, in the pitch frame.
    pub fn looked_with(&self, placed: impl Fn(Entity, Pose) -> Pose) -> Option<SelectedRobot<'_>> {
        let id = self.selected.0?;
        let of = self.subjects.iter().find(|subject| *subject.id == id)?;
        let ends = self.state.attacking(id.team);
        let mut others: SmallVec<[(RobotId, Vec2); 16]> = (self.subjects.iter())
            .filter(|other| *other.id != id && !other.off_pitch)
            .map(|other| (*other.id, ends.turn(placed(other.entity, *other.pose).position)))
            .collect();
        others.sort_unstable_by_key(|(id, _)| *id);
        Some(SelectedRobot {
            id,
            strategy: self.strategies.of(id.team),
            state: &self.state,
            clock: *self.clock,
            ends,
            cut_off: self.interference.cut_off.contains(&id),
            pose: ends.turn_pose(placed(of.entity, *of.pose)),
            ball: self.ball.iter().next().map(|(entity, pose, twist)| TrueBall {
                position: ends.turn(placed(entity, *pose).position),
                velocity: ends.turn(twist.linear),
                radius: self.kind.radius,
            }),
            others,
            of,
        })
    }
}

impl<'a> SelectedRobot<'a> {
    /// Seconds since a tick.
    pub fn since(&self, tick: u64) -> f32 {
        format::span(tick, self.clock.tick, self.clock.dt)
    }

    /// The state of the machine that the robot is in.
    pub fn activity(&self) -> Option<&'a State> {
        let strategy = self.strategy;
        let machine = self.of.activity.machine(strategy);
        strategy.machines.get(machine)?.states.get(self.of.activity.state)
    }

    /// The assemblage that runs in that state, with its index.
    pub fn assemblage(&self) -> Option<(usize, &'a Assemblage)> {
        let strategy = self.strategy;
        let index = self.activity()?.assemblage?;
        Some((index, strategy.assemblages.get(index)?))
    }
}
