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
use crate::game::requests::{DoorSystems, NetworkDatagram, Request, Requests};
use crate::ids::RobotId;
use crate::robot::Robot;
use crate::schedule::{Tick, TickSystems};

use super::error::NetworkError;
use super::timing::{DATAGRAMS_A_TICK, Stamp};

pub(super) fn plugin(app: &mut App) {
    let is_used = resource_exists::<UdpCarrier>;
    let receives = deliver.in_set(TickSystems::Deliver).before(TcmSystems::Receive);
    let sends = transmit.in_set(TickSystems::Transmit).after(TcmSystems::Send);
    let asks = ask_for_due.in_set(DoorSystems::Ask);
    app.configure_sets(Tick, (RadioSystems.run_if(not(is_used)), CarrierSystems.run_if(is_used)))
        .add_systems(Tick, asks.in_set(CarrierSystems))
        .add_systems(Tick, receives.after(deliver_datagrams).in_set(CarrierSystems))
        .add_systems(Tick, sends.after(transmit_datagrams).in_set(CarrierSystems));
}

/// What UDP does in a tick, where it carries the datagrams.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct CarrierSystems;

/// The sockets of the robots that this process runs. A match that is played from its recorded requests has none.
#[derive(Resource, Default)]
pub struct UdpCarrier {
    conns: BTreeMap<RobotId, UdpConn>,
    /// Of the match; datagrams of the robots of any other are foreign.
    pub(super) session: u32,
    /// Datagrams that have come and wait for the tick in which they are heard, by their sender.
    early: BTreeMap<Peer, EarlyDatagrams>,
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
    /// From who had sent more than is kept of it.
    pub too_many: u64,
}

/// What one sender has sent for later ticks.
#[derive(Default)]
struct EarlyDatagrams {
    datagrams: Vec<NetworkDatagram>,
    bytes: usize,
}

impl EarlyDatagrams {
    /// Keeps one more; false if that is too much. So who floods robots, or says that it speaks from the future, takes no room from
    /// others.
    fn keep(&mut self, datagram: NetworkDatagram) -> bool {
        let bytes = self.bytes + datagram.bytes.len();
        let fits = bytes <= MOST_BYTES && self.datagrams.len() < MOST_DATAGRAMS;
        if fits {
            self.bytes = bytes;
            self.datagrams.push(datagram);
        }
        fits
    }

    /// Takes out those that were sent before a tick.
    fn due(&mut self, tick: u64) -> Vec<NetworkDatagram> {
        let is_due = |datagram: &mut NetworkDatagram| datagram.sent.is_none_or(|sent| sent < tick);
        let due: Vec<NetworkDatagram> = self.datagrams.extract_if(.., is_due).collect();
        self.bytes -= due.iter().map(|datagram| datagram.bytes.len()).sum::<usize>();
        due
    }
}

struct UnderWay {
    id: u64,
    packet: Packet,
    /// The tick in which it was sent.
    sent: u64,
}

