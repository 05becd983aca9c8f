//! ChaosManager's side over UDP.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::time::{Duration, Instant};

use super::messages::{Instruction, Subscription};
use super::plan::ChaosPlan;
use super::talk::{ChaosNews, ChaosTalk, LinkFigures};
use crate::comms::tcm::udp::UdpConn;
use crate::game::net::error::NetworkError;
use crate::game::net::timing::unused_number;
use crate::ids::RobotId;
use crate::robot::pilot::Pilot;

/// How long one look for datagrams takes while nothing is to be sent.
const LOOK: Duration = Duration::from_millis(20);
/// Datagrams that are taken at a time at most.
const AT_A_TIME: usize = 1024;

/// A link to one robot of a match in another process. There is no connection: it says what it wants again and again.
#[derive(Debug)]
pub struct ChaosLink {
    conn: UdpConn,
    talk: ChaosTalk,
    began: Instant,
}

impl ChaosLink {
    /// A link to a robot of the match whose first socket for ChaosManager is there. Nothing is sent yet.
    ///
    /// # Errors
    /// If there are no three ports, or this machine has no address from which to speak to them.
    pub fn open(at: SocketAddr, robot: RobotId) -> Result<ChaosLink, NetworkError> {
        let there = ChaosPlan { at, from: Vec::new() };
        let sockets = there.addresses().ok_or(NetworkError::NoPorts(at))?;
        let here: IpAddr = match at.ip() {
            ip if ip.is_loopback() => ip,
            IpAddr::V4(_) => Ipv4Addr::UNSPECIFIED.into(),
            IpAddr::V6(_) => Ipv6Addr::UNSPECIFIED.into(),
        };
        let conn = UdpConn::bind(SocketAddr::new(here, 0))?;
        Ok(ChaosLink { conn, talk: ChaosTalk::new(sockets, robot, unused_number()), began: Instant::now() })
    }

    /// The robot.
    pub fn robot(&self) -> RobotId {
        self.talk.robot()
    }

    /// What was counted so far.
    pub fn figures(&self) -> LinkFigures {
        self.talk.figures()
    }

    /// For how long nothing has been heard; since the link was opened, if nothing ever was.
    pub fn silent_for(&self) -> Duration {
        self.began.elapsed().saturating_sub(self.talk.heard().unwrap_or_default())
    }

    /// Whether anything of the match was ever heard.
    pub fn has_heard(&self) -> bool {
        self.talk.heard().is_some()
    }

    /// Wants pictures and data so often from now on.
    pub fn subscribe(&mut self, wanted: Subscription) {
        self.talk.subscribe(wanted);
    }

    /// Drives the robot with these controls from now on, or hands it back. Call [`ChaosLink::poll`] several times a second: the
    /// robot stops when it hears nothing.
    pub fn steer(&mut self, pilot: Option<Pilot>) {
        self.talk.steer(pilot, self.began.elapsed());
    }

    /// Gives an order, which is sent again and again until it is answered, for so long at most. Returns its number, by which it
    /// is answered.
    pub fn order(&mut self, instruction: Instruction, patience: Duration) -> u32 {
        self.talk.order(instruction, self.began.elapsed() + patience)
    }

    /// Sends what is to be sent, and returns what was heard; waits so long for something.
    ///
    /// # Errors
    /// If the network cannot be reached.
    pub fn poll(&mut self, patience: Duration) -> Result<Vec<ChaosNews>, NetworkError> {
        let begin = Instant::now();
        loop {
            let to = self.talk.orders_to();
            for datagram in self.talk.due(self.began.elapsed()) {
                self.conn.send(to, &datagram)?;
            }
            let left = patience.saturating_sub(begin.elapsed());
            let mut news = self.hear(left.min(LOOK))?;
            news.extend(self.talk.overdue(self.began.elapsed()));
            if !news.is_empty() || left.is_zero() {
                return Ok(news);
            }
        }
    }

    /// Hears what has come; waits so long for the first.
    fn hear(&mut self, patience: Duration) -> Result<Vec<ChaosNews>, NetworkError> {
        let (mut news, mut patience) = (Vec::new(), patience);
        for _ in 0..AT_A_TIME {
            let Some((from, datagram)) = self.conn.wait(patience)? else { break };
            patience = Duration::ZERO;
            news.extend(self.talk.take(from, datagram, self.began.elapsed()));
        }
        Ok(news)
    }
}
