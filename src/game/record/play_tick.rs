//! What the world shows of one tick of play, as plain data for the counters: places, velocities, contacts, what motors are told. No
//! belief of a robot is in it; role and state say what a robot does and not what it knows.

use bevy::ecs::query::QueryData;
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use smallvec::SmallVec;

use crate::geometry::{Attacking, Pose, Twist, Zone};
use crate::ids::{RobotId, Team};
use crate::robot::handling::Handling;
use crate::robot::{DriveCommand, OffPitch, Orders, Robot, RobotState};
use crate::strategy::{Activity, Role};
use crate::world::ball::Ball;
use crate::world::{BodyEvent, BodyEvents, ContactImpulses};

/// One tick of play. Points and velocities are in the pitch frame, in metres and m/s.
#[derive(Clone, Debug, Default)]
pub(super) struct PlayTick {
    /// Seconds of play before this tick.
    pub now: f64,
    /// Length of the tick, s.
    pub dt: f64,
    pub ball: Vec2,
    /// Where home's goal to attack is.
    pub home_attacks: Attacking,
    /// A team's own penalty area, in its frame.
    pub own_area: Zone,
    pub ball_velocity: Vec2,
    /// Whether the referee has put the ball somewhere.
    pub ball_is_put: bool,
    /// Those on the pitch, in order.
    pub players: SmallVec<[PlayerTick; 8]>,
    /// The pairs of robots that press each other with any of their bodies, in order, each pair in order and once.
    pub touching: SmallVec<[[RobotId; 2]; 8]>,
    /// The robots that touch the ball with any of their bodies.
    pub at_ball: SmallVec<[RobotId; 8]>,
    /// What happened to the bodies of robots.
    pub events: SmallVec<[(RobotId, BodyEvent); 4]>,
}

/// A robot on the pitch.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlayerTick {
    pub id: RobotId,
    pub position: Vec2,
    /// From the ball, m.
    pub distance: f32,
    /// As it moves, m/s.
    pub velocity: Vec2,
    /// As its motors are told to move it, m/s.
    pub told: Vec2,
    /// Switched on, with wheels or legs that work, and not penalised.
    pub plays: bool,
    /// Whether the ball is under its chin.
    pub holds: bool,
    /// Whether a kick is under way.
    pub kicks: bool,
    /// Index of its role.
    pub role: usize,
    /// Indices of the role that it acts in and of that role's state.
    pub state: (usize, usize),
}

impl PlayTick {
    /// A point in the frame of a team.
    pub fn seen_by(&self, team: Team, point: Vec2) -> Vec2 {
        let home = self.home_attacks.turn(point);
        match team {
            Team::Home => home,
            Team::Away => -home,
        }
    }

    /// How far a point is from the centre towards the goal that a team attacks, m.
    pub fn ahead(&self, team: Team, point: Vec2) -> f32 {
        self.seen_by(team, point).x
    }

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
}

impl SeenPlayerItem<'_, '_> {
    fn tick(&self, ball: Vec2) -> PlayerTick {
        PlayerTick {
            id: *self.id,
            position: self.pose.position,
            distance: self.pose.position.distance(ball),
            velocity: self.twist.linear,
            told: self.pose.forward().rotate(self.command.velocity()),
            plays: plays(self.robot, self.orders),
            holds: self.handling.holds(),
            kicks: self.handling.kicking.is_some(),
            role: self.role.0,
            state: (self.activity.acting_as, self.activity.state),
        }
    }
}

/// Whether a robot that is on the pitch plays: switched on, with wheels or legs that work, and not penalised.
pub(super) fn plays(robot: &Robot, orders: &Orders) -> bool {
    robot.health.drives() && orders.state == RobotState::Playing
}

/// All that the counters of play look at.
#[derive(SystemParam)]
pub(super) struct PlayView<'w, 's> {
    ball: Single<'w, 's, (&'static Pose, &'static Twist), With<Ball>>,
    players: Query<'w, 's, SeenPlayer, Without<OffPitch>>,
    contacts: Res<'w, ContactImpulses>,
    events: Res<'w, BodyEvents>,
}

impl PlayView<'_, '_> {
    /// What there is to see, but for the time.
    pub fn tick(&self) -> PlayTick {
        let (ball, motion) = *self.ball;
        let mut tick = PlayTick { ball: ball.position, ball_velocity: motion.linear, ..PlayTick::default() };
        for player in &self.players {
            tick.players.push(player.tick(ball.position));
        }
        // Sums of numbers depend on their order, and that of a query is another in a match that was put back.
        tick.players.sort_unstable_by_key(|player| player.id);
        let plays = |robot: RobotId| tick.players.iter().any(|player| player.id == robot);
        for (a, b, _) in &self.contacts.robots {
            if plays(*a) && plays(*b) {
                tick.touching.push([*a, *b]);
            }
        }
        for (robot, _) in &self.contacts.ball {
            tick.at_ball.push(*robot);
        }
        tick.events.extend_from_slice(&self.events.0);
        tick
    }
}

/// For tests of the counters.
#[cfg(test)]
pub(super) mod stage {
    use super::*;

    pub const HOME_1: RobotId = RobotId::new(Team::Home, 1);
    pub const HOME_2: RobotId = RobotId::new(Team::Home, 2);
    pub const AWAY_1: RobotId = RobotId::new(Team::Away, 1);
    pub const AWAY_2: RobotId = RobotId::new(Team::Away, 2);

    /// A robot that plays and stands.
    pub fn player(id: RobotId, x: f32, y: f32) -> PlayerTick {
        PlayerTick {
            id,
            position: Vec2::new(x, y),
            distance: Vec2::new(x, y).length(),
            velocity: Vec2::ZERO,
            told: Vec2::ZERO,
            plays: true,
            holds: false,
            kicks: false,
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
            update(&PlayTick { now: *now, ..tick.clone() });
            *now += tick.dt;
        }
    }
}