/// The datagrams of one sender that are kept for later ticks.
const MOST_DATAGRAMS: usize = 512;
/// And their bytes.
const MOST_BYTES: usize = 1 << 20;
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
        session: u32,
    ) -> Result<UdpCarrier, NetworkError> {
        let mut conns = BTreeMap::new();
        for robot in robots {
            let address = address_of(robot, directory)?;
            conns.insert(robot, UdpConn::bind(address)?);
        }
        Ok(UdpCarrier { session, ..UdpCarrier::of(conns) })
    }

    /// Opens a socket for one more robot, at another address if its own is taken, and tells where.
    pub(super) fn add(&mut self, robot: RobotId, directory: &Directory) -> Result<SocketAddr, NetworkError> {
        let own = address_of(robot, directory)?;
        // Any other is one that the other robots of this process can reach.
        let near = self.conns.values().next().map_or(own.ip(), |conn| conn.address().ip());
        let conn = UdpConn::bind(own).or_else(|_| UdpConn::bind(SocketAddr::new(near, 0)))?;
        let address = conn.address();
        self.conns.insert(robot, conn);
        Ok(address)
    }

    pub(super) fn of(conns: BTreeMap<RobotId, UdpConn>) -> UdpCarrier {
        UdpCarrier { conns, ..UdpCarrier::default() }
    }

    /// Whether it has any socket.
    pub(super) fn is_open(&self) -> bool {
        !self.conns.is_empty()
    }

    /// The same sockets, for another match.
    pub(super) fn renewed(self) -> UdpCarrier {
        UdpCarrier::of(self.conns)
    }

    /// The socket of a robot.
    pub(super) fn conn(&mut self, robot: RobotId) -> Option<&mut UdpConn> {
        self.conns.get_mut(&robot)
    }

    /// Takes a datagram that came from an address for one of our robots and keeps it until it is heard, unless the match itself
    /// sent it; tells who did, if it is ours.
    pub(super) fn accept(
        &mut self,
        to: RobotId,
        from: SocketAddr,
        bytes: &[u8],
        directory: &Directory,
    ) -> Option<Peer> {
        let (stamp, bytes) = Stamp::split(bytes);
        let known = Header::read(bytes).ok().map(|(header, _)| header.source.peer);
        // Tools may speak from anywhere; robots and the match itself from where the directory has them.
        let sender = known.filter(|source| match source {
            Peer::Computer(_) if *source != HOST => true,
            Peer::Robot { .. } if stamp.is_none_or(|stamp| stamp.session != self.session) => false,
            _ => directory.peer_at(from) == Some(*source),
        });
        let mut sent = None;
        match sender {
            Some(Peer::Robot { .. }) => {
                sent = stamp.map(|stamp| stamp.tick);
                self.figures.received += 1;
            }
            Some(_) => self.figures.from_computers += 1,
            None => self.figures.foreign += 1,
        }
        if let Some(sender) = sender.filter(|sender| *sender != HOST) {
            let datagram = NetworkDatagram { to, sent, bytes: bytes.into() };
            let is_kept = self.early.entry(sender).or_default().keep(datagram);
            self.figures.too_many += u64::from(!is_kept);
        }
        sender
    }

    fn send(&mut self, datagram: &Datagram, address: SocketAddr, tick: u64) -> Result<(), UdpError> {
        let Some(conn) = self.conns.get_mut(&datagram.from) else { return Ok(()) };
        match datagram.to {
            Peer::Robot { .. } => {
                let stamp = Stamp { session: self.session, tick };
                conn.send(address, &stamp.before(&datagram.bytes))
            }
            _ => conn.send(address, &datagram.bytes),
        }
    }

    /// The transmission that a packet ends, if it was sent in this process.
    fn arrived(&mut self, packet: &Packet) -> Option<u64> {
        let place = self.under_way.iter().position(|sent| sent.packet == *packet)?;
        self.under_way.remove(place).map(|sent| sent.id)
    }

    /// Reads what has arrived for our robots.
    pub(super) fn read_sockets(&mut self, directory: &Directory) {
        let ours: Vec<RobotId> = self.conns.keys().copied().collect();
        for robot in ours {
            for _ in 0..DATAGRAMS_A_TICK {
                let Some((from, bytes)) = self.next(robot) else { break };
                self.accept(robot, from, &bytes, directory);
            }
        }
    }
}

pub(super) fn receive(addresses: Res<Addresses>, mut carrier: ResMut<UdpCarrier>) {
    carrier.read_sockets(&addresses.0);
}

/// Asks that datagrams be heard that have come and were sent before this tick.
pub(super) fn ask_for_due(
    clock: Res<Clock>,
    mut carrier: ResMut<UdpCarrier>,
    mut requests: ResMut<Requests>,
) {
    for early in carrier.early.values_mut() {
        early.due(clock.tick).into_iter().for_each(|datagram| requests.ask(Request::Datagram(datagram)));
    }
    carrier.early.retain(|_, early| !early.datagrams.is_empty());
}

