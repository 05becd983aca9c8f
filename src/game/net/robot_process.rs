//! A robot as a process of its own: its beliefs, teamwork, behaviour and motor schemas, with the sensors and motors of a
//! match that is elsewhere. Team messages go straight from robot to robot.

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::time::{Duration, Instant};

use bevy::prelude::*;
use serde::Serialize;

use super::carrier::{CarrierFigures, UdpCarrier};
use super::error::NetworkError;
use super::introduction::Introduction;
use super::remote_messages::{RobotReply, Sensors, datagrams};
use super::timing::{DATAGRAMS_A_TICK, unused_number};
use crate::clock::Clock;
use crate::comms::tcm::fragments::{Assembly, Limits};
use crate::comms::tcm::udp::UdpConn;
use crate::comms::tcm::{Addresses, Data, HOST, MessageBudgets, Peer, Tcm};
use crate::game::requests::{Requests, RobotWants};
use crate::game::{MatchPlan, start_mind};
use crate::ids::RobotId;
use crate::mind::world_model::WorldModel;
use crate::robot::handling::{Grip, Handling};
use crate::robot::{Head, HeadIntent, KickIntent, Odometry, OffPitch, Percepts, RobotState, SteeringIntent};
use crate::schedule::Tick;
use crate::strategy::{Activity, Role};
use crate::{comms, mind, pitch, robot, schedule};

/// How often a robot that waits looks whether it is to stop.
const LOOK: Duration = Duration::from_millis(100);
/// How often a robot says why it does not belong to a match: datagrams get lost, and it says nothing more.
const LAST_WORDS: usize = 3;

/// A robot without a body.
pub struct RobotProcess {
    app: App,
    plan: MatchPlan,
    id: RobotId,
    entity: Entity,
    assembly: Assembly,
    counter: u32,
    /// The match that it belongs to, once one has greeted it, by its session.
    introduction: Option<Introduction>,
    /// When its match was heard last.
    heard: Instant,
    answered: u64,
}

/// Counts of a robot's datagrams, for its report at the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct RobotReport {
    /// The robot.
    pub robot: RobotId,
    /// Why it ended.
    pub ending: RobotEnd,
    /// Ticks in which it answered its match.
    pub answered: u64,
    /// Counts of its team's datagrams.
    #[serde(flatten)]
    pub datagrams: CarrierFigures,
}

/// Why a robot in a process of its own ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RobotEnd {
    /// Its match is over.
    MatchOver,
    /// Nothing was heard of its match for long.
    MatchGone,
    /// It was told to stop.
    Stopped,
}

/// What a robot has waited for.
enum Awaiting {
    Sensors(SocketAddr, Box<Sensors>),
    End(RobotEnd),
}

impl RobotProcess {
    /// A robot of a match, at this address.
    ///
    /// # Errors
    /// If the address cannot be bound.
    pub fn open(plan: &MatchPlan, id: RobotId, bind: SocketAddr) -> Result<RobotProcess, NetworkError> {
        let carrier = UdpCarrier::of(BTreeMap::from([(id, UdpConn::bind(bind)?)]));
        let (app, entity) = mind(plan, id, carrier);
        Ok(RobotProcess {
            app,
            plan: plan.clone(),
            id,
            entity,
            // Not those of the match, of which the other side may think differently.
            assembly: Assembly::new(Limits::default()),
            // Commands count from far away, since they come from the same peer as messages to the team.
            counter: unused_number().wrapping_add(1 << 31),
            introduction: None,
            heard: Instant::now(),
            answered: 0,
        })
    }

