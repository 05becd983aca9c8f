//! How a match waits for its robots in other processes: it introduces itself to each again and again until the robot has
//! answered. A robot that has fallen silent is greeted likewise, and all are greeted now and then while no tick is played,
//! so that they know that their match is still there.

use std::net::SocketAddr;
use std::time::{Duration, Instant};

use bevy::prelude::*;

use super::error::NetworkError;
use super::remote_robots::RemoteRobots;
use super::timing::DATAGRAMS_A_TICK;
use crate::ids::RobotId;

/// How often a robot that does not answer is greeted, and how often one that is not told anything.
const GREETING: Duration = Duration::from_millis(200);
const REMINDER: Duration = Duration::from_secs(1);
/// How long one look for answers takes when a match waits for them.
const LOOK: Duration = Duration::from_millis(50);

/// How far a match is with its robots in other processes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Greeting {
    /// All of them take part.
    Done,
    /// These are not there, or not any more; in the order of robots.
    Awaiting(Vec<Awaited>),
}

/// A robot in another process that does not take part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Awaited {
    /// The robot that has not answered.
    pub robot: RobotId,
    /// Where it is expected.
    pub address: SocketAddr,
    /// If somebody is there who cannot take part: a line that says who and why.
    pub refusal: Option<String>,
}

impl RemoteRobots {
    /// Greets the robots whose turn it is.
    pub(super) fn introduce(&mut self) {
        let due = self.robots.iter().filter(|(_, remote)| {
            let every = if remote.is_in { REMINDER } else { GREETING };
            remote.spoken.is_none_or(|spoken| spoken.elapsed() >= every)
        });
        let due: Vec<RobotId> = due.map(|(robot, _)| *robot).collect();
        for robot in due {
            let Some(remote) = self.robots.get_mut(&robot) else { continue };
            remote.spoken = Some(Instant::now());
            let (to, introduction) = (remote.address, remote.introduction.clone());
            self.send(to, robot, &introduction);
        }
    }

    /// Greets, hears what has come, and tells how far that got; waits so long for something to come.
    pub fn poll(&mut self, world: &mut World, patience: Duration) -> Greeting {
        self.introduce();
        let mut patience = patience;
        for _ in 0..DATAGRAMS_A_TICK {
            let Some(heard) = self.hear(patience) else { break };
            patience = Duration::ZERO;
            if let Some((robot, word)) = heard {
                self.meet(world, robot, word);
            }
        }
        let missing = self.robots.iter().filter(|(_, remote)| !remote.is_in);
        let awaited: Vec<Awaited> = missing
            .map(|(robot, remote)| {
                let (address, refusal) = (remote.address, remote.refusal.clone());
                Awaited { robot: *robot, address, refusal }
            })
            .collect();
        if awaited.is_empty() { Greeting::Done } else { Greeting::Awaiting(awaited) }
    }

    /// Waits until every robot takes part, so long at most, and no longer than `goes_on` allows.
    pub fn greet(
        &mut self,
        world: &mut World,
        patience: Duration,
        goes_on: &mut dyn FnMut(&[Awaited]) -> bool,
    ) -> Result<Greeting, NetworkError> {
        let begin = Instant::now();
        loop {
            let Greeting::Awaiting(awaited) = self.poll(world, LOOK) else { return Ok(Greeting::Done) };
            if !goes_on(&awaited) {
                return Ok(Greeting::Awaiting(awaited));
            }
            if let Some(Awaited { robot, address, .. }) = awaited.first()
                && begin.elapsed() >= patience
            {
                return Err(NetworkError::Silent { robot: *robot, address: *address, patience });
            }
        }
    }
}
