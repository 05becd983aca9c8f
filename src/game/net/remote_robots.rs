//! The match's side of robots that are processes of their own: in lock-step it tells each what it senses and waits for what
//! it wants to do. A robot that does not answer in time goes on with what it wanted last. A robot that stays silent stands still
//! and is [greeted](super::greeting) again and again; once it answers, it takes part again.

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::time::{Duration, Instant};

use bevy::log::{info, warn};
use bevy::prelude::*;
use serde::Serialize;

use super::error::NetworkError;
use super::introduction::Introduction;
use super::remote_messages::{RobotReply, Sensors, datagrams};
use super::timing::DATAGRAMS_A_TICK;
use crate::clock::Clock;
use crate::comms::tcm::fragments::{Assembly, Limits};
use crate::comms::tcm::udp::UdpConn;
use crate::comms::tcm::{Data, Directory, ExternalMessage, HOST, Peer};
use crate::game::MatchPlan;
use crate::game::requests::{RemoteNews, Request, Requests};
use crate::ids::RobotId;
use crate::robot::handling::Handling;
use crate::robot::{Head, Odometry, Orders, Percepts, RobotState};

/// How long a tick waits for answers, unless it was [granted](super::grant) less.
const PATIENCE: Duration = Duration::from_millis(200);
/// A robot that has not answered for this many ticks stands still, and no tick waits for it until it answers again.
const SILENCE: u64 = 10;
/// Counts of the packets to and from one remote robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct RemoteFigures {
    /// The robot.
    pub robot: RobotId,
    /// Ticks in which it was told what it senses.
    pub told: u64,
    /// Ticks in which it answered in time.
    pub answered: u64,
    /// Ticks in which its answer was late or lost, or in which it was not there.
    pub missed: u64,
    /// Datagrams to robots that it says it has sent.
    pub sent: u64,
    /// Datagrams from robots that it says it has received.
    pub received: u64,
}

pub(super) struct RemoteRobots {
    pub(super) conn: UdpConn,
    assembly: Assembly,
    counter: u32,
    session: u32,
    /// How long ticks may still wait in all, if that was said.
    pub(super) granted: Option<Duration>,
    pub(super) robots: BTreeMap<RobotId, RemoteRobot>,
}

pub(super) struct RemoteRobot {
    pub address: SocketAddr,
    pub introduction: Introduction,
    figures: RemoteFigures,
    /// Whether it takes part: it has introduced itself, and it is not silent.
    pub is_in: bool,
    /// Whether the match knows that it stands still.
    stands: bool,
    /// Whether ticks wait for its answer. Who came back must have answered once.
    waits: bool,
    /// The tick of the last answer, or of the introduction.
    last: u64,
    /// When it was spoken to last.
    pub spoken: Option<Instant>,
    /// Why it was refused last.
    pub refusal: Option<String>,
    /// Team messages that it had sent when it answered last.
    said: u64,
}

/// What came from the address of a robot.
pub(super) enum RobotWord {
    Introduction(Introduction),
    Command(RobotReply),
    /// What no robot of this version says.
    Other,
}

impl RemoteRobots {
    /// Opens the sockets.
    pub fn open(
        directory: &Directory,
        robots: &[RobotId],
        plan: &MatchPlan,
        session: u32,
    ) -> Result<RemoteRobots, NetworkError> {
        let host = directory.address_of(HOST).ok_or(NetworkError::NoAddress(HOST))?;
        let remote = |robot: RobotId| {
            let peer = Peer::from(robot);
            let address = directory.address_of(peer).ok_or(NetworkError::NoAddress(peer))?;
            let figures = RemoteFigures { robot, told: 0, answered: 0, missed: 0, sent: 0, received: 0 };
            let introduction = Introduction::new(plan, robot, session);
            let remote = RemoteRobot {
                address,
                introduction,
                figures,
                is_in: false,
                stands: false,
                waits: false,
                last: 0,
                spoken: None,
                refusal: None,
                said: 0,
            };
            Ok((robot, remote))
        };
        Ok(RemoteRobots {
            conn: UdpConn::bind(host)?,
            // Not those of the match, of which the other side may know nothing yet.
            assembly: Assembly::new(Limits::default()),
            counter: session,
            session,
            granted: None,
            robots: robots.iter().copied().map(remote).collect::<Result<_, NetworkError>>()?,
        })
    }

    /// The counts of each robot.
    pub fn figures(&self) -> Vec<RemoteFigures> {
        self.robots.values().map(|remote| remote.figures).collect()
    }

