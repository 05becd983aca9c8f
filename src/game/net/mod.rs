//! Real sockets: everything of a match that crosses a network. What they bring becomes [requests](crate::game::requests), at the
//! beginning of a tick; the match knows no more of them. A socket reads only the address that it is bound to, by default on this
//! machine; one that only speaks reads nothing.

mod announced;
mod announcer;
mod box_log;
mod box_socket;
mod carrier;
pub mod chaos;
mod error;
mod greeting;
mod introduction;
mod league;
mod plan;
mod remote_messages;
mod remote_robots;
mod robot_process;
mod robot_status;
mod timing;

use std::time::Duration;

use bevy::prelude::*;

pub use carrier::{CarrierFigures, UdpCarrier};
pub use error::{NetworkError, start};
pub use greeting::{Awaited, Greeting};
pub use introduction::{Introduction, Particular};
pub use league::LeaguePorts;
pub use plan::{NetworkPlan, team_numbers_fault};
pub use remote_messages::{RobotReply, Sensors};
pub use remote_robots::RemoteFigures;
pub use robot_process::{RobotEnd, RobotProcess, RobotReport};

use crate::comms::tcm::{Addresses, MessageBudgets};
use crate::game::MatchPlan;
use crate::game::requests::{DoorSystems, Request, Requests, RobotChange, door};
use crate::ids::RobotId;
use crate::robot::Robot;
use crate::schedule::Tick;
use crate::world::gamecontroller::BoxNews;
use announcer::Announcer;
use box_socket::BoxSocket;
use chaos::{ChaosFigures, ChaosSockets};
use remote_robots::RemoteRobots;
use timing::unused_number;

pub(super) fn plugin(app: &mut App) {
    app.add_plugins((carrier::plugin, league::plugin, remote_messages::plugin)).add_systems(
        Tick,
        (exchange.run_if(resource_exists::<Sockets>), carrier::receive.in_set(carrier::CarrierSystems))
            .chain()
            .before(carrier::ask_for_due)
            .in_set(DoorSystems::Ask),
    );
}

/// What a robot needs that is a process of its own.
fn robot_plugin(app: &mut App) {
    app.add_plugins((door, carrier::plugin, remote_messages::plugin));
}

/// The league's numbers of home and away where nothing gives any.
const TEAM_NUMBERS: [u8; 2] = [1, 2];

/// How long a match without a window waits for robots in other processes before it begins, and a robot for word of its
/// match, unless they are told.
pub const PATIENCE: Duration = Duration::from_secs(20);

/// The sockets of the running match, but for those of the carrier.
#[derive(Resource, Default)]
struct Sockets {
    referee_box: Option<BoxSocket>,
    announcer: Option<Announcer>,
    remote: Option<RemoteRobots>,
    chaos: Option<ChaosSockets>,
}

impl Sockets {
    fn is_any_open(&self) -> bool {
        let Sockets { referee_box, announcer, remote, chaos } = self;
        referee_box.is_some() || announcer.is_some() || remote.is_some() || chaos.is_some()
    }
}

/// Makes a match ready to be played as its plan says, with sockets or with the recorded requests of a match that had them.
pub(super) fn prepare(world: &mut World, plan: &MatchPlan) {
    let wanted = &plan.network;
    if wanted.gamecontroller.is_some() {
        let players = plan.teams.each_ref().map(|team| team.strategy.players.len() as u8);
        world.insert_resource(BoxNews::new(wanted.team_numbers, players));
    }
    if wanted.announce.is_some() || wanted.league_ports.is_some() {
        let version = wanted.version;
        let budgets = MessageBudgets::counting(version.message_budget(), version.extra_time_budget());
        let limited = wanted.league_ports.is_some();
        world.insert_resource(if limited { budgets.limited_to(plan.robots()) } else { budgets });
    }
    if wanted.udp {
        world.insert_resource(UdpCarrier::default());
    }
    hand_over(world, &wanted.remote);
}

/// Opens the sockets that a match needs; it has been started in this world.
///
/// # Errors
/// If one cannot be opened. Then the match goes on without any, as if none had been wanted.
pub fn open(world: &mut World, plan: &MatchPlan) -> Result<(), NetworkError> {
    world.remove_resource::<Sockets>();
    world.remove_resource::<LeaguePorts>();
    let opened = open_all(world, plan);
    if opened.is_err() {
        close(world);
    }
    opened
}

fn open_all(world: &mut World, plan: &MatchPlan) -> Result<(), NetworkError> {
    let directory = plan.directory();
    let wanted = &plan.network;
    let session = unused_number();
    let mut sockets = Sockets::default();
    let numbers = wanted.team_numbers.unwrap_or(TEAM_NUMBERS);
    if let Some(mut carrier) = world.get_resource_mut::<UdpCarrier>() {
        let local = plan.robots().filter(|robot| !wanted.remote.contains(robot));
        // Their ports may be those of the sockets that were open before.
        *carrier = UdpCarrier::default();
        *carrier = UdpCarrier::open(&directory, local, session)?;
    }
    if let Some(address) = wanted.gamecontroller {
        let given = wanted.team_numbers.is_some();
        sockets.referee_box = Some(BoxSocket::open(address, given, wanted.wait_for_box)?);
    }
    if let Some(address) = wanted.announce {
        sockets.announcer = Some(Announcer::open(address, wanted.version, numbers)?);
    }
    if !wanted.remote.is_empty() {
        sockets.remote = Some(RemoteRobots::open(&directory, &wanted.remote, plan, session)?);
    }
    if let Some(chaos) = &wanted.chaos {
        sockets.chaos = Some(ChaosSockets::open(plan, chaos, session)?);
    }
    if let Some(host) = wanted.league_ports {
        world.insert_resource(LeaguePorts::open(host, numbers)?);
    }
    if sockets.is_any_open() {
        world.insert_resource(sockets);
    }
    Ok(())
}

