//! Real sockets: everything of a match that crosses a network. Packets are exchanged between two ticks, apart from the TCM's
//! datagrams, which the UDP carrier brings and takes within a tick as the simulated radio does. A socket reads only the
//! address that it is bound to, by default on this machine; one that only speaks reads nothing.

mod announced;
mod announcer;
mod box_log;
mod carrier;
mod commands;
mod greeting;
mod introduction;
mod league;
mod protocol;
mod referee_box;
mod remote;
mod robot;
mod robot_status;

use std::net::{IpAddr, SocketAddr};
use std::time::Duration;

use bevy::prelude::*;

pub use carrier::{CarrierFigures, UdpCarrier};
pub use greeting::{Awaited, Greeting};
pub use introduction::{Introduction, Particular};
pub use protocol::{Command, Sensors};
pub use remote::RemoteFigures;
pub use robot::{RobotEnd, RobotProcess, RobotReport};

use crate::clock::Clock;
use crate::comms::tcm::udp::UdpError;
use crate::comms::tcm::{Addresses, MessageBudgets, Peer};
use crate::data::DataError;
use crate::game::MatchPlan;
use crate::ids::RobotId;
use crate::world::gamecontroller::control::{NO_TEAM, Version};
use announcer::Announcer;
use league::LeaguePorts;
use referee_box::BoxSocket;
use remote::RemoteRobots;

pub(crate) fn plugin(app: &mut App) {
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
    /// The league's numbers of home and away, if they are known.
    pub team_numbers: Option<[u8; 2]>,
    /// How long a match waits for its referee box before it is given up.
    pub wait_for_box: Option<Duration>,
}

/// The league's numbers of home and away where nothing gives any.
const TEAM_NUMBERS: [u8; 2] = [1, 2];

impl WirePlan {
    /// What is wrong with the plan, as the option and a reason.
    pub fn fault(&self) -> Option<(&'static str, String)> {
        if let Some(message) = self.team_numbers.and_then(team_numbers_fault) {
            return Some(("--team-numbers", message));
        }
        let (listen, tell) = self.gamecontroller.zip(self.announce)?;
        let is_here = tell.ip().is_loopback() || tell.ip().is_unspecified();
        let itself = listen.ip() == tell.ip() || (listen.ip().is_unspecified() && is_here);
        (listen.port() == tell.port() && itself).then(|| {
            let message = format!("{tell} is where --gamecontroller listens: the match would follow itself");
            ("--announce", message)
        })
    }
}

/// What is wrong with the numbers of home and away.
pub fn team_numbers_fault([home, away]: [u8; 2]) -> Option<String> {
    if home == away {
        return Some(format!("both teams have the number {home}"));
    }
    [home, away].contains(&NO_TEAM).then(|| format!("{NO_TEAM} is no team: it stands for neither"))
}

/// How long a match without a window waits for robots in other processes before it begins, and a robot for word of its
/// match, unless they are told.
pub const PATIENCE: Duration = Duration::from_secs(20);

/// What cannot be done with a network.
#[derive(Debug, thiserror::Error)]
pub enum WireError {
    /// A socket failed.
    #[error(transparent)]
    Udp(#[from] UdpError),
    /// An entity of the match has no address.
    #[error("{0} has no address: add it to the addresses")]
    NoAddress(Peer),
    /// No referee box was heard in time.
    #[error("no referee box was heard at {address} within {} s", patience.as_secs_f32())]
    NoBox { address: SocketAddr, patience: Duration },
    /// A robot did not answer in time.
    #[error("{robot} has not answered at {address} for {} s: start it with `{}`", patience.as_secs_f32(), start(*robot))]
    Silent { robot: RobotId, address: SocketAddr, patience: Duration },
    #[error("no match has greeted {robot} at {address} for {} s: start it with `touchline run --remote {}:{}`",
        patience.as_secs_f32(), robot.team, robot.number)]
    /// A robot heard of no match in time.
    NoMatch { robot: RobotId, address: SocketAddr, patience: Duration },
    /// A robot plays another match.
    #[error("{robot} does not belong to the match at {address}: {difference}")]
    OtherMatch { robot: RobotId, address: SocketAddr, difference: String },
}

