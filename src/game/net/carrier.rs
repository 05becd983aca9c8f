//! UDP as the carrier of team messages (TeamChaos, section 3): every robot has a socket of its own at the address that the
//! directory gives it.

use std::collections::{BTreeMap, VecDeque};
use std::net::SocketAddr;
use std::sync::Arc;

use bevy::prelude::*;

use crate::clock::Clock;
use crate::comms::messages::MessageKind;
use crate::comms::radio::{
    Fate, Loss, MessageCounts, Packet, RadioLog, RadioSystems, Traffic, deliver_datagrams, transmit_datagrams,
};
use crate::comms::tcm::external_message::Entity as Party;
use crate::comms::tcm::fragments::Header;
use crate::comms::tcm::udp::{UdpConn, UdpError};
use crate::comms::tcm::{Addresses, Datagram, Directory, HOST, Incoming, OnAir, TcmSystems, as_robot, party};
use crate::ids::RobotId;
use crate::robot::Robot;
use crate::schedule::{Tick, TickSystems};

use super::WireError;
use super::remote::DATAGRAMS_A_TICK;

pub(super) fn plugin(app: &mut App) {
    let is_used = resource_exists::<UdpCarrier>;
    let receives = deliver.in_set(TickSystems::Deliver).before(TcmSystems::Receive);
    let sends = transmit.in_set(TickSystems::Transmit).after(TcmSystems::Send);
    app.configure_sets(Tick, RadioSystems.run_if(not(is_used)))
        .add_systems(Tick, receives.after(deliver_datagrams).run_if(is_used))
        .add_systems(Tick, sends.after(transmit_datagrams).run_if(is_used));
}

/// The sockets of the robots that this process runs.
#[derive(Resource)]
pub struct UdpCarrier {
    conns: BTreeMap<RobotId, UdpConn>,
    /// Datagrams under way between two robots of this process, the oldest first.
    under_way: VecDeque<UnderWay>,
    pub figures: CarrierFigures,
}

/// Counts of the datagrams of this process's robots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct CarrierFigures {
    /// To robots, wherever they are; those to computers that may listen are not counted.
    pub sent: u64,
    /// From robots, wherever they are.
    pub received: u64,
    /// From computers.
    pub from_computers: u64,
    /// From addresses where the directory has somebody else, or that are no datagrams of the TCM.
    pub foreign: u64,
    /// That the operating system did not take.
    pub refused: u64,
}

struct UnderWay {
    header: (Party, u32, u16),
    to: RobotId,
    kind: MessageKind,
    id: u64,
    sent: u64,
}

/// A datagram that has not arrived after this time is lost, s.
const LOST: f32 = 1.0;

impl UdpCarrier {
    /// Opens a socket for each of these robots.
    ///
    /// # Errors
    /// If a robot has no address, or its address cannot be bound.
    pub fn open(
        directory: &Directory,
        robots: impl Iterator<Item = RobotId>,
    ) -> Result<UdpCarrier, WireError> {
        let mut conns = BTreeMap::new();
        for robot in robots {
            let entity = party(robot);
            let address = directory.address_of(entity).ok_or(WireError::NoAddress(entity))?;
            conns.insert(robot, UdpConn::bind(address)?);
        }
        Ok(UdpCarrier::of(conns))
    }

    /// Opens a socket for one more robot, at another address if its own is taken, and tells where.
    pub(super) fn take_in(&mut self, robot: RobotId, directory: &Directory) -> Result<SocketAddr, WireError> {
        let entity = party(robot);
        let own = directory.address_of(entity).ok_or(WireError::NoAddress(entity))?;
        // Any other is one that the other robots of this process can reach.
        let near = self.conns.values().next().map_or(own.ip(), |conn| conn.address().ip());
        let conn = UdpConn::bind(own).or_else(|_| UdpConn::bind(SocketAddr::new(near, 0)))?;
        let address = conn.address();
        self.conns.insert(robot, conn);
        Ok(address)
    }

    pub(super) fn of(conns: BTreeMap<RobotId, UdpConn>) -> UdpCarrier {
        UdpCarrier { conns, under_way: VecDeque::new(), figures: CarrierFigures::default() }
    }

    /// The same sockets, for another match.
    pub(super) fn renewed(self) -> UdpCarrier {
        UdpCarrier::of(self.conns)
    }

    /// The socket of a robot.
    pub(super) fn conn(&mut self, robot: RobotId) -> Option<&mut UdpConn> {
        self.conns.get_mut(&robot)
    }

    /// Takes note of a datagram that came from an address for one of our robots; tells who sent it, if it is ours.
    pub(super) fn note(
        &mut self,
        from: SocketAddr,
        bytes: &[u8],
        directory: &Directory,
    ) -> Option<(Party, Header)> {
        let known = Header::read(bytes).ok().map(|(header, _)| (header.source.entity, header));
        // Tools may speak from anywhere; robots and the match itself from where the directory has them.
        let sender = known.filter(|(source, _)| match source {
            Party::Computer(_) if *source != HOST => true,
            _ => directory.entity_at(from) == Some(*source),
        });
        match sender {
            Some((Party::Robot { .. }, _)) => self.figures.received += 1,
            Some(_) => self.figures.from_computers += 1,
            None => self.figures.foreign += 1,
        }
        sender
    }