/// Closes all sockets. The match goes on as if none had been wanted.
pub fn close(world: &mut World) {
    world.remove_resource::<Sockets>();
    world.remove_resource::<UdpCarrier>();
    world.remove_resource::<LeaguePorts>();
    world.remove_resource::<MessageBudgets>();
    world.remove_resource::<BoxNews>();
    hand_over(world, &[]);
}

/// Whether the match in a world hears or speaks over sockets; what has come over them is in its requests.
pub fn is_open(world: &World) -> bool {
    let carrier = world.get_resource::<UdpCarrier>();
    world.contains_resource::<Sockets>()
        || world.contains_resource::<LeaguePorts>()
        || carrier.is_some_and(UdpCarrier::is_open)
}

/// The decisions of these robots are made in other processes.
fn hand_over(world: &mut World, remote: &[RobotId]) {
    let mut robots = world.query::<(&RobotId, &mut Robot)>();
    for (id, mut robot) in robots.iter_mut(world) {
        robot.remote = remote.contains(id);
    }
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
) -> Result<Greeting, NetworkError> {
    with_remote(world, |world, remote| remote.greet(world, patience, goes_on)).unwrap_or(Ok(Greeting::Done))
}

/// From now on this process plays a robot that was to be played by another, as if it had just been switched on. It speaks
/// from its address in the directory, or from any other of this machine if that is taken, of which then only the robots of
/// this process know.
///
/// # Errors
/// If there is no address at all; then it plays and neither speaks nor hears.
pub fn give_up(world: &mut World, robot: RobotId) -> Result<(), NetworkError> {
    if !with_remote(world, |_, remote| remote.give_up(robot)).unwrap_or(false) {
        return Ok(());
    }
    let change = RobotChange::PlayHere { counter: unused_number() };
    world.resource_mut::<Requests>().ask(Request::Robot(robot, change));
    let mut addresses = world.resource::<Addresses>().0.clone();
    let Some(mut carrier) = world.get_resource_mut::<UdpCarrier>() else { return Ok(()) };
    let address = carrier.add(robot, &addresses)?;
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
fn exchange(world: &mut World) {
    with_sockets(world, |world, sockets| {
        if let Some(referee_box) = &mut sockets.referee_box {
            referee_box.exchange(world);
        }
        // Robots in other processes are told in the same tick what is asked of their minds.
        if let Some(chaos) = &mut sockets.chaos {
            chaos.exchange(world);
        }
        if let Some(remote) = &mut sockets.remote {
            remote.exchange(world);
        }
        if let Some(announcer) = &mut sockets.announcer {
            announcer.announce_after_tick(world);
        }
    });
}

/// Announces the match twice a second on the wall, so many seconds after the last call: in the window, whether ticks run or
/// not. Returns why it cannot be announced, once.
pub fn announce_in_real_time(world: &mut World, elapsed: f32) -> Option<String> {
    with_sockets(world, |world, sockets| sockets.announcer.as_mut()?.announce_in_real_time(world, elapsed))
        .flatten()
}

/// Whether the match may go on without a referee box that it waits for.
///
/// # Errors
/// If it has waited long enough.
pub fn check_patience(world: &World) -> Result<(), NetworkError> {
    let socket = world.get_resource::<Sockets>().and_then(|sockets| sockets.referee_box.as_ref());
    socket.map_or(Ok(()), |socket| socket.check_patience(world))
}

/// Tells remote robots that the match is over, says what was ignored of a referee box, and counts the datagrams that have
/// arrived since its last tick.
pub fn finish(world: &mut World) {
    with_sockets(world, |world, sockets| {
        if let Some(referee_box) = &mut sockets.referee_box {
            referee_box.finish(world);
        }
        if let Some(remote) = &mut sockets.remote {
            remote.finish(world);
        }
        if let Some(announcer) = &mut sockets.announcer {
            announcer.announce(world);
        }
    });
    if world.contains_resource::<UdpCarrier>() {
        let directory = world.resource::<Addresses>().0.clone();
        world.resource_mut::<UdpCarrier>().read_sockets(&directory);
    }
}

/// Counts of the packets to and from remote robots.
pub fn remote_figures(world: &World) -> Vec<RemoteFigures> {
    let sockets = world.get_resource::<Sockets>();
    sockets.and_then(|sockets| sockets.remote.as_ref()).map(RemoteRobots::figures).unwrap_or_default()
}

/// Counts of what has passed between the match and ChaosManager, if it may be heard.
pub fn chaos_figures(world: &World) -> Option<ChaosFigures> {
    world.get_resource::<Sockets>()?.chaos.as_ref().map(ChaosSockets::figures)
}

fn with_remote<T>(world: &mut World, speak: impl FnOnce(&mut World, &mut RemoteRobots) -> T) -> Option<T> {
    with_sockets(world, |world, sockets| sockets.remote.as_mut().map(|remote| speak(world, remote))).flatten()
}

fn with_sockets<T>(world: &mut World, exchange: impl FnOnce(&mut World, &mut Sockets) -> T) -> Option<T> {
    let mut sockets = world.remove_resource::<Sockets>()?;
    let result = exchange(world, &mut sockets);
    world.insert_resource(sockets);
    Some(result)
}
