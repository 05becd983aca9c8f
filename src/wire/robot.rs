//! A robot as a process of its own: its beliefs, teamwork, behaviour and motor schemas, with the sensors and motors of a
//! match that is elsewhere. Team messages go straight from robot to robot.

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::time::{Duration, SystemTime};

use bevy::prelude::*;
use serde::Serialize;

use super::WireError;
use super::carrier::{CarrierFigures, UdpCarrier};
use super::protocol::{Command, Sensors, datagrams};
use crate::behaviour::Activity;
use crate::clock::Clock;
use crate::game::{MatchPlan, start_mind};
use crate::handling::{Grip, Handling, KickIntent};
use crate::head::{Head, HeadIntent};
use crate::ids::RobotId;
use crate::motor::SteeringIntent;
use crate::referee::RobotState;
use crate::robot::OffPitch;
use crate::schedule::Tick;
use crate::sense::{Odometry, Percepts};
use crate::tcm::external_message::Entity as Party;
use crate::tcm::fragments::Assembly;
use crate::tcm::udp::UdpConn;
use crate::tcm::{Addresses, Data, HOST, Incoming, MessageBudgets, Tcm, party};
use crate::teamwork::Role;
use crate::world_model::WorldModel;

/// How long a robot waits for its match, before it begins and while it goes on.
const PATIENCE: Duration = Duration::from_secs(20);

/// A robot without a body.
pub struct RobotProcess {
    app: App,
    id: RobotId,
    entity: Entity,
    sensors: Assembly,
    counter: u32,
}

/// What became of a robot's datagrams, when its match is over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct RobotReport {
    pub robot: RobotId,
    /// Ticks in which it answered its match.
    pub answered: u64,
    #[serde(flatten)]
    pub datagrams: CarrierFigures,
}

/// A counter that the last process of this robot has not used: milliseconds on the wall's clock.
fn unused_counter() -> u32 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    since.map_or(0, |since| since.as_millis() as u32)
}

impl RobotProcess {
    /// A robot of a match at this address.
    ///
    /// # Errors
    /// If the address cannot be bound, or the match has no such robot.
    pub fn open(plan: &MatchPlan, id: RobotId, bind: SocketAddr) -> Result<RobotProcess, WireError> {
        let mut app = App::new();
        app.add_plugins(crate::mind);
        app.finish();
        app.cleanup();
        let entity = start_mind(app.world_mut(), plan, id);
        let conns = BTreeMap::from([(id, UdpConn::bind(bind)?)]);
        app.insert_resource(UdpCarrier::of(conns));
        // The match keeps the team's budget; the robot tells it what there is to count.
        app.insert_resource(MessageBudgets::counting(0, 0));
        let sensors = Assembly::new(plan.tcm.limits(&Clock::default()));
        let counter = unused_counter();
        if let Some(mut tcm) = app.world_mut().get_mut::<Tcm>(entity) {
            tcm.count_from(counter);
        }
        // Commands count from far away, since they come from the same entity.
        Ok(RobotProcess { app, id, entity, sensors, counter: counter.wrapping_add(1 << 31) })
    }

    /// Plays until the match is over, or nothing has been heard of it for long.
    pub fn play(&mut self) -> RobotReport {
        let mut answered = 0;
        while let Some((from, sensors)) = self.wait() {
            if sensors.orders.state == RobotState::Finished {
                break;
            }
            if sensors.begun {
                self.feel(&sensors);
                let world = self.app.world_mut();
                world.run_schedule(Tick);
                world.clear_trackers();
                answered += 1;
            }
            self.answer(from, sensors.tick);
        }
        self.drain();
        RobotReport { robot: self.id, answered, datagrams: self.app.world().resource::<UdpCarrier>().figures }
    }

    /// The next sensors. What team mates say meanwhile waits for the tick.
    fn wait(&mut self) -> Option<(SocketAddr, Sensors)> {
        loop {
            let (from, datagram) = self.receive(PATIENCE)?;
            let world = self.app.world_mut();
            let tick = world.resource::<Clock>().tick;
            let directory = world.resource::<Addresses>().0.clone();
            let noted = world.resource_mut::<UdpCarrier>().note(from, &datagram, &directory);
            match noted {
                Some((Party::Robot { .. }, _)) => {
                    world.resource_mut::<Incoming>().0.push((self.id, datagram.into()));
                }
                Some((source, header)) if header.data_type == Sensors::TYPE && source == HOST => {
                    let message = self.sensors.accept(tick, &datagram).ok().flatten();
                    if let Some(sensors) = message.and_then(|message| Sensors::unserialise(&message.data)) {
                        return Some((from, sensors));
                    }
                }
                Some(_) => world.resource_mut::<Incoming>().0.push((self.id, datagram.into())),
                None => {}
            }
        }
    }

    fn receive(&mut self, patience: Duration) -> Option<(SocketAddr, Vec<u8>)> {
        let mut carrier = self.app.world_mut().resource_mut::<UdpCarrier>();
        let received = carrier.conn(self.id)?.wait(patience);
        received.ok().flatten().map(|(from, bytes)| (from, bytes.to_vec()))
    }

    /// Counts what has arrived when the match is over. In lock-step nobody says anything more.
    fn drain(&mut self) {
        while let Some((from, datagram)) = self.receive(Duration::ZERO) {
            let world = self.app.world_mut();
            let directory = world.resource::<Addresses>().0.clone();
            world.resource_mut::<UdpCarrier>().note(from, &datagram, &directory);
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
            odometry.stalled_for = sensors.stalled_for;
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
        let Some(command) = self.command(tick) else { return };
        let datagrams = datagrams(&command, party(self.id), HOST, &mut self.counter);
        let mut carrier = self.app.world_mut().resource_mut::<UdpCarrier>();
        let Some(conn) = carrier.conn(self.id) else { return };
        for datagram in datagrams {
            // A match that is gone is noticed by its silence.
            let _ = conn.send(to, &datagram);
        }
    }

    fn command(&mut self, tick: u64) -> Option<Command> {
        let world = self.app.world();
        let figures = world.resource::<UdpCarrier>().figures;
        let robot = world.entity(self.entity);
        let activity = robot.get::<Activity>()?;
        let model = robot.get::<WorldModel>()?;
        Some(Command {
            tick,
            steering: *robot.get::<SteeringIntent>()?,
            kick: *robot.get::<KickIntent>()?,
            head: *robot.get::<HeadIntent>()?,
            role: robot.get::<Role>()?.0 as u8,
            acting_as: activity.acting_as as u8,
            state: activity.state as u16,
            pose: model.pose,
            ball: model.ball.map(|ball| ball.position),
            datagrams: (figures.sent, figures.received),
            said: world.resource::<MessageBudgets>().spent(self.id.team).counted,
        })
    }
}