    /// Tells the robots what they sense and hears what they want to do.
    pub fn exchange(&mut self, world: &mut World) {
        let tick = world.resource::<Clock>().tick;
        self.tell(world, tick, false);
        self.introduce();
        let begin = Instant::now();
        let patience = self.granted.map_or(PATIENCE, |granted| granted.min(PATIENCE));
        let mut open: Vec<RobotId> = self.robots.keys().copied().collect();
        let mut more = DATAGRAMS_A_TICK;
        while more > 0 {
            let is_awaited = open.iter().any(|robot| self.robots[robot].waits);
            let patience = if is_awaited { patience } else { Duration::ZERO };
            let left = patience.saturating_sub(begin.elapsed());
            more -= usize::from(left.is_zero());
            let Some(heard) = self.hear(left) else { break };
            let Some((robot, word)) = heard else { continue };
            if let Some(answered) = self.meet(world, robot, word)
                && answered == tick
            {
                open.retain(|other| *other != robot);
            }
        }
        self.granted = self.granted.map(|granted| granted.saturating_sub(begin.elapsed()));
        for robot in self.robots.keys().copied().collect::<Vec<_>>() {
            if open.contains(&robot) {
                self.miss(world, robot, tick);
            } else if let Some(remote) = self.robots.get_mut(&robot) {
                remote.figures.answered += 1;
            }
        }
    }

    /// Tells those who take part.
    fn tell(&mut self, world: &mut World, tick: u64, is_over: bool) {
        let mut senses = world.query::<(&RobotId, &Percepts, &Odometry, &Head, &Handling, &Orders)>();
        let requests = world.resource::<Requests>();
        for (id, percepts, odometry, head, handling, orders) in senses.iter(world) {
            let Some(remote) = self.robots.get_mut(id).filter(|remote| remote.is_in) else { continue };
            let sensors = Sensors {
                session: self.session,
                tick,
                frame: percepts.frame.clone(),
                odometry: odometry.pose,
                speed: odometry.speed,
                turn_rate: odometry.turn_rate,
                told: odometry.told,
                bumped: odometry.bump.reports,
                pan: head.pan,
                holds_ball: handling.holds(),
                orders: if is_over { Orders { state: RobotState::Finished, ..*orders } } else { *orders },
                asked: requests.iter().filter(|request| request.concerns_mind(*id)).cloned().collect(),
            };
            remote.figures.told += 1;
            remote.spoken = Some(Instant::now());
            let to = remote.address;
            self.send(to, *id, &sensors);
        }
    }

    pub(super) fn send<T: Data>(&mut self, to: SocketAddr, robot: RobotId, data: &T) {
        for datagram in datagrams(data, HOST, robot.into(), &mut self.counter) {
            // A robot that is not there is noticed by its silence.
            let _ = self.conn.send(to, &datagram);
        }
    }

    /// Tells the robots that the match is over.
    pub fn finish(&mut self, world: &mut World) {
        let tick = world.resource::<Clock>().tick;
        self.tell(world, tick, true);
    }

    /// What comes next, if anything comes in time; `Some(None)` is something that is not for us.
    pub(super) fn hear(&mut self, patience: Duration) -> Option<Option<(RobotId, RobotWord)>> {
        let (from, datagram) = self.conn.wait(patience).ok()??;
        let known = self.robots.iter().find(|(_, remote)| remote.address == from);
        let Some((&robot, _)) = known else { return Some(None) };
        let word = match self.assembly.accept(0, datagram) {
            Ok(None) => return Some(None),
            Err(_) => RobotWord::Other,
            Ok(Some(message)) if message.source.peer != Peer::from(robot) => RobotWord::Other,
            Ok(Some(ExternalMessage { data_type, data, .. })) => {
                let introduction = Introduction::unserialise(data_type, &data).map(RobotWord::Introduction);
                let command = || RobotReply::unserialise(data_type, &data).map(RobotWord::Command);
                introduction.or_else(command).unwrap_or(RobotWord::Other)
            }
        };
        Some(Some((robot, word)))
    }

