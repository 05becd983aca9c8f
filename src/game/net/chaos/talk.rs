//! ChaosManager's side without sockets: what it says when, and what it makes of what it hears. Times are counted from the beginning of
//! the talk.

use std::net::SocketAddr;
use std::time::Duration;

use serde::Serialize;

use super::messages::{
    CameraData, ChaosOrder, DebugData, ImageData, Instruction, OrderAnswer, Refusal, Subscription,
};
use super::table::ChaosSocket;
use crate::comms::tcm::fragments::{Assembly, Limits, USUAL_DATAGRAM, cut};
use crate::comms::tcm::{Data, ExternalMessage, Peer};
use crate::ids::RobotId;
use crate::robot::pilot::Pilot;

/// How often a subscription is renewed; it lasts for ten times as long.
const RENEWAL: Duration = Duration::from_millis(500);
/// How often an order is sent again until it is answered.
const REPEAT: Duration = Duration::from_millis(300);
/// How often controls are sent while they stay the same. A robot stops if it hears nothing for five times as long.
const STEERING: Duration = Duration::from_millis(100);
/// The longest message that is taken, bytes: a picture of 1024 x 1024 pixels and what is around it.
const LONGEST: usize = (3 << 20) + 64;
/// How long a part of a message waits for the rest, ms.
const TIMEOUT: u64 = 2_000;
/// By how many numbers a message that comes late may be behind; one that is farther behind begins a new row.
const LATE: u32 = 32;

/// What was heard.
#[derive(Clone, Debug, PartialEq)]
pub enum ChaosNews {
    /// A picture.
    Image(ImageData),
    /// How the camera is calibrated.
    Camera(CameraData),
    /// What the robot believes, is in and wants.
    Debug(Box<DebugData>),
    /// The order of this number is carried out.
    Accepted(u32),
    /// The order of this number is not carried out.
    Refused(u32, Refusal),
    /// Nobody has answered the order of this number in time.
    Unanswered(u32),
}

/// What was counted of one kind of message.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct StreamFigures {
    /// Messages that arrived whole.
    pub received: u64,
    /// Messages that were sent before the last one and did not arrive, or not in time.
    pub missing: u64,
    /// Of those that arrived.
    pub bytes: u64,
}

/// What was counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct LinkFigures {
    /// Pictures.
    pub images: StreamFigures,
    /// Data.
    pub data: StreamFigures,
    /// Orders that were sent, each once.
    pub orders: u64,
    /// Datagrams from anybody else, or that say nothing to this side.
    pub foreign: u64,
    /// Messages of which a part did not arrive in time.
    pub expired: u64,
}

/// A talk with one robot of a match.
#[derive(Debug)]
pub struct ChaosTalk {
    robot: RobotId,
    me: Peer,
    sockets: [SocketAddr; 3],
    counter: u32,
    assembly: Assembly,
    wanted: Subscription,
    subscribed: Option<Duration>,
    pilot: Option<Pilot>,
    steered: Option<Duration>,
    open: Vec<OpenOrder>,
    last_image: Option<u32>,
    last_data: Option<u32>,
    heard: Option<Duration>,
    figures: LinkFigures,
}

/// An order that is not answered yet.
#[derive(Debug)]
struct OpenOrder {
    number: u32,
    datagrams: Vec<Vec<u8>>,
    sent: Option<Duration>,
    until: Duration,
}

impl ChaosTalk {
    /// A talk with a robot of the match that has these sockets. Messages are counted from `counter` on, which the last talk from
    /// this place has not used.
    pub fn new(sockets: [SocketAddr; 3], robot: RobotId, counter: u32) -> ChaosTalk {
        let limits = Limits { messages: 64, bytes: 4 * LONGEST, message_bytes: LONGEST, timeout: TIMEOUT };
        ChaosTalk {
            robot,
            me: Peer::Computer(0),
            sockets,
            counter,
            assembly: Assembly::new(limits),
            wanted: Subscription::default(),
            subscribed: None,
            pilot: None,
            steered: None,
            open: Vec::new(),
            last_image: None,
            last_data: None,
            heard: None,
            figures: LinkFigures::default(),
        }
    }

    /// The robot.
    pub fn robot(&self) -> RobotId {
        self.robot
    }

    /// What was counted so far.
    pub fn figures(&self) -> LinkFigures {
        LinkFigures { expired: self.assembly.counters().expired, ..self.figures }
    }

    /// When something was heard of the match last.
    pub fn heard(&self) -> Option<Duration> {
        self.heard
    }

    /// Wants pictures and data so often from now on.
    pub fn subscribe(&mut self, wanted: Subscription) {
        if self.wanted != wanted {
            self.wanted = wanted;
            self.subscribed = None;
        }
    }

    /// Drives the robot with these controls from now on, or hands it back.
    pub fn steer(&mut self, pilot: Option<Pilot>, now: Duration) {
        if self.pilot == pilot {
            return;
        }
        (self.pilot, self.steered) = (pilot, None);
        if pilot.is_none() {
            self.order(Instruction::Teleoperate(None), now + 10 * STEERING);
        }
    }

    /// Gives an order, which is sent again and again until it is answered, or until then. Returns its number.
    pub fn order(&mut self, instruction: Instruction, until: Duration) -> u32 {
        let (number, datagrams) = self.write(instruction);
        self.open.push(OpenOrder { number, datagrams, sent: None, until });
        number
    }