fn address_of(robot: RobotId, directory: &Directory) -> Result<SocketAddr, NetworkError> {
    let peer = Peer::from(robot);
    directory.address_of(peer).ok_or(NetworkError::NoAddress(peer))
}

fn deliver(
    clock: Res<Clock>,
    requests: Res<Requests>,
    mut carrier: ResMut<UdpCarrier>,
    mut record: ResMut<RadioRecord>,
    mut incoming: ResMut<Incoming>,
    robots: Query<(&RobotId, &Robot)>,
) {
    for request in requests.due() {
        let Request::Datagram(NetworkDatagram { to, sent, bytes }) = request else { continue };
        let Ok((header, _)) = Header::read(bytes) else { continue };
        let hears = robots.iter().any(|(id, robot)| id == to && robot.health.hears());
        if let Some(from) = header.source.peer.robot() {
            let packet = Packet { kind: header.data_type, from, to: *to, bytes: bytes.clone() };
            let id = carrier.arrived(&packet).unwrap_or_else(|| {
                // A robot in another process sent it.
                let sent = sent.unwrap_or(clock.tick.saturating_sub(1));
                record.sent(&packet, &Delivery::on_time(clock.tick), sent)
            });
            if hears {
                record.delivered(id, &packet, clock.tick);
            } else {
                record.lost(id, &packet, Loss::Deaf);
            }
        }
        if hears {
            incoming.0.push((*to, bytes.clone()));
        }
    }
    let is_here = |robot: RobotId| robots.iter().any(|(id, found)| *id == robot && !found.remote);
    carrier.settle(&mut record, &clock, is_here);
}

impl UdpCarrier {
    /// What was sent to a robot in another process is taken to have arrived, since nothing tells this one; what a robot of
    /// this process has waited for too long is lost.
    fn settle(&mut self, record: &mut RadioRecord, clock: &Clock, is_here: impl Fn(RobotId) -> bool) {
        let lost = clock.ticks(LOST);
        self.under_way.retain(|UnderWay { id, packet, sent }| {
            if !is_here(packet.to) {
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
        if robots.iter().any(|(id, robot)| *id == datagram.from && robot.health.mute) {
            if let Some(packet) = packet {
                record.drop_muted(&packet, clock.tick);
            }
            continue;
        }
        // What becomes of it on the network is not known, and what is not known must not matter.
        let Some(address) = addresses.0.address_of(datagram.to) else { continue };
        let is_refused = carrier.send(&datagram, address, clock.tick).is_err();
        carrier.figures.refused += u64::from(is_refused);
        let Some(packet) = packet else { continue };
        carrier.figures.sent += u64::from(!is_refused);
        let id = record.sent(&packet, &Delivery::on_time(clock.tick + 1), clock.tick);
        carrier.under_way.push_back(UnderWay { id, packet, sent: clock.tick });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    fn from_tick(sent: u64, bytes: usize) -> NetworkDatagram {
        let to = RobotId::new(Team::Home, 0);
        NetworkDatagram { to, sent: Some(sent), bytes: vec![0; bytes].into() }
    }

    #[test]
    fn what_says_that_it_comes_from_the_future_is_kept_up_to_a_bound_and_the_rest_is_heard() {
        let mut early = EarlyDatagrams::default();
        let kept = (0..10_000).filter(|_| early.keep(from_tick(u64::MAX, 1000))).count();
        assert_eq!(kept, MOST_DATAGRAMS);
        assert!(early.due(5).is_empty() && !early.keep(from_tick(4, 1000)));
        let mut long = EarlyDatagrams::default();
        let kept = (0..100).filter(|_| long.keep(from_tick(7, 60_000))).count();
        assert_eq!(kept, MOST_BYTES / 60_000);
        assert_eq!((long.due(7).len(), long.due(8).len(), long.bytes), (0, kept, 0));
        assert!(long.keep(from_tick(9, 60_000)));
    }
}
