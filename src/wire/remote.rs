//! The match's side of robots that are processes of their own: in lock-step it tells each what it senses and waits for what
//! it wants to do. Who does not answer in time goes on with what it wanted last, and stands still when it has been silent
//! for long.

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::time::{Duration, Instant};

use bevy::prelude::*;
use serde::Serialize;

use super::WireError;
use super::protocol::{Command, Sensors, datagrams};
use crate::behaviour::Activity;
use crate::clock::Clock;
use crate::game::MatchPlan;
use crate::handling::{Handling, KickIntent};
use crate::head::{Head, HeadIntent};
use crate::ids::RobotId;
use crate::motor::SteeringIntent;
use crate::referee::Orders;
use crate::robot::Robot;
use crate::sense::{Odometry, Percepts};
use crate::strategy::{Part, Strategies, Strategy};
use crate::tcm::fragments::Assembly;
use crate::tcm::udp::UdpConn;
use crate::tcm::{Data, Directory, HOST, MessageBudgets, as_robot, party};
use crate::teamwork::Role;
use crate::world_model::{BallBelief, WorldModel};

/// How long a tick waits for answers.
const PATIENCE: Duration = Duration::from_millis(200);
/// How long a match waits for its robots before it begins.
const GREETING: Duration = Duration::from_secs(20);
/// A robot that has not answered for so many ticks stands still, and no tick waits for it until it answers again.
const SILENCE: u64 = 10;

/// What became of the packets to and from one remote robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct RemoteFigures {
    pub robot: RobotId,
    /// Ticks in which it was told what it senses.
    pub told: u64,
    /// Ticks in which it answered in time.
    pub answered: u64,
    /// Ticks in which its answer was late or lost.
    pub missed: u64,
    /// Datagrams to robots that it says it has sent.
    pub sent: u64,
    /// Datagrams from robots that it says it has received.
    pub received: u64,
}

pub(super) struct RemoteRobots {
    conn: UdpConn,
    assembly: Assembly,
    counter: u32,
    begun: bool,
    robots: BTreeMap<RobotId, Remote>,
}

struct Remote {
    address: SocketAddr,
    figures: RemoteFigures,
    /// The tick of the last answer.
    last: Option<u64>,
    /// Team messages that it had sent then.
    said: u64,
}

impl Remote {
    fn is_silent(&self, tick: u64) -> bool {
        self.last.is_none_or(|last| last + SILENCE < tick)
    }
}

/// The robots' own decisions are not made here any more.
pub(super) fn hand_over(world: &mut World, remote: &[RobotId]) {
    let mut robots = world.query::<(&RobotId, &mut Robot)>();
    for (id, mut robot) in robots.iter_mut(world) {
        robot.remote = remote.contains(id);
    }
}

impl RemoteRobots {
    pub fn open(
        directory: &Directory,
        robots: &[RobotId],
        plan: &MatchPlan,
    ) -> Result<RemoteRobots, WireError> {
        let host = directory.address_of(HOST).ok_or(WireError::NoAddress(HOST))?;
        let remote = |robot: RobotId| {
            let entity = party(robot);
            let address = directory.address_of(entity).ok_or(WireError::NoAddress(entity))?;
            let figures = RemoteFigures { robot, told: 0, answered: 0, missed: 0, sent: 0, received: 0 };
            Ok((robot, Remote { address, figures, last: None, said: 0 }))
        };
        Ok(RemoteRobots {
            conn: UdpConn::bind(host)?,
            assembly: Assembly::new(plan.tcm.limits(&Clock::default())),
            counter: 0,
            begun: false,
            robots: robots.iter().copied().map(remote).collect::<Result<_, WireError>>()?,
        })
    }

    pub fn figures(&self) -> Vec<RemoteFigures> {
        self.robots.values().map(|remote| remote.figures).collect()
    }

    /// Waits until every robot has answered once; the match does not go on meanwhile.
    pub fn greet(&mut self, world: &mut World) -> Result<(), WireError> {
        let begin = Instant::now();
        loop {
            self.exchange(world);
            let silent = self.robots.iter().find(|(_, remote)| remote.last.is_none());
            let Some((&robot, remote)) = silent else { break };
            if begin.elapsed() > GREETING {
                return Err(WireError::Silent { robot, address: remote.address });
            }
        }
        self.begun = true;
        for remote in self.robots.values_mut() {
            let robot = remote.figures.robot;
            remote.figures = RemoteFigures { robot, told: 0, answered: 0, missed: 0, sent: 0, received: 0 };
        }
        Ok(())
    }

