//! What there is to see of a match after a tick: the truth, and what each robot believes, plays and says. Reads the world of
//! the match and changes nothing.
//!
//! A moment is named by the number of ticks that are over. What happened in the tick before it belongs to it.

use std::borrow::Cow;
use std::sync::Arc;

use bevy::ecs::query::{QueryData, QueryState};
use bevy::prelude::*;

use super::radio_watch::RadioWatch;
use crate::clock::Clock;
use crate::comms::radio::{RadioRecord, Transmission};
use crate::geometry::{Attacking, Pose};
use crate::ids::{PlayerNumber, RobotId, Team};
use crate::mind::teamwork::{Booking, Swapping, TeamModel};
use crate::mind::world_model::WorldModel;
use crate::protocol::role_swap::{AttemptPhase, Lock, Sequence};
use crate::robot::pilot::Pilot;
use crate::robot::{Frame, Head, Health, OffPitch, Percepts, Robot, RobotKind, Trailer};
use crate::strategy::{Activity, Part, Role, Strategies, Strategy};
use crate::world::ball::Ball;
use crate::world::referee::{Calls, Decision, MatchState, Phase};
use crate::world::{BodyEvent, BodyEvents};

/// What there is to see of a match after a tick. Places are in the pitch frame, in metres.
#[derive(Clone, Debug)]
pub struct MatchMoment {
    /// Ticks that are over.
    pub tick: u64,
    /// Seconds that are over.
    pub seconds: f64,
    /// The phase of the game.
    pub phase: Phase,
    /// 1 or 2.
    pub half: u8,
    /// Seconds of playing time left in this half.
    pub time_left: f64,
    /// Goals, home first.
    pub score: [u32; 2],
    /// Where the ball is.
    pub ball: Vec2,
    /// The robots, in order.
    pub robots: Vec<RobotMoment>,
    /// What the referee decided in the tick before.
    pub calls: Vec<Decision>,
    /// What happened to bodies in the tick before.
    pub body_events: Vec<(RobotId, BodyEvent)>,
    /// Packets whose fate has been known since the tick before.
    pub settled: Vec<Transmission>,
    /// What the teams play, home first.
    pub strategies: [Arc<Strategy>; 2],
}

/// What there is to see of a robot after a tick.
#[derive(Clone, Debug)]
pub struct RobotMoment {
    /// Who.
    pub id: RobotId,
    /// What it is built as.
    pub kind: Arc<RobotKind>,
    /// Where it truly is.
    pub pose: Pose,
    /// Where its trailer truly is.
    pub trailer: Option<Pose>,
    /// Where its head looks, rad to the left of the body's heading.
    pub pan: f32,
    /// Its role, as an index.
    pub role: usize,
    /// The role that it acts in and the state of that role's machine, as indices.
    pub activity: (usize, usize),
    /// The feature by which it took a transition in the tick before.
    pub because: Option<String>,
    /// What is wrong with it.
    pub health: Health,
    /// The referee has taken it off.
    pub off_pitch: bool,
    /// A person drives it.
    pub piloted: bool,
    /// Whose attempt to swap roles it is locked for.
    pub lock: Option<Lock>,
    /// Its own attempt to swap roles.
    pub attempt: Option<Sequence>,
    /// Whom it believes to have booked the ball.
    pub booker: Option<PlayerNumber>,
    /// It has booked the ball itself and goes to it.
    pub goes: bool,
    /// It claims the ball, and nobody above it does.
    pub claims: bool,
    /// Where it believes itself to be, once it has found its place.
    pub believed: Option<Pose>,
    /// Where it believes the ball to be.
    pub believed_ball: Option<Vec2>,
    /// Where it believes other robots to be.
    pub believed_robots: Vec<(Team, Vec2)>,
    /// A frame of its camera that arrived in the tick before.
    pub frame: Option<Frame>,
}

impl RobotMoment {
    /// The names of its role, of the role that it acts in and of its state, with the states around it.
    pub fn names<'a>(&self, strategy: &'a Strategy) -> [Cow<'a, str>; 3] {
        let role = |index: usize| strategy.roles.get(index).map_or("", |role| role.name.as_str()).into();
        let (acting_as, state) = self.activity;
        let machine = strategy.roles.get(acting_as).and_then(|role| match &role.part {
            Part::Plays(play) => strategy.machines.get(play.machine),
            Part::ActsAs(_) => None,
        });
        let path = machine.and_then(|machine| Some(machine.path(machine.states.get(state)?)));
        [role(self.role), role(acting_as), path.unwrap_or_default().into()]
    }
}

#[derive(QueryData)]
struct WatchedRobot {
    id: &'static RobotId,
    robot: &'static Robot,
    pose: &'static Pose,
    head: &'static Head,
    model: &'static WorldModel,
    team_model: &'static TeamModel,
    role: &'static Role,
    activity: &'static Activity,
    swapping: Option<&'static Swapping>,
    booking: Option<&'static Booking>,
    percepts: &'static Percepts,
    off_pitch: Has<OffPitch>,
    piloted: Has<Pilot>,
}

