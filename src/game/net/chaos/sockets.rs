//! The match's side of ChaosManager: three sockets beside the team's own (TeamChaos, section 3). What comes in is bounded in each
//! tick, and everything that it changes is a request; what goes out waits in bounded queues.

use std::net::SocketAddr;

use bevy::log::info;
use bevy::prelude::*;
use serde::Serialize;

use super::drivers::Drivers;
use super::messages::{CameraData, ChaosOrder, Instruction, OrderAnswer, Refusal};
use super::orders::{Answered, play_strategy, set_camera, set_colours, with_camera};
use super::outbox::{Outbox, OutboxFigures};
use super::plan::ChaosPlan;
use super::robot_data::{RobotView, debug_data, image_data};
use super::subscribers::Subscribers;
use super::table::ChaosSocket;
use crate::clock::Clock;
use crate::comms::tcm::fragments::{Assembly, Limits};
use crate::comms::tcm::udp::UdpConn;
use crate::comms::tcm::{Data, HOST, Peer};
use crate::game::MatchPlan;
use crate::game::net::error::NetworkError;
use crate::game::net::timing::DATAGRAMS_A_TICK;
use crate::game::requests::{Request, Requests};
use crate::ids::RobotId;
use crate::strategy::Strategies;

/// Pictures that wait, and the datagrams of pictures in a tick: some 3.3 MB/s, or thirty AIBO's pictures.
const IMAGES: (usize, usize) = (4, 40);
/// Data that wait, and their datagrams in a tick.
const DATA: (usize, usize) = (64, 32);
/// Answers that wait, and their datagrams in a tick.
const ANSWERS: (usize, usize) = (64, 16);
/// The longest order, bytes.
const LONGEST_ORDER: usize = 1 << 20;
/// How long a part of an order waits for the rest, s.
const ORDER_TIMEOUT: f32 = 2.0;

/// What was counted at the three sockets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct ChaosFigures {
    /// Pictures.
    pub images: OutboxFigures,
    /// Data.
    pub data: OutboxFigures,
    /// Answers.
    pub answers: OutboxFigures,
    /// Orders.
    pub orders: OrderFigures,
}

/// Counts of what came in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct OrderFigures {
    /// Orders that were carried out.
    pub obeyed: u64,
    /// Orders that were refused.
    pub refused: u64,
    /// Orders that came again, and were only answered again.
    pub repeated: u64,
    /// Strategies beyond the one that a tick reads; they are heard when they come again.
    pub postponed: u64,
    /// Datagrams from addresses that the match does not list.
    pub foreign: u64,
    /// Datagrams and messages that are no orders.
    pub malformed: u64,
    /// Orders of which a part did not arrive in time.
    pub expired: u64,
}

/// The three sockets and what is known of those who speak through them.
pub(in crate::game::net) struct ChaosSockets {
    plan: MatchPlan,
    listed: ChaosPlan,
    conns: [UdpConn; 3],
    assembly: Assembly,
    subscribers: Subscribers,
    drivers: Drivers,
    answered: Answered,
    images: Outbox,
    data: Outbox,
    answers: Outbox,
    orders: OrderFigures,
}

impl ChaosSockets {
    /// Opens the sockets, and says where they are and who may use them.
    ///
    /// # Errors
    /// If one cannot be bound.
    pub fn open(plan: &MatchPlan, listed: &ChaosPlan, session: u32) -> Result<ChaosSockets, NetworkError> {
        let [images, data, orders] = listed.addresses().ok_or(NetworkError::NoPorts(listed.at))?;
        let conns = [UdpConn::bind(images)?, UdpConn::bind(data)?, UdpConn::bind(orders)?];
        info!("ChaosManager: pictures at {images}, data at {data}, orders at {orders}, for {listed}");
        let clock = Clock::default();
        let timeout = clock.ticks(ORDER_TIMEOUT);
        let limits = Limits { messages: 16, bytes: 4 << 20, message_bytes: LONGEST_ORDER, timeout };
        let outbox = |(capacity, datagrams)| Outbox::new(capacity, datagrams, session);
        Ok(ChaosSockets {
            plan: plan.clone(),
            listed: listed.clone(),
            conns,
            assembly: Assembly::new(limits),
            subscribers: Subscribers::default(),
            drivers: Drivers::default(),
            answered: Answered::default(),
            images: outbox(IMAGES),
            data: outbox(DATA),
            answers: outbox(ANSWERS),
            orders: OrderFigures::default(),
        })
    }

    /// What was counted so far.
    pub fn figures(&self) -> ChaosFigures {
        ChaosFigures {
            images: self.images.figures(),
            data: self.data.figures(),
            answers: self.answers.figures(),
            orders: OrderFigures { expired: self.assembly.counters().expired, ..self.orders },
        }
    }

    /// Hears orders, and sends what subscribers want.
    pub fn exchange(&mut self, world: &mut World) {
        let clock = *world.resource::<Clock>();
        self.assembly.expire(clock.tick);
        self.hear(world, &clock);
        let mut requests = world.resource_mut::<Requests>();
        self.drivers.expire(&clock).into_iter().for_each(|request| requests.ask(request));
        self.subscribers.expire(clock.tick);
        self.publish(world, &clock);
        let [images, data, orders] = &mut self.conns;
        self.images.send(&mut |to, datagram| images.send(to, datagram).is_ok());
        self.data.send(&mut |to, datagram| data.send(to, datagram).is_ok());
        self.answers.send(&mut |to, datagram| orders.send(to, datagram).is_ok());
    }