    /// Plays until the match is over, or nothing has been heard of it for as long as `patience`, or `stops` says so.
    ///
    /// # Errors
    /// If no match comes, or one to which the robot does not belong.
    pub fn play(
        &mut self,
        patience: Duration,
        stops: &dyn Fn() -> bool,
    ) -> Result<RobotReport, NetworkError> {
        self.heard = Instant::now();
        let ending = loop {
            match self.wait(patience, stops)? {
                Awaiting::End(ending) => break ending,
                Awaiting::Sensors(_, sensors) if sensors.orders.state == RobotState::Finished => {
                    break RobotEnd::MatchOver;
                }
                Awaiting::Sensors(from, sensors) => {
                    self.feel(&sensors);
                    let (tick, asked) = (sensors.tick, sensors.asked);
                    let world = self.app.world_mut();
                    let mut requests = world.resource_mut::<Requests>();
                    asked.into_iter().for_each(|request| requests.ask(request));
                    world.run_schedule(Tick);
                    world.clear_trackers();
                    self.answered += 1;
                    self.answer(from, tick);
                }
            }
        };
        self.drain();
        let datagrams = self.app.world().resource::<UdpCarrier>().figures;
        Ok(RobotReport { robot: self.id, ending, answered: self.answered, datagrams })
    }

    /// The next sensors. What team mates say meanwhile waits for the tick.
    fn wait(&mut self, patience: Duration, stops: &dyn Fn() -> bool) -> Result<Awaiting, NetworkError> {
        loop {
            if stops() {
                return Ok(Awaiting::End(RobotEnd::Stopped));
            }
            let left = patience.saturating_sub(self.heard.elapsed());
            if left.is_zero() {
                return self.give_up(patience);
            }
            let Some((from, datagram)) = self.receive(left.min(LOOK)) else { continue };
            if self.accept(from, &datagram) == Some(HOST)
                && let Some(sensors) = self.hear_match(from, &datagram)?
            {
                return Ok(Awaiting::Sensors(from, sensors));
            }
        }
    }

    fn give_up(&self, patience: Duration) -> Result<Awaiting, NetworkError> {
        if self.introduction.is_some() {
            return Ok(Awaiting::End(RobotEnd::MatchGone));
        }
        let directory = &self.app.world().resource::<Addresses>().0;
        let address = directory.address_of(HOST).ok_or(NetworkError::NoAddress(HOST))?;
        Err(NetworkError::NoMatch { robot: self.id, address, patience })
    }

    /// Keeps what a mate or a computer says for the tick in which it is heard; tells who it was.
    fn accept(&mut self, from: SocketAddr, datagram: &[u8]) -> Option<Peer> {
        let world = self.app.world_mut();
        let directory = world.resource::<Addresses>().0.clone();
        world.resource_mut::<UdpCarrier>().accept(self.id, from, datagram, &directory)
    }

    /// What a datagram of the match comes to: sensors, if it brings some of the match that has greeted the robot.
    fn hear_match(
        &mut self,
        from: SocketAddr,
        datagram: &[u8],
    ) -> Result<Option<Box<Sensors>>, NetworkError> {
        let Ok(Some(message)) = self.assembly.accept(0, datagram) else { return Ok(None) };
        let (data_type, data) = (message.data_type, message.data);
        if let Some(there) = Introduction::unserialise(data_type, &data) {
            return self.meet(from, &there).map(|()| None);
        }
        if let Some(sensors) = Sensors::unserialise(data_type, &data) {
            let known = self.introduction.as_ref().is_some_and(|known| known.session == sensors.session);
            if known {
                self.heard = Instant::now();
            }
            // Who was started in the midst of a match waits until it is greeted.
            return Ok(Some(Box::new(sensors)).filter(|_| known));
        }
        let difference = "it says what no match of this version says".into();
        Err(NetworkError::OtherMatch { robot: self.id, address: from, difference })
    }

    /// Introduces itself to a match that has introduced itself.
    fn meet(&mut self, from: SocketAddr, there: &Introduction) -> Result<(), NetworkError> {
        let here = Introduction::new(&self.plan, self.id, there.session);
        if let Some(difference) = here.difference(there) {
            for _ in 0..LAST_WORDS {
                self.send(from, &here);
            }
            return Err(NetworkError::OtherMatch { robot: self.id, address: from, difference });
        }
        self.heard = Instant::now();
        let is_new = self.introduction.as_ref().is_none_or(|known| known.session != there.session);
        if is_new && self.answered > 0 {
            self.begin_again();
        }
        self.send(from, &here);
        self.app.world_mut().resource_mut::<UdpCarrier>().session = there.session;
        self.introduction = Some(here);
        Ok(())
    }