/// What starts a robot in a process of its own, but for the options of its match.
pub fn start(robot: RobotId) -> String {
    format!("touchline robot --team {} --number {}", robot.team, robot.number)
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
    let numbers = wanted.team_numbers.unwrap_or(TEAM_NUMBERS);
    let local = || plan.robots().filter(|robot| !wanted.remote.contains(robot));
    let carrier = wanted.udp.then(|| UdpCarrier::open(&directory, local())).transpose()?;
    if let Some(address) = wanted.gamecontroller {
        let players = plan.teams.each_ref().map(|team| team.strategy.players.len() as u8);
        wires.referee_box = Some(BoxSocket::open(address, players, wanted)?);
        world.insert_resource(crate::world::gamecontroller::BoxNews::default());
    }
    if let Some(address) = wanted.announce {
        wires.announcer = Some(Announcer::open(address, wanted.version, numbers)?);
    }
    if !wanted.remote.is_empty() {
        wires.remote = Some(RemoteRobots::open(&directory, &wanted.remote, plan)?);
        remote::hand_over(world, &wanted.remote);
    }
    let ports = wanted.league_ports.map(|host| LeaguePorts::open(host, numbers)).transpose()?;
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
    world.remove_resource::<crate::world::gamecontroller::BoxNews>();
}

/// Greets the robots in other processes that do not take part, hears what they say, and tells how far that got. It does not
/// wait: call it in every frame, also while the match stands still, so that robots know that it is still there.
pub fn poll_greeting(world: &mut World) -> Greeting {
    with_remote(world, |world, remote| remote.poll(world, Duration::ZERO)).unwrap_or(Greeting::Done)
}

/// Waits until all robots in other processes take part, for so long at most. Several times a second `goes_on` is told who is
/// missing; the wait ends when it says no.
///
/// # Errors
/// If one of them stays silent.
pub fn greet(
    world: &mut World,
    patience: Duration,
    goes_on: &mut dyn FnMut(&[Awaited]) -> bool,
) -> Result<Greeting, WireError> {
    with_remote(world, |world, remote| remote.greet(world, patience, goes_on)).unwrap_or(Ok(Greeting::Done))
}

/// From now on this process plays a robot that was to be played by another, as if it had just been switched on. It speaks
/// from its address in the directory, or from any other of this machine if that is taken, of which then only the robots of
/// this process know.
///
/// # Errors
/// If there is no address at all; then it plays and neither speaks nor hears.
pub fn give_up(world: &mut World, robot: RobotId) -> Result<(), WireError> {
    let was_remote = with_remote(world, |world, remote| remote.give_up(world, robot)).unwrap_or(false);
    if !was_remote {
        return Ok(());
    }
    remote::wake(world, robot);
    let mut addresses = world.resource::<Addresses>().0.clone();
    let Some(mut carrier) = world.get_resource_mut::<UdpCarrier>() else { return Ok(()) };
    let address = carrier.take_in(robot, &addresses)?;
    addresses.put(robot.into(), address);
    world.insert_resource(Addresses(addresses));
    Ok(())
}

/// The ticks from now on may wait so long for robots in other processes, all together. What was granted before is void. Until
/// something is granted each tick waits for 200 ms at most.
pub fn grant(world: &mut World, patience: Duration) {
    with_remote(world, |_, remote| remote.granted = Some(patience));
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

/// Whether the match may go on without a referee box that it waits for.
///
/// # Errors
/// If it has waited long enough.
pub fn check_patience(world: &World) -> Result<(), WireError> {
    let wires = world.get_resource::<Wires>();
    let clock = world.resource::<Clock>();
    wires.and_then(|wires| wires.referee_box.as_ref()).map_or(Ok(()), |socket| socket.check_patience(clock))
}

/// Tells remote robots that the match is over, says what was ignored of a referee box, and counts the datagrams that have
/// arrived since its last tick.
pub fn finish(world: &mut World) {
    with_wires(world, |world, wires| {
        if let Some(referee_box) = &wires.referee_box {
            referee_box.finish();
        }
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

/// Counts of the packets to and from remote robots.
pub fn remote_figures(world: &World) -> Vec<RemoteFigures> {
    let wires = world.get_resource::<Wires>();
    wires.and_then(|wires| wires.remote.as_ref()).map(RemoteRobots::figures).unwrap_or_default()
}

/// Whether a match follows a clock that is not its own.
pub fn is_in_real_time(plan: &MatchPlan) -> bool {
    plan.wires.gamecontroller.is_some()
}

fn with_remote<T>(world: &mut World, speak: impl FnOnce(&mut World, &mut RemoteRobots) -> T) -> Option<T> {
    with_wires(world, |world, wires| wires.remote.as_mut().map(|remote| speak(world, remote))).flatten()
}

fn with_wires<T>(world: &mut World, exchange: impl FnOnce(&mut World, &mut Wires) -> T) -> Option<T> {
    let mut wires = world.remove_resource::<Wires>()?;
    let result = exchange(world, &mut wires);
    world.insert_resource(wires);
    Some(result)
}