    fn send(&mut self, datagram: &Datagram, directory: &Directory) -> Result<bool, UdpError> {
        let Some(address) = directory.address_of(datagram.to) else { return Ok(false) };
        let Some(conn) = self.conns.get_mut(&datagram.from) else { return Ok(false) };
        conn.send(address, &datagram.bytes).map(|()| true)
    }

    fn arrived(&mut self, header: (Party, u32, u16), to: RobotId) -> Option<UnderWay> {
        let place = self.under_way.iter().position(|sent| sent.header == header && sent.to == to)?;
        self.under_way.remove(place)
    }

    /// Counts what has arrived and was not read.
    pub(super) fn drain(&mut self, directory: &Directory) {
        let ours: Vec<RobotId> = self.conns.keys().copied().collect();
        for robot in ours {
            for _ in 0..DATAGRAMS_A_TICK {
                let Some((from, bytes)) = self.next(robot) else { break };
                self.note(from, &bytes, directory);
            }
        }
    }
}

fn deliver(
    clock: Res<Clock>,
    addresses: Res<Addresses>,
    mut carrier: ResMut<UdpCarrier>,
    (mut traffic, mut counts, mut log): (ResMut<Traffic>, ResMut<MessageCounts>, ResMut<RadioLog>),
    mut incoming: ResMut<Incoming>,
    robots: Query<(&RobotId, &Robot)>,
) {
    let carrier = &mut *carrier;
    let ours: Vec<RobotId> = carrier.conns.keys().copied().collect();
    for to in ours {
        let hears = robots.iter().any(|(id, robot)| *id == to && robot.condition.hears());
        for _ in 0..DATAGRAMS_A_TICK {
            let Some((from, bytes)) = carrier.next(to) else { break };
            let Some((source, header)) = carrier.note(from, &bytes, &addresses.0) else { continue };
            let known = carrier.arrived((source, header.counter, header.index), to);
            if let Some(from) = as_robot(source) {
                if hears {
                    traffic.deliver(from, to);
                    let kind = known.as_ref().map_or(MessageKind::Other, |sent| sent.kind);
                    counts.count_delivered(kind, from, to);
                } else {
                    traffic.lose(from, to, Loss::Deaf);
                }
            }
            match (known, hears) {
                (Some(sent), true) => log.arrived(sent.id, clock.tick),
                (Some(sent), false) => log.lost(sent.id, Loss::Deaf),
                (None, _) => {}
            }
            if hears {
                incoming.0.push((to, bytes));
            }
        }
    }
    let lost = clock.ticks(LOST);
    while carrier.under_way.front().is_some_and(|sent| sent.sent + lost < clock.tick) {
        if let Some(sent) = carrier.under_way.pop_front() {
            log.lost(sent.id, Loss::Chance);
        }
    }
}

impl UdpCarrier {
    fn next(&mut self, robot: RobotId) -> Option<(SocketAddr, Arc<[u8]>)> {
        let received = self.conns.get_mut(&robot)?.receive();
        received.ok().flatten().map(|(from, bytes)| (from, bytes.into()))
    }
}

pub(super) fn transmit(
    clock: Res<Clock>,
    addresses: Res<Addresses>,
    mut carrier: ResMut<UdpCarrier>,
    mut on_air: ResMut<OnAir>,
    (mut traffic, mut counts, mut log): (ResMut<Traffic>, ResMut<MessageCounts>, ResMut<RadioLog>),
    robots: Query<(&RobotId, &Robot)>,
) {
    log.forget(&clock);
    for datagram in on_air.0.drain(..) {
        let to = as_robot(datagram.to);
        let mute = robots.iter().any(|(id, robot)| *id == datagram.from && robot.condition.mute);
        let packet = to.map(|to| Packet {
            kind: datagram.kind,
            from: datagram.from,
            to,
            bytes: datagram.bytes.len(),
            distance: 0.0,
        });
        if mute {
            if let Some(packet) = packet {
                let fate = Fate::lost(Loss::Mute);
                traffic.send(&packet, &fate);
                log.sent(&packet, datagram.sequence, &fate, clock.tick);
            }
            continue;
        }
        match carrier.send(&datagram, &addresses.0) {
            Ok(true) => {}
            Ok(false) => continue,
            Err(_) => {
                carrier.figures.refused += 1;
                continue;
            }
        }
        let Some(packet) = packet else { continue };
        carrier.figures.sent += 1;
        let fate = Fate::on_time(clock.tick + 1);
        traffic.send(&packet, &fate);
        counts.count_sent(packet.kind, packet.from, packet.to);
        let id = log.sent(&packet, datagram.sequence, &fate, clock.tick);
        if let Ok((header, _)) = Header::read(&datagram.bytes) {
            let header = (header.source.entity, header.counter, header.index);
            let (to, kind) = (packet.to, packet.kind);
            carrier.under_way.push_back(UnderWay { header, to, kind, id, sent: clock.tick });
        }
    }
}