    /// Its match has begun from the beginning: so does the robot.
    fn begin_again(&mut self) {
        let Some(carrier) = self.app.world_mut().remove_resource::<UdpCarrier>() else { return };
        (self.app, self.entity) = mind(&self.plan, self.id, carrier.renewed());
        self.answered = 0;
    }

    fn receive(&mut self, patience: Duration) -> Option<(SocketAddr, Vec<u8>)> {
        let mut carrier = self.app.world_mut().resource_mut::<UdpCarrier>();
        let received = carrier.conn(self.id)?.wait(patience);
        received.ok().flatten().map(|(from, bytes)| (from, bytes.to_vec()))
    }

    /// Counts what has arrived when the match is over. In lock-step nobody says anything more.
    fn drain(&mut self) {
        for _ in 0..DATAGRAMS_A_TICK {
            let Some((from, datagram)) = self.receive(Duration::ZERO) else { break };
            self.accept(from, &datagram);
        }
    }

    fn feel(&mut self, sensors: &Sensors) {
        let world = self.app.world_mut();
        world.resource_mut::<Clock>().tick = sensors.tick;
        let mut robot = world.entity_mut(self.entity);
        robot.insert((Percepts { frame: sensors.frame.clone() }, Head { pan: sensors.pan }, sensors.orders));
        if let Some(mut odometry) = robot.get_mut::<Odometry>() {
            odometry.pose = sensors.odometry;
            odometry.speed = sensors.speed;
            odometry.turn_rate = sensors.turn_rate;
            odometry.told = sensors.told;
            odometry.bump.reports = sensors.bumped;
        }
        if let Some(mut handling) = robot.get_mut::<Handling>() {
            handling.grip =
                if sensors.holds_ball { Grip::Holding { since: sensors.tick } } else { Grip::Open };
        }
        match sensors.orders.state {
            RobotState::Penalised => robot.insert(OffPitch),
            _ => robot.remove::<OffPitch>(),
        };
    }

    fn answer(&mut self, to: SocketAddr, tick: u64) {
        if let Some(command) = self.command(tick) {
            self.send(to, &command);
        }
    }

    fn send<T: Data>(&mut self, to: SocketAddr, data: &T) {
        let datagrams = datagrams(data, self.id.into(), HOST, &mut self.counter);
        let mut carrier = self.app.world_mut().resource_mut::<UdpCarrier>();
        let Some(conn) = carrier.conn(self.id) else { return };
        for datagram in datagrams {
            // A match that is gone is noticed by its silence.
            let _ = conn.send(to, &datagram);
        }
    }

    fn command(&mut self, tick: u64) -> Option<RobotReply> {
        let world = self.app.world();
        let figures = world.resource::<UdpCarrier>().figures;
        let robot = world.entity(self.entity);
        let activity = robot.get::<Activity>()?;
        let model = robot.get::<WorldModel>()?;
        let wants = RobotWants {
            tick,
            steering: *robot.get::<SteeringIntent>()?,
            kick: *robot.get::<KickIntent>()?,
            head: *robot.get::<HeadIntent>()?,
            role: robot.get::<Role>()?.0 as u8,
            acting_as: activity.acting_as as u8,
            state: activity.state as u16,
            pose: model.pose,
            ball: model.ball.map(|ball| ball.position),
        };
        let session = self.introduction.as_ref()?.session;
        let said = world.resource::<MessageBudgets>().spent(self.id.team).counted;
        Some(RobotReply { session, wants, datagrams: (figures.sent, figures.received), said })
    }
}

/// A world with nothing but the mind of a robot.
fn mind(plan: &MatchPlan, id: RobotId, carrier: UdpCarrier) -> (App, Entity) {
    let mut app = App::new();
    // Its mind, without a world around it.
    let contract = (schedule::plugin, pitch::plugin, robot::plugin);
    app.add_plugins((contract, comms::modules, super::robot_plugin, mind::plugin));
    app.finish();
    app.cleanup();
    let entity = start_mind(app.world_mut(), plan, id);
    app.insert_resource(carrier);
    // The match keeps the team's budget; the robot tells it what there is to count.
    app.insert_resource(MessageBudgets::counting(0, 0));
    if let Some(mut tcm) = app.world_mut().get_mut::<Tcm>(entity) {
        tcm.count_from(unused_number());
    }
    (app, entity)
}