    fn hear(&mut self, world: &mut World, clock: &Clock) {
        let mut reads_strategy = true;
        for _ in 0..DATAGRAMS_A_TICK {
            let Ok(Some((from, datagram))) = self.conns[ChaosSocket::Orders as usize].receive() else {
                break;
            };
            if !self.listed.accepts(from.ip()) {
                self.orders.foreign += 1;
                continue;
            }
            let message = match self.assembly.accept(clock.tick, datagram) {
                Ok(None) => continue,
                Ok(message) => message,
                Err(_) => None,
            };
            let order = message.and_then(|message| {
                let order = ChaosOrder::unserialise(message.data_type, &message.data)?;
                let who = message.source.peer;
                let is_computer = matches!(who, Peer::Computer(_)) && who != HOST;
                is_computer.then_some((who, message.destination.peer.robot()?, order))
            });
            let Some((who, robot, order)) = order else {
                self.orders.malformed += 1;
                continue;
            };
            if let Some(answer) = self.answered.find(from, robot, order.number) {
                self.orders.repeated += 1;
                self.answers.put(answer, robot, (who, from));
                continue;
            }
            if matches!(order.instruction, Instruction::PlayStrategy(_))
                && !std::mem::replace(&mut reads_strategy, false)
            {
                self.orders.postponed += 1;
                continue;
            }
            self.answer(world, clock, (who, from), robot, order);
        }
        // What comes to the others is nothing for anybody.
        for socket in [ChaosSocket::Images, ChaosSocket::Data] {
            for _ in 0..DATAGRAMS_A_TICK {
                let Ok(Some(_)) = self.conns[socket as usize].receive() else { break };
                self.orders.malformed += 1;
            }
        }
    }

    /// Asks for what an order comes to, and says what became of it.
    fn answer(
        &mut self,
        world: &mut World,
        clock: &Clock,
        (who, from): (Peer, SocketAddr),
        robot: RobotId,
        order: ChaosOrder,
    ) {
        let (number, what, is_answered) = (order.number, order.what(), order.is_answered());
        let outcome = self.obey(world, clock, (who, from), robot, order.instruction);
        let outcome = match outcome {
            Ok(requests) => {
                self.orders.obeyed += 1;
                let mut door = world.resource_mut::<Requests>();
                requests.into_iter().for_each(|request| door.ask(request));
                Ok(())
            }
            Err(why) => {
                self.orders.refused += 1;
                Err(Refusal { what: what.into(), why })
            }
        };
        if is_answered || outcome.is_err() {
            let answer = OrderAnswer { number, outcome };
            self.answers.put(&answer, robot, (who, from));
            if is_answered {
                self.answered.remember(from, robot, answer);
            }
        }
    }

    fn obey(
        &mut self,
        world: &mut World,
        clock: &Clock,
        (who, from): (Peer, SocketAddr),
        robot: RobotId,
        instruction: Instruction,
    ) -> Result<Vec<Request>, String> {
        let mut robots = world.query::<RobotView>();
        let found = robots.iter(world).find(|(id, ..)| **id == robot);
        let Some((.., camera, _, is_driven)) = found else {
            return Err(format!("there is no robot `{robot}` in this match"));
        };
        let has_camera = camera.is_some();
        match instruction {
            Instruction::Subscribe(wanted) => {
                if wanted.images_hz > 0.0 {
                    with_camera(has_camera)?;
                }
                self.subscribers.renew(robot, (who, from), wanted, clock).map(|()| Vec::new())
            }
            Instruction::SetCamera(settings) => set_camera(robot, settings, has_camera).map(|it| vec![it]),
            Instruction::SetColours(colours) => set_colours(robot, colours, has_camera).map(|it| vec![it]),
            Instruction::PlayStrategy(text) => play_strategy(&self.plan, robot.team, text).map(|it| vec![it]),
            Instruction::Teleoperate(pilot) => self.drivers.hear(robot, from, pilot, is_driven, clock.tick),
        }
    }

    /// Puts what is due for subscribers into the queues.
    fn publish(&mut self, world: &mut World, clock: &Clock) {
        let mut robots = world.query::<RobotView>();
        let strategies = world.resource::<Strategies>();
        let tick = clock.tick;
        for subscriber in self.subscribers.iter_mut() {
            let (robot, at) = (subscriber.robot, subscriber.at);
            let Some((_, mind, intents, camera, eyes, is_driven)) =
                robots.iter(world).find(|(id, ..)| **id == robot)
            else {
                continue;
            };
            if let Some(number) = subscriber.next_data(tick) {
                let data = debug_data(robot, mind, intents, eyes, is_driven, (strategies, clock, number));
                self.data.put(&data, robot, at);
            }
            if subscriber.hears_calibration(tick)
                && let Some(camera) = camera
            {
                let calibration = camera.0.as_ref().clone();
                self.data.put(&CameraData { tick, calibration }, robot, at);
            }
            let image = eyes.and_then(|eyes| image_data(eyes, |taken| subscriber.next_image(taken, tick)));
            if let Some(image) = image {
                self.images.put(&image, robot, at);
            }
        }
    }
}