    fn write(&mut self, instruction: Instruction) -> (u32, Vec<Vec<u8>>) {
        self.counter = self.counter.wrapping_add(1);
        self.figures.orders += 1;
        let number = self.counter;
        let order = ChaosOrder { number, instruction };
        let message = ExternalMessage::of(&order, self.me, self.robot.into());
        // What is too long for any message is never answered.
        (number, cut(&message, number, USUAL_DATAGRAM).unwrap_or_default())
    }

    /// What is to be sent now, to the match's socket for orders.
    pub fn due(&mut self, now: Duration) -> Vec<Vec<u8>> {
        let is_due =
            |last: Option<Duration>, every| last.is_none_or(|last| now.saturating_sub(last) >= every);
        let mut datagrams = Vec::new();
        if self.wanted != Subscription::default() && is_due(self.subscribed, RENEWAL) {
            self.subscribed = Some(now);
            datagrams.extend(self.write(Instruction::Subscribe(self.wanted)).1);
        }
        if let Some(pilot) = self.pilot
            && is_due(self.steered, STEERING)
        {
            self.steered = Some(now);
            datagrams.extend(self.write(Instruction::Teleoperate(Some(pilot))).1);
        }
        for order in self.open.iter_mut().filter(|order| is_due(order.sent, REPEAT)) {
            order.sent = Some(now);
            datagrams.extend_from_slice(&order.datagrams);
        }
        datagrams
    }

    /// Where orders go.
    pub fn orders_to(&self) -> SocketAddr {
        self.sockets[ChaosSocket::Orders as usize]
    }

    /// The orders that nobody has answered in time; they are not sent again.
    pub fn overdue(&mut self, now: Duration) -> Vec<ChaosNews> {
        let overdue = self.open.extract_if(.., |order| order.until <= now);
        overdue.map(|order| ChaosNews::Unanswered(order.number)).collect()
    }

    /// Takes a datagram that has arrived from an address, and returns what it completes.
    pub fn take(&mut self, from: SocketAddr, datagram: &[u8], now: Duration) -> Option<ChaosNews> {
        let milliseconds = u64::try_from(now.as_millis()).unwrap_or(u64::MAX);
        self.assembly.expire(milliseconds);
        let is_of_match = self.sockets.iter().any(|known| is_same(*known, from));
        let message = match self.assembly_takes(is_of_match, milliseconds, datagram) {
            Ok(message) => message?,
            Err(()) => {
                self.figures.foreign += 1;
                return None;
            }
        };
        let news = self.read(&message, from);
        match news {
            Some(_) => self.heard = Some(now),
            None => self.figures.foreign += 1,
        }
        self.settle(news?, message.data.len())
    }

    fn assembly_takes(
        &mut self,
        is_of_match: bool,
        now: u64,
        datagram: &[u8],
    ) -> Result<Option<ExternalMessage>, ()> {
        if is_of_match { self.assembly.accept(now, datagram).map_err(drop) } else { Err(()) }
    }

    /// What a message says, if it is the robot's, for this side, and came over its socket.
    fn read(&self, message: &ExternalMessage, from: SocketAddr) -> Option<ChaosNews> {
        let (data_type, data) = (message.data_type, &message.data);
        let socket = ChaosSocket::of(data_type)?;
        let is_mine = message.source.peer == self.robot.into() && message.destination.peer == self.me;
        if !is_mine || !is_same(self.sockets[socket as usize], from) {
            return None;
        }
        let image = || ImageData::unserialise(data_type, data).map(ChaosNews::Image);
        let camera = || CameraData::unserialise(data_type, data).map(ChaosNews::Camera);
        let debug = || DebugData::unserialise(data_type, data).map(|data| ChaosNews::Debug(Box::new(data)));
        let answer = || {
            let OrderAnswer { number, outcome } = OrderAnswer::unserialise(data_type, data)?;
            Some(match outcome {
                Ok(()) => ChaosNews::Accepted(number),
                Err(refusal) => ChaosNews::Refused(number, refusal),
            })
        };
        image().or_else(camera).or_else(debug).or_else(answer)
    }

    /// Counts what was heard; nothing comes of what is late or comes twice.
    fn settle(&mut self, news: ChaosNews, bytes: usize) -> Option<ChaosNews> {
        let is_new = match &news {
            ChaosNews::Image(image) => self.figures.images.count(&mut self.last_image, image.number, bytes),
            ChaosNews::Debug(data) => self.figures.data.count(&mut self.last_data, data.number, bytes),
            ChaosNews::Accepted(number) | ChaosNews::Refused(number, _) => {
                let known = self.open.iter().position(|order| order.number == *number);
                // What is only answered when it is refused is not waited for.
                known.map(|place| self.open.remove(place)).is_some() || matches!(news, ChaosNews::Refused(..))
            }
            ChaosNews::Camera(_) | ChaosNews::Unanswered(_) => true,
        };
        is_new.then_some(news)
    }
}

impl StreamFigures {
    /// Counts a message by its number, and tells whether it is newer than the last.
    fn count(&mut self, last: &mut Option<u32>, number: u32, bytes: usize) -> bool {
        let before = last.unwrap_or(0);
        if number <= before && before - number < LATE {
            return false;
        }
        // Another row begins with 1.
        let expected = if number > before { before + 1 } else { 1 };
        self.missing += u64::from(number.saturating_sub(expected));
        self.received += 1;
        self.bytes += bytes as u64;
        *last = Some(number);
        true
    }
}

fn is_same(one: SocketAddr, other: SocketAddr) -> bool {
    one.port() == other.port() && one.ip().to_canonical() == other.ip().to_canonical()
}

#[cfg(test)]
mod tests;
