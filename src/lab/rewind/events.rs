//! What happens in a match that a person may want to go back to.

use std::fmt;

use bevy::prelude::*;

use crate::clock::Clock;
use crate::game::record::{Breach, Invariant, Invariants};
use crate::ids::{PlayerNumber, RobotId, Team};
use crate::mind::teamwork::{Booking, Swapping};
use crate::protocol::role_swap::Lock;
use crate::robot::Robot;
use crate::strategy::{Role, Strategies};
use crate::world::referee::{Decision, MatchState, PlacementReason, RuleBook, Whistles};

/// Something that has happened.
#[derive(Clone, Debug, PartialEq)]
pub struct MatchEvent {
    /// The tick in which it happened.
    pub tick: u64,
    /// Seconds of playing time since the match began.
    pub played: f64,
    /// What it was.
    pub what: MatchEventKind,
}

/// What can happen.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum MatchEventKind {
    /// The referee has decided something that matters.
    Call(Decision),
    /// A robot has taken another role.
    RoleTaken { robot: RobotId, role: String },
    /// A robot has the role back that it had when it gave its lock: a swap is rolled back.
    RolledBack { robot: RobotId, role: String },
    /// A robot has booked the ball and goes to it.
    Booked { robot: RobotId },
    /// A robot gave its lock and kept its role: the attempt to swap roles has come to nothing.
    LockLost { robot: RobotId, by: PlayerNumber },
    /// A robot has crashed.
    Crashed { robot: RobotId },
    /// Something that must hold has not for too long.
    Broken { invariant: Invariant, team: Option<Team> },
}

impl MatchEventKind {
    /// The team that it is about.
    pub fn team(&self) -> Option<Team> {
        match self {
            MatchEventKind::Call(Decision::Goal { by, .. }) => Some(*by),
            MatchEventKind::Call(_) => None,
            MatchEventKind::Broken { team, .. } => *team,
            MatchEventKind::RoleTaken { robot, .. }
            | MatchEventKind::RolledBack { robot, .. }
            | MatchEventKind::Booked { robot }
            | MatchEventKind::LockLost { robot, .. }
            | MatchEventKind::Crashed { robot } => Some(robot.team),
        }
    }
}

impl fmt::Display for MatchEventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MatchEventKind::Call(decision) => decision.fmt(f),
            MatchEventKind::RoleTaken { robot, role } => write!(f, "{robot} takes the role {role}"),
            MatchEventKind::RolledBack { robot, role } => {
                write!(f, "{robot} has its role {role} back: the swap is rolled back")
            }
            MatchEventKind::Booked { robot } => write!(f, "{robot} books the ball"),
            MatchEventKind::LockLost { robot, by } => {
                write!(f, "{robot} loses the lock of {} {by}: no swap", robot.team)
            }
            MatchEventKind::Crashed { robot } => write!(f, "{robot} crashes"),
            MatchEventKind::Broken { invariant, team: Some(team) } => write!(f, "{team}: {invariant}"),
            MatchEventKind::Broken { invariant, .. } => invariant.fmt(f),
        }
    }
}

/// Whether a decision is worth going back to.
fn matters(decision: &Decision) -> bool {
    match decision {
        Decision::BallPlaced { reason, .. } => *reason == PlacementReason::NoProgress,
        Decision::RobotsPlaced { .. } | Decision::PhaseChanged(_) | Decision::RobotPlaced { .. } => false,
        _ => true,
    }
}

/// How the robots were after a tick, to see what the next one changes.
#[derive(Clone, Debug, Default)]
pub(super) struct EventWatch(Vec<RobotThen>);

#[derive(Clone, Debug)]
struct RobotThen {
    id: RobotId,
    role: usize,
    /// With the role that it had when it gave the lock.
    lock: Option<(Lock, usize)>,
    goes: bool,
    crashed: bool,
}

type RobotThenParts<'a> = (&'a RobotId, &'a Robot, &'a Role, Option<&'a Swapping>, Option<&'a Booking>);

impl RobotThen {
    fn new((id, robot, role, swapping, booking): RobotThenParts) -> RobotThen {
        RobotThen {
            id: *id,
            role: role.0,
            lock: swapping.and_then(|swapping| swapping.machine.lock()).map(|lock| (lock, role.0)),
            goes: booking.is_some_and(|booking| booking.0.goes()) && !robot.health.crashed,
            crashed: robot.health.crashed,
        }
    }

    /// What has happened since it was as before.
    fn since(&mut self, before: &RobotThen, strategies: &Strategies) -> Vec<MatchEventKind> {
        let robot = self.id;
        let mut happened = Vec::new();
        if let (Some((lock, role)), Some((known, since))) = (&mut self.lock, before.lock)
            && *lock == known
        {
            *role = since;
        }
        if self.crashed && !before.crashed {
            happened.push(MatchEventKind::Crashed { robot });
        }
        if self.role != before.role
            && let Some(role) = strategies.of(robot.team).roles.get(self.role)
        {
            let role = role.name.clone();
            let is_back = before.lock.is_some_and(|(_, given_in)| given_in == self.role);
            happened.push(if is_back {
                MatchEventKind::RolledBack { robot, role }
            } else {
                MatchEventKind::RoleTaken { robot, role }
            });
        }
        if let Some((lock, role)) = before.lock
            && self.lock.is_none_or(|(now, _)| now != lock)
            && role == self.role
        {
            happened.push(MatchEventKind::LockLost { robot, by: lock.by });
        }
        if self.goes && !before.goes {
            happened.push(MatchEventKind::Booked { robot });
        }
        happened
    }
}

impl EventWatch {
    /// How the robots are now.
    pub(super) fn of(world: &mut World) -> EventWatch {
        let mut parts = world.query::<RobotThenParts>();
        let mut robots: Vec<RobotThen> = parts.iter(world).map(RobotThen::new).collect();
        robots.sort_unstable_by_key(|robot| robot.id);
        EventWatch(robots)
    }

    /// Looks at the tick that is just over, and tells what happened in it.
    pub(super) fn look(&mut self, world: &mut World) -> Vec<MatchEvent> {
        let before = std::mem::replace(self, EventWatch::of(world));
        let tick = world.resource::<Clock>().tick.saturating_sub(1);
        let played = world.resource::<MatchState>().time_played(world.resource::<RuleBook>());
        let heard = &world.resource::<Whistles>().heard;
        let calls = heard.iter().rev().take_while(|(when, _)| *when == tick).map(|(_, call)| *call);
        let mut calls: Vec<MatchEventKind> = calls.filter(matters).map(MatchEventKind::Call).collect();
        calls.reverse();
        let strategies = world.resource::<Strategies>();
        let of_robots = (self.0.iter_mut().zip(&before.0))
            .filter(|(now, before)| now.id == before.id)
            .flat_map(|(now, before)| now.since(before, strategies));
        let breaches = &world.resource::<Invariants>().breaches;
        let broken = breaches.iter().rev().take_while(|breach| breach.tick == tick).map(|breach| {
            let Breach { invariant, team, .. } = *breach;
            MatchEventKind::Broken { invariant, team }
        });
        calls
            .into_iter()
            .chain(of_robots)
            .chain(broken)
            .map(|what| MatchEvent { tick, played, what })
            .collect()
    }
}
