//! Real sockets: everything of a match that crosses a network. Packets are exchanged between two ticks, apart from the TCM's
//! datagrams, which the UDP carrier brings and takes within a tick as the simulated radio does. A socket reads only the
//! address that it is bound to, by default on this machine; one that only speaks reads nothing.

mod announced;
mod announcer;
mod carrier;
mod league;
mod protocol;
mod referee_box;
mod remote;
mod robot;

use std::net::{IpAddr, SocketAddr};

use bevy::prelude::*;

pub use carrier::{CarrierFigures, UdpCarrier};
pub use protocol::{Command, Sensors};
pub use remote::RemoteFigures;
pub use robot::{RobotProcess, RobotReport};

use crate::data::DataError;
use crate::game::MatchPlan;
use crate::gamecontroller::control::Version;
use crate::ids::RobotId;
use crate::tcm::external_message::Entity as Party;
use crate::tcm::udp::UdpError;
use crate::tcm::{Addresses, MessageBudgets};
use announcer::{Announcer, TEAM_NUMBERS};
use league::LeaguePorts;
use referee_box::BoxSocket;
use remote::RemoteRobots;

pub(super) fn plugin(app: &mut App) {
    carrier::plugin(app);
    league::plugin(app);
    protocol::plugin(app);
}

/// Which parts of a match cross a network.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WirePlan {
    /// Team messages go by UDP and not by the simulated radio.
    pub udp: bool,
    /// Robots that are processes of their own.
    pub remote: Vec<RobotId>,
    /// Where a referee box sends its packets to.
    pub gamecontroller: Option<SocketAddr>,
    /// Where the match is announced to, in the GameController's own format.
    pub announce: Option<SocketAddr>,
    /// The host at whose league's ports each team message arrives, too; then teams keep to the league's limits.
    pub league_ports: Option<IpAddr>,
    /// The version of what is announced and of the league's limits.
    pub version: Version,
}

/// What cannot be done with a network.
#[derive(Debug, thiserror::Error)]
pub enum WireError {
    #[error(transparent)]
    Udp(#[from] UdpError),
    #[error("{0} has no address: add it to the addresses")]
    NoAddress(Party),
    #[error("{robot} does not answer at {address}: start it with `touchline robot`")]
    Silent { robot: RobotId, address: SocketAddr },
}

impl From<WireError> for DataError {
    fn from(error: WireError) -> DataError {
        DataError::new("network", error.to_string())
    }
}

/// The sockets of the running match, but for those of the carrier.
#[derive(Resource, Default)]
struct Wires {
    referee_box: Option<BoxSocket>,
    announcer: Option<Announcer>,
    remote: Option<RemoteRobots>,
}

/// Opens the sockets that a match needs; it has been started in this world.
///
/// # Errors
/// If one cannot be opened. Then the match goes on without any.
pub fn open(world: &mut World, plan: &MatchPlan) -> Result<(), WireError> {
    close(world);
    let directory = plan.directory();
    let wanted = &plan.wires;
    let mut wires = Wires::default();
    let local = || plan.robots().filter(|robot| !wanted.remote.contains(robot));
    let carrier = wanted.udp.then(|| UdpCarrier::open(&directory, local())).transpose()?;
    if let Some(address) = wanted.gamecontroller {
        let players = plan.teams.iter().map(|team| team.strategy.players.len()).max().unwrap_or(0);
        wires.referee_box = Some(BoxSocket::open(address, players as u8)?);
        world.insert_resource(crate::gamecontroller::BoxNews::default());
    }
    if let Some(address) = wanted.announce {
        wires.announcer = Some(Announcer::open(address, wanted.version)?);
    }
    if !wanted.remote.is_empty() {
        wires.remote = Some(RemoteRobots::open(&directory, &wanted.remote, plan)?);
        remote::hand_over(world, &wanted.remote);
    }
    let ports = wanted.league_ports.map(|host| LeaguePorts::open(host, TEAM_NUMBERS)).transpose()?;
    if wanted.announce.is_some() || ports.is_some() {
        let version = wanted.version;
        let budgets = MessageBudgets::counting(version.message_budget(), version.extra_time_budget());
        world.insert_resource(if ports.is_some() { budgets.limited_to(plan.robots()) } else { budgets });
    }
    if let Some(ports) = ports {
        world.insert_resource(ports);
    }
    if let Some(carrier) = carrier {
        world.insert_resource(carrier);
    }
    world.insert_resource(wires);
    Ok(())
}

/// Closes all sockets.
pub fn close(world: &mut World) {
    world.remove_resource::<Wires>();
    world.remove_resource::<UdpCarrier>();
    world.remove_resource::<LeaguePorts>();
    world.remove_resource::<MessageBudgets>();
    world.remove_resource::<crate::gamecontroller::BoxNews>();
}

/// Waits until all remote robots have answered.
///
/// # Errors
/// If one of them stays silent.
pub fn greet(world: &mut World) -> Result<(), WireError> {
    with_wires(world, |world, wires| match &mut wires.remote {
        Some(remote) => remote.greet(world),
        None => Ok(()),
    })
    .unwrap_or(Ok(()))
}

/// Hears and says what is to be heard and said between two ticks.
pub fn exchange(world: &mut World) {
    with_wires(world, |world, wires| {
        if let Some(referee_box) = &mut wires.referee_box {
            referee_box.exchange(world);
        }
        if let Some(remote) = &mut wires.remote {
            remote.exchange(world);
        }
        if let Some(announcer) = &mut wires.announcer {
            announcer.announce_after_tick(world);
        }
    });
}

/// Announces the match twice a second on the wall, so many seconds after the last call: in the window, whether ticks run or
/// not. Returns why it cannot be announced, once.
pub fn announce_in_real_time(world: &mut World, elapsed: f32) -> Option<String> {
    with_wires(world, |world, wires| wires.announcer.as_mut()?.announce_in_real_time(world, elapsed))
        .flatten()
}

/// Tells remote robots that the match is over, and counts the datagrams that have arrived since its last tick.
pub fn finish(world: &mut World) {
    with_wires(world, |world, wires| {
        if let Some(remote) = &mut wires.remote {
            remote.finish(world);
        }
        if let Some(announcer) = &mut wires.announcer {
            announcer.announce(world);
        }
    });
    if world.contains_resource::<UdpCarrier>() {
        let directory = world.resource::<Addresses>().0.clone();
        world.resource_mut::<UdpCarrier>().drain(&directory);
    }
}

/// What became of the packets to and from remote robots.
pub fn remote_figures(world: &World) -> Vec<RemoteFigures> {
    let wires = world.get_resource::<Wires>();
    wires.and_then(|wires| wires.remote.as_ref()).map(RemoteRobots::figures).unwrap_or_default()
}

/// Whether a match follows a clock that is not its own.
pub fn is_in_real_time(plan: &MatchPlan) -> bool {
    plan.wires.gamecontroller.is_some()
}

fn with_wires<T>(world: &mut World, exchange: impl FnOnce(&mut World, &mut Wires) -> T) -> Option<T> {
    let mut wires = world.remove_resource::<Wires>()?;
    let result = exchange(world, &mut wires);
    world.insert_resource(wires);
    Some(result)
}
