//! What the world shows of one tick of play, as plain data for the counters: places, velocities, contacts, what motors are told. No
//! belief of a robot is in it; role and state say what a robot does and not what it knows.

use bevy::ecs::query::QueryData;
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_rapier2d::prelude::RapierRigidBodyHandle;
use bevy_rapier2d::rapier::dynamics::RigidBodyHandle;
use smallvec::SmallVec;

use crate::geometry::{Pose, Twist};
use crate::ids::{RobotId, Team};
use crate::robot::handling::{Handling, Kicking};
use crate::robot::{DriveCommand, OffPitch, Orders, Robot, RobotBodies, RobotState};
use crate::strategy::{Activity, Role};
use crate::world::ball::Ball;
use crate::world::physics::Contacts;

/// One tick of play. Points and velocities are in the pitch frame, in metres and m/s.
#[derive(Clone, Debug, Default)]
pub(super) struct PlayTick {
    /// Ticks of the match that are over.
    pub tick: u64,
    /// Seconds of play before this tick.
    pub now: f64,
    /// Length of the tick, s.
    pub dt: f64,
    pub ball: Vec2,
    pub ball_velocity: Vec2,
    /// Whether the referee has put the ball somewhere.
    pub ball_is_put: bool,
    /// Those on the pitch, in order.
    pub players: SmallVec<[PlayerTick; 8]>,
    /// The pairs of robots that touch with any of their bodies, each pair in order, once.
    pub touching: SmallVec<[[RobotId; 2]; 8]>,
    /// The robots that touch the ball with any of their bodies, in order.
    pub at_ball: SmallVec<[RobotId; 8]>,
}

/// A robot on the pitch.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlayerTick {
    pub id: RobotId,
    pub position: Vec2,
    /// As it moves, m/s.
    pub velocity: Vec2,
    /// As its motors are told to move it, m/s.
    pub told: Vec2,
    /// Switched on, with wheels or legs that work, and not penalised.
    pub plays: bool,
    /// Whether the ball is under its chin.
    pub holds: bool,
    pub kicking: Option<Kicking>,
    /// Index of its role.
    pub role: usize,
    /// Indices of the role that it acts in and of that role's state.
    pub state: (usize, usize),
}

impl PlayTick {
    /// The robots of a team that are on the pitch.
    pub fn of(&self, team: Team) -> impl Iterator<Item = &PlayerTick> {
        self.players.iter().filter(move |player| player.id.team == team)
    }

    /// Whether a robot of the team touches the ball, or holds it.
    pub fn touches_ball(&self, team: Team) -> bool {
        self.at_ball.iter().any(|id| id.team == team) || self.of(team).any(|player| player.holds)
    }
}

/// A robot as all see it.
#[derive(QueryData)]
pub(super) struct SeenPlayer {
    id: &'static RobotId,
    robot: &'static Robot,
    pose: &'static Pose,
    twist: &'static Twist,
    command: &'static DriveCommand,
    handling: &'static Handling,
    orders: &'static Orders,
    role: &'static Role,
    activity: &'static Activity,
    bodies: Option<&'static RobotBodies>,
}

impl SeenPlayerItem<'_, '_> {
    fn tick(&self) -> PlayerTick {
        PlayerTick {
            id: *self.id,
            position: self.pose.position,
            velocity: self.twist.linear,
            told: self.pose.forward().rotate(self.command.velocity()),
            plays: self.robot.health.drives() && self.orders.state == RobotState::Playing,
            holds: self.handling.holds(),
            kicking: self.handling.kicking,
            role: self.role.0,
            state: (self.activity.acting_as, self.activity.state),
        }
    }
}

type SeenBall = (&'static Pose, &'static Twist, Option<&'static RapierRigidBodyHandle>);

/// All that the counters of play look at.
#[derive(SystemParam)]
pub(super) struct PlayView<'w, 's> {
    ball: Single<'w, 's, SeenBall, With<Ball>>,
    players: Query<'w, 's, SeenPlayer, Without<OffPitch>>,
    contacts: Contacts<'w, 's>,
}

/// To whom a body belongs; the ball belongs to nobody.
type Owner = (RigidBodyHandle, Option<RobotId>);

impl PlayView<'_, '_> {
    /// What there is to see, but for the time.
    pub fn tick(&self) -> PlayTick {
        let (ball, motion, body) = *self.ball;
        let mut players: SmallVec<[PlayerTick; 8]> = SmallVec::new();
        let mut owners: SmallVec<[Owner; 24]> = body.map(|body| (body.0, None)).into_iter().collect();
        for player in &self.players {
            players.push(player.tick());
            let bodies = player.bodies.map(RobotBodies::all).unwrap_or_default();
            owners.extend(bodies.into_iter().map(|body| (body.0, Some(*player.id))));
        }
        players.sort_unstable_by_key(|player| player.id);
        let (touching, at_ball) = self.touches(&owners);
        PlayTick {
            ball: ball.position,
            ball_velocity: motion.linear,
            players,
            touching,
            at_ball,
            ..PlayTick::default()
        }
    }

    /// Which robots touch each other, and which touch the ball.
    fn touches(&self, owners: &[Owner]) -> (SmallVec<[[RobotId; 2]; 8]>, SmallVec<[RobotId; 8]>) {
        let owner = |body| owners.iter().find(|(other, _)| *other == body).map(|(_, owner)| *owner);
        let (mut touching, mut at_ball) = (SmallVec::new(), SmallVec::new());
        for [a, b] in self.contacts.pairs() {
            match (owner(a), owner(b)) {
                // A robot and its own trailer are no two.
                (Some(Some(a)), Some(Some(b))) if a != b => touching.push([a.min(b), a.max(b)]),
                (Some(Some(robot)), Some(None)) | (Some(None), Some(Some(robot))) => at_ball.push(robot),
                _ => {}
            }
        }
        touching.sort_unstable();
        touching.dedup();
        at_ball.sort_unstable();
        at_ball.dedup();
        (touching, at_ball)
    }
}

/// For tests of the counters.
#[cfg(test)]
pub(super) mod stage {
    use super::*;

    pub const HOME_1: RobotId = RobotId::new(Team::Home, 1);
    pub const HOME_2: RobotId = RobotId::new(Team::Home, 2);
    pub const AWAY_1: RobotId = RobotId::new(Team::Away, 1);

    /// A robot that plays and stands.
    pub fn player(id: RobotId, x: f32, y: f32) -> PlayerTick {
        PlayerTick {
            id,
            position: Vec2::new(x, y),
            velocity: Vec2::ZERO,
            told: Vec2::ZERO,
            plays: true,
            holds: false,
            kicking: None,
            role: 0,
            state: (0, 0),
        }
    }

    /// A tick of a tenth of a second, the ball at rest in the centre.
    pub fn tick(players: &[PlayerTick]) -> PlayTick {
        PlayTick { dt: 0.1, players: players.into(), ..PlayTick::default() }
    }

    /// Shows a counter the same for so many tenths of a second, from `now` on.
    pub fn run(now: &mut f64, tenths: usize, tick: &PlayTick, mut update: impl FnMut(&PlayTick)) {
        for _ in 0..tenths {
            update(&PlayTick { now: *now, tick: (*now * 10.0).round() as u64, ..tick.clone() });
            *now += tick.dt;
        }
    }
}
