//! UDP as the carrier of team messages (TeamChaos, section 3): every robot has a socket of its own at the address that the
//! directory gives it.

use std::collections::{BTreeMap, VecDeque};
use std::net::SocketAddr;
use std::sync::Arc;

use bevy::prelude::*;

use crate::clock::Clock;
use crate::comms::radio::{
    Delivery, Loss, Packet, RadioRecord, RadioSystems, deliver_datagrams, transmit_datagrams,
};
use crate::comms::tcm::fragments::Header;
use crate::comms::tcm::udp::{UdpConn, UdpError};
use crate::comms::tcm::{Addresses, Datagram, Directory, HOST, Incoming, OnAir, Peer, TcmSystems};
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
    /// What it has carried so far.
    pub figures: CarrierFigures,
}

/// The datagrams of this process's robots.
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
    id: u64,
    packet: Packet,
    /// The tick in which it was sent.
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
            let address = address_of(robot, directory)?;
            conns.insert(robot, UdpConn::bind(address)?);
        }
        Ok(UdpCarrier::of(conns))
    }

    /// Opens a socket for one more robot, at another address if its own is taken, and tells where.
    pub(super) fn take_in(&mut self, robot: RobotId, directory: &Directory) -> Result<SocketAddr, WireError> {
        let own = address_of(robot, directory)?;
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
    ) -> Option<(Peer, Header)> {
        let known = Header::read(bytes).ok().map(|(header, _)| (header.source.peer, header));
        // Tools may speak from anywhere; robots and the match itself from where the directory has them.
        let sender = known.filter(|(source, _)| match source {
            Peer::Computer(_) if *source != HOST => true,
            _ => directory.peer_at(from) == Some(*source),
        });
        match sender {
            Some((Peer::Robot { .. }, _)) => self.figures.received += 1,
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

    /// The transmission that a packet ends, if it was sent in this process.
    fn arrived(&mut self, packet: &Packet) -> Option<u64> {
        let place = self.under_way.iter().position(|sent| sent.packet == *packet)?;
        self.under_way.remove(place).map(|sent| sent.id)
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

fn address_of(robot: RobotId, directory: &Directory) -> Result<SocketAddr, WireError> {
    let peer = Peer::from(robot);
    directory.address_of(peer).ok_or(WireError::NoAddress(peer))
}

fn deliver(
    clock: Res<Clock>,
    addresses: Res<Addresses>,
    mut carrier: ResMut<UdpCarrier>,
    mut record: ResMut<RadioRecord>,
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
            if let Some(from) = source.robot() {
                let packet = Packet { kind: header.data_type, from, to, bytes: bytes.clone() };
                let id = carrier.arrived(&packet).unwrap_or_else(|| {
                    // A robot in another process sent it, in the tick before.
                    record.sent(&packet, &Delivery::on_time(clock.tick), clock.tick.saturating_sub(1))
                });
                if hears {
                    record.delivered(id, &packet, clock.tick);
                } else {
                    record.lost(id, &packet, Loss::Deaf);
                }
            }
            if hears {
                incoming.0.push((to, bytes));
            }
        }
    }
    carrier.settle(&mut record, &clock);
}

impl UdpCarrier {
    /// What was sent to a robot in another process is taken to have arrived, since nothing tells this one; what a robot of
    /// this process has waited for too long is lost.
    fn settle(&mut self, record: &mut RadioRecord, clock: &Clock) {
        let lost = clock.ticks(LOST);
        let conns = &self.conns;
        self.under_way.retain(|UnderWay { id, packet, sent }| {
            if !conns.contains_key(&packet.to) {
                record.delivered(*id, packet, clock.tick);
                return false;
            }
            let is_lost = sent + lost < clock.tick;
            if is_lost {
                record.lost(*id, packet, Loss::Chance);
            }
            !is_lost
        });
    }

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
    mut record: ResMut<RadioRecord>,
    robots: Query<(&RobotId, &Robot)>,
) {
    record.forget(&clock);
    for datagram in on_air.0.drain(..) {
        let packet = Packet::of(&datagram);
        if robots.iter().any(|(id, robot)| *id == datagram.from && robot.condition.mute) {
            if let Some(packet) = packet {
                record.drop_muted(&packet, clock.tick);
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
        let id = record.sent(&packet, &Delivery::on_time(clock.tick + 1), clock.tick);
        carrier.under_way.push_back(UnderWay { id, packet, sent: clock.tick });
    }
}