    /// Tells the robots what they sense and hears what they want to do.
    pub fn exchange(&mut self, world: &mut World) {
        let tick = world.resource::<Clock>().tick;
        self.tell(world, tick);
        let begin = Instant::now();
        let mut open: Vec<RobotId> = self.robots.keys().copied().collect();
        loop {
            let is_awaited = |robot: &RobotId| !self.robots[robot].is_silent(tick) || !self.begun;
            let patience = if open.iter().any(is_awaited) { PATIENCE } else { Duration::ZERO };
            let left = patience.saturating_sub(begin.elapsed());
            let Some((robot, command)) = self.hear(left) else { break };
            if command.tick == tick && open.contains(&robot) {
                open.retain(|other| *other != robot);
                self.obey(world, robot, &command);
            } else if let Some(remote) = self.robots.get_mut(&robot) {
                remote.last = remote.last.max(Some(command.tick.min(tick)));
            }
        }
        for robot in open {
            self.miss(world, robot, tick);
        }
    }

    fn tell(&mut self, world: &mut World, tick: u64) {
        let mut senses = world.query::<(&RobotId, &Percepts, &Odometry, &Head, &Handling, &Orders)>();
        for (id, percepts, odometry, head, handling, orders) in senses.iter(world) {
            let Some(remote) = self.robots.get_mut(id) else { continue };
            let sensors = Sensors {
                tick,
                begun: self.begun,
                frame: percepts.frame.clone(),
                odometry: odometry.pose,
                speed: odometry.speed,
                turn_rate: odometry.turn_rate,
                stalled_for: odometry.stalled_for,
                pan: head.pan,
                holds_ball: handling.holds(),
                orders: *orders,
            };
            remote.figures.told += 1;
            for datagram in datagrams(&sensors, HOST, party(*id), &mut self.counter) {
                // A robot that is not there is noticed by its silence.
                let _ = self.conn.send(remote.address, &datagram);
            }
        }
    }

    /// Tells the robots that the match is over.
    pub fn finish(&mut self, world: &mut World) {
        let tick = world.resource::<Clock>().tick;
        self.tell(world, tick);
    }

    /// The next command of one of our robots, from the address where it should be.
    fn hear(&mut self, patience: Duration) -> Option<(RobotId, Command)> {
        let begin = Instant::now();
        loop {
            let left = patience.saturating_sub(begin.elapsed());
            let (from, datagram) = self.conn.wait(left).ok()??;
            let Ok(Some(message)) = self.assembly.accept(0, datagram) else { continue };
            let Some(robot) = as_robot(message.source.entity) else { continue };
            let is_there = self.robots.get(&robot).is_some_and(|remote| remote.address == from);
            if let Some(command) = Command::unserialise(&message.data).filter(|_| is_there)
                && message.data_type == Command::TYPE
            {
                return Some((robot, command));
            }
        }
    }

    fn obey(&mut self, world: &mut World, robot: RobotId, command: &Command) {
        let Some(remote) = self.robots.get_mut(&robot) else { return };
        remote.last = Some(command.tick);
        remote.figures.answered += 1;
        (remote.figures.sent, remote.figures.received) = command.datagrams;
        let said = command.said.saturating_sub(std::mem::replace(&mut remote.said, command.said));
        if let Some(mut budgets) = world.get_resource_mut::<MessageBudgets>() {
            budgets.count(robot.team, said);
        }
        let Some(entity) = entity_of(world, robot) else { return };
        let strategies = world.resource::<Strategies>().clone();
        let known = activity(command, strategies.of(robot.team));
        let mut entity = world.entity_mut(entity);
        entity.insert((command.steering, command.kick, command.head));
        if let Some(mut model) = entity.get_mut::<WorldModel>() {
            model.pose = command.pose;
            let seen = command.tick;
            model.ball = command.ball.map(|position| BallBelief { position, velocity: Vec2::ZERO, seen });
        }
        if let Some((role, acting_as, state)) = known {
            entity.insert(Role(role));
            if let Some(mut activity) = entity.get_mut::<Activity>()
                && (activity.acting_as, activity.state) != (acting_as, state)
            {
                *activity = Activity { acting_as, state, since: command.tick, ..activity.clone() };
            }
        }
    }

    fn miss(&mut self, world: &mut World, robot: RobotId, tick: u64) {
        let Some(remote) = self.robots.get_mut(&robot) else { return };
        remote.figures.missed += 1;
        if remote.is_silent(tick)
            && let Some(entity) = entity_of(world, robot)
        {
            world.entity_mut(entity).insert((
                SteeringIntent::Stop,
                KickIntent::Nothing,
                HeadIntent::default(),
            ));
        }
    }
}

fn entity_of(world: &mut World, robot: RobotId) -> Option<Entity> {
    let mut robots = world.query::<(Entity, &RobotId)>();
    robots.iter(world).find(|(_, id)| **id == robot).map(|(entity, _)| entity)
}

/// Role, acting role and state of a command, if the strategy has them.
fn activity(command: &Command, strategy: &Strategy) -> Option<(usize, usize, usize)> {
    let (role, acting_as) = (usize::from(command.role), usize::from(command.acting_as));
    strategy.roles.get(role)?;
    let Part::Plays(play) = &strategy.roles.get(acting_as)?.part else { return None };
    let state = usize::from(command.state);
    strategy.machines.get(play.machine)?.states.get(state)?;
    Some((role, acting_as, state))
}