    /// Makes of a robot's word what is to be made of it; returns the tick that it answers.
    pub(super) fn meet(&mut self, world: &mut World, robot: RobotId, word: RobotWord) -> Option<u64> {
        let session = self.session;
        let remote = self.robots.get_mut(&robot)?;
        match word {
            RobotWord::Introduction(there) => {
                let difference = remote.introduction.difference(&there);
                match difference {
                    Some(difference) => remote.refuse(robot, format!("plays another match: {difference}")),
                    None if there.session == session => remote.let_in(robot, world.resource::<Clock>().tick),
                    // It answers the match before.
                    None => {}
                }
                None
            }
            RobotWord::Command(command) if command.session == session => {
                // Who took part and fell silent introduces itself first.
                let answered = command.wants.tick;
                if !remote.is_in || answered < remote.last {
                    return None;
                }
                (remote.waits, remote.last) = (true, answered);
                (remote.figures.sent, remote.figures.received) = command.datagrams;
                let said = command.said.saturating_sub(std::mem::replace(&mut remote.said, command.said));
                let news = RemoteNews::Wants { wants: command.wants, said };
                world.resource_mut::<Requests>().ask(Request::Remote(robot, news));
                Some(answered)
            }
            // The end of the match before.
            RobotWord::Command(_) => None,
            RobotWord::Other => {
                if !remote.is_in {
                    remote.refuse(robot, "says what no robot of this version says".into());
                }
                None
            }
        }
    }

    fn miss(&mut self, world: &mut World, robot: RobotId, tick: u64) {
        let Some(remote) = self.robots.get_mut(&robot) else { return };
        remote.figures.missed += 1;
        if remote.is_in && remote.last + SILENCE < tick {
            warn!("{robot} at {} has fallen silent and stands still", remote.address);
            (remote.is_in, remote.waits) = (false, false);
        }
        if !remote.is_in && !std::mem::replace(&mut remote.stands, true) {
            world.resource_mut::<Requests>().ask(Request::Remote(robot, RemoteNews::Silent));
        }
    }

    /// Lets a robot go, which is played by this process from now on; tells whether it was one of these.
    pub fn give_up(&mut self, robot: RobotId) -> bool {
        self.robots.remove(&robot).is_some()
    }
}

impl RemoteRobot {
    fn let_in(&mut self, robot: RobotId, tick: u64) {
        if self.is_in {
            return;
        }
        if tick > 0 {
            info!("{robot} at {} takes part from now on", self.address);
        }
        (self.is_in, self.stands, self.waits) = (true, false, tick == 0);
        (self.last, self.refusal) = (tick, None);
    }

    fn refuse(&mut self, robot: RobotId, why: String) {
        (self.is_in, self.waits) = (false, false);
        let line = format!("{robot} at {} is refused: it {why}", self.address);
        if self.refusal.as_ref() != Some(&line) {
            warn!("{line}");
            self.refusal = Some(line);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::net::{Ipv4Addr, UdpSocket};

    use super::*;
    use crate::data::AssetFolder;
    use crate::game::{Choice, Match};
    use crate::ids::Team;

    const ROBOT: RobotId = RobotId::new(Team::Home, 1);

    /// A match whose robot in another process is silent, that process' socket, and the match.
    fn with_a_silent_robot() -> (RemoteRobots, UdpSocket, Match) {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let plan = MatchPlan::read(&assets, &Choice::default()).unwrap();
        let somewhere = SocketAddr::from((Ipv4Addr::LOCALHOST, 0));
        let silent = UdpSocket::bind(somewhere).unwrap();
        let directory =
            [(HOST, somewhere), (ROBOT.into(), silent.local_addr().unwrap())].into_iter().collect();
        let remote = RemoteRobots::open(&directory, &[ROBOT], &plan, 1).unwrap();
        (remote, silent, Match::new(&plan))
    }

    #[test]
    fn what_was_granted_is_spent_by_the_first_tick_that_waits() {
        let (mut remote, _silent, mut game) = with_a_silent_robot();
        remote.robots.values_mut().for_each(|robot| robot.let_in(ROBOT, 0));
        remote.granted = Some(Duration::from_millis(5));
        remote.exchange(game.world_mut());
        assert_eq!(remote.granted, Some(Duration::ZERO));
        assert_eq!((remote.figures()[0].told, remote.figures()[0].missed), (1, 1));
    }

    #[test]
    fn a_tick_that_waits_for_nobody_hears_so_many_datagrams_at_most_and_leaves_the_rest() {
        let (mut remote, flood, mut game) = with_a_silent_robot();
        let to = remote.conn.address();
        (0..DATAGRAMS_A_TICK + 50).for_each(|_| assert_eq!(flood.send_to(b"?", to).ok(), Some(1)));
        remote.exchange(game.world_mut());
        let rest = std::iter::from_fn(|| remote.hear(Duration::ZERO)).count();
        assert_eq!(rest, 50);
    }
}
