//! What the referee can see besides places: who touches the ball, who pushes whom, who stands still.

use bevy::ecs::query::QueryData;
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_rapier2d::prelude::*;
use smallvec::SmallVec;

use super::rulebook::RuleBook;
use super::rules::{Laws, Observation};
use crate::geometry::{Pose, Twist};
use crate::ids::RobotId;
use crate::pitch::BallKind;
use crate::pitch::Pitch;
use crate::robot::handling::Handling;
use crate::robot::{DriveCommand, OffPitch, RobotBodies};
use crate::world::ball::Ball;
use crate::world::physics::touch;

/// A robot as the referee sees it.
#[derive(QueryData)]
pub struct SeenRobot {
    id: &'static RobotId,
    handles: &'static RobotBodies,
    pose: &'static Pose,
    twist: &'static Twist,
    command: &'static DriveCommand,
    handling: &'static Handling,
}

type Players<'w, 's> = Query<'w, 's, SeenRobot, Without<OffPitch>>;
type BallBody = (&'static Pose, &'static RapierRigidBodyHandle);

/// All that the referee looks at.
#[derive(SystemParam)]
pub(crate) struct RefereeView<'w, 's> {
    pitch: Res<'w, Pitch>,
    book: Res<'w, RuleBook>,
    bodies: Single<'w, 's, &'static RapierRigidBodySet>,
    simulation: Single<'w, 's, &'static RapierContextSimulation>,
    kind: Res<'w, BallKind>,
    ball: Single<'w, 's, BallBody, With<Ball>>,
    players: Players<'w, 's>,
}

impl RefereeView<'_, '_> {
    pub(super) fn laws(&self) -> Laws<'_> {
        Laws { pitch: &self.pitch, book: &self.book, ball_radius: self.kind.radius }
    }

    /// Contacts and motion only where a rule asks for them.
    pub(super) fn sight(&self) -> Sight {
        let (pose, body) = *self.ball;
        if self.book.watches_contacts() {
            Sight::whole((pose, body), &self.players, &self.bodies, &self.simulation)
        } else {
            Sight::of_places(pose.position, &self.players)
        }
    }
}

/// Everything that happens between bodies.
#[derive(Clone, Debug, Default)]
pub(super) struct Sight {
    ball: Vec2,
    robots: SmallVec<[(RobotId, Vec2); 8]>,
    touching: SmallVec<[RobotId; 4]>,
    held_by: Option<RobotId>,
    contacts: SmallVec<[(RobotId, RobotId); 4]>,
    shoving: SmallVec<[(RobotId, RobotId); 4]>,
    still: SmallVec<[RobotId; 8]>,
}

/// Robots whose centres are farther apart do not touch, m.
const REACH: f32 = 2.0;
/// A robot that is told to move towards another faster than this pushes it, m/s.
const SHOVE: f32 = 0.05;
/// Slower robots stand still, m/s and rad/s.
const STILL: (f32, f32) = (0.02, 0.1);

impl SeenRobotItem<'_, '_> {
    /// Whether it is told to move towards another robot.
    fn shoves(&self, other: &SeenRobotItem) -> bool {
        let way = (other.pose.position - self.pose.position).normalize_or_zero();
        self.pose.forward().rotate(self.command.velocity()).dot(way) > SHOVE
    }
}

impl Sight {
    /// Places alone: all that the rules of walled pitches ask for.
    fn of_places(ball: Vec2, players: &Players) -> Sight {
        let mut robots: SmallVec<[(RobotId, Vec2); 8]> =
            players.iter().map(|player| (*player.id, player.pose.position)).collect();
        robots.sort_unstable_by_key(|(id, _)| *id);
        Sight { ball, robots, ..Sight::default() }
    }

    /// Also contacts and motion.
    fn whole(
        ball: (&Pose, &RapierRigidBodyHandle),
        players: &Players,
        bodies: &RapierRigidBodySet,
        simulation: &RapierContextSimulation,
    ) -> Sight {
        let mut sight = Sight::of_places(ball.0.position, players);
        let contact = |a: &RapierRigidBodyHandle, b: &RapierRigidBodyHandle| touch(simulation, bodies, a, b);
        for player in players {
            let id = *player.id;
            if contact(&player.handles.unit, ball.1) {
                sight.touching.push(id);
            }
            if player.handling.holds() {
                sight.held_by = Some(id);
            }
            if player.twist.linear.length() < STILL.0 && player.twist.angular.abs() < STILL.1 {
                sight.still.push(id);
            }
            let is_near = |other: &SeenRobotItem| other.pose.position.distance(player.pose.position) < REACH;
            for other in players.iter().filter(|other| *other.id > id && is_near(other)) {
                if contact(&player.handles.unit, &other.handles.unit) {
                    sight.contacts.push((id, *other.id));
                    sight.shoving.extend(player.shoves(&other).then_some((id, *other.id)));
                    sight.shoving.extend(other.shoves(&player).then_some((*other.id, id)));
                }
            }
        }
        sight
    }

    pub fn observation(&self) -> Observation<'_> {
        Observation {
            ball: self.ball,
            robots: &self.robots,
            touching: &self.touching,
            held_by: self.held_by,
            contacts: &self.contacts,
            shoving: &self.shoving,
            still: &self.still,
        }
    }
}