/// Looks at a match tick by tick.
pub struct MatchWatch {
    robots: QueryState<WatchedRobot>,
    trailers: QueryState<(&'static Trailer, &'static Pose)>,
    ball: QueryState<&'static Pose, With<Ball>>,
    radio: RadioWatch,
    /// The tick of the newest frame of each robot that was seen.
    frames: Vec<(RobotId, u64)>,
}

impl MatchWatch {
    /// Begins to look at the match in a world.
    pub fn new(world: &mut World) -> MatchWatch {
        MatchWatch {
            robots: world.query(),
            trailers: world.query(),
            ball: world.query_filtered(),
            radio: RadioWatch::starting_at(world.resource::<RadioRecord>()),
            frames: Vec::new(),
        }
    }

    /// What there is to see now.
    pub fn look(&mut self, world: &World) -> MatchMoment {
        let (clock, state) = (world.resource::<Clock>(), world.resource::<MatchState>());
        let trailers: Vec<(RobotId, Pose)> =
            self.trailers.iter(world).map(|(trailer, pose)| (trailer.of, *pose)).collect();
        let mut robots: Vec<RobotMoment> = (self.robots.iter(world))
            .map(|robot| {
                let trailer = trailers.iter().find(|(of, _)| of == robot.id).map(|(_, pose)| *pose);
                robot_moment(&robot, trailer, state.attacking(robot.id.team), clock.tick)
            })
            .collect();
        robots.sort_unstable_by_key(|robot| robot.id);
        for robot in &mut robots {
            self.keep_news(robot);
        }
        MatchMoment {
            tick: clock.tick,
            seconds: clock.now(),
            phase: state.phase,
            half: state.half,
            time_left: state.time_left,
            score: state.score,
            ball: self.ball.iter(world).next().map_or(Vec2::ZERO, |pose| pose.position),
            robots,
            calls: world.resource::<Calls>().0.clone(),
            body_events: world.resource::<BodyEvents>().0.clone(),
            settled: self.radio.look(world.resource::<RadioRecord>()),
            strategies: world.resource::<Strategies>().0.clone(),
        }
    }

    /// Packets that are still under way at the end.
    pub fn under_way(&self) -> impl Iterator<Item = &Transmission> {
        self.radio.under_way()
    }

    /// A frame is news once.
    fn keep_news(&mut self, robot: &mut RobotMoment) {
        let Some(taken) = robot.frame.as_ref().map(|frame| frame.taken) else { return };
        match self.frames.iter_mut().find(|(of, _)| *of == robot.id) {
            Some((_, known)) if *known == taken => robot.frame = None,
            Some((_, known)) => *known = taken,
            None => self.frames.push((robot.id, taken)),
        }
    }
}

fn robot_moment(robot: &WatchedRobotItem, trailer: Option<Pose>, ends: Attacking, tick: u64) -> RobotMoment {
    let WatchedRobotItem { model, activity, .. } = robot;
    let machine = robot.swapping.map(|swapping| &swapping.machine);
    let attempt = machine.and_then(|machine| match machine.phase() {
        AttemptPhase::Idle => None,
        AttemptPhase::WaitingForLocks { sequence } | AttemptPhase::WaitingForAcks { sequence } => {
            Some(sequence)
        }
    });
    let thinks = !robot.robot.health.crashed && !robot.off_pitch;
    let booking = robot.booking.map(|booking| &booking.0).filter(|_| thinks);
    // Beliefs are those of the tick before, whose number is one less.
    let booked = booking.filter(|booking| booking.is_booked(tick.saturating_sub(1)));
    let knows = thinks && model.is_localised();
    RobotMoment {
        id: *robot.id,
        kind: robot.robot.kind.clone(),
        pose: *robot.pose,
        trailer,
        pan: robot.head.pan,
        role: robot.role.0,
        activity: (activity.acting_as, activity.state),
        because: activity
            .history
            .back()
            .filter(|taken| taken.tick + 1 == tick)
            .map(|taken| taken.because.clone()),
        health: robot.robot.health,
        off_pitch: robot.off_pitch,
        piloted: robot.piloted,
        lock: machine.and_then(|machine| machine.lock()),
        attempt,
        booker: booked.and_then(|booking| Some(booking.booking()?.robot_booker)),
        goes: booking.is_some_and(|booking| booking.goes()),
        claims: thinks && robot.team_model.has_ball,
        believed: knows.then(|| ends.turn_pose(model.pose)),
        believed_ball: model.ball.filter(|_| knows).map(|ball| ends.turn(ball.position)),
        believed_robots: (model.robots.iter().filter(|_| knows))
            .map(|other| (other.team, ends.turn(other.position)))
            .collect(),
        frame: robot.percepts.frame.clone(),
    }
}
