//! Robots that are processes of their own: who has not answered, and who is given up.

use bevy::prelude::*;

use crate::app::view::state::{FileError, FrameSystems};
use crate::clock::Clock;
use crate::game::net::{self, Awaited, Greeting};
use crate::ids::RobotId;

/// The waiting itself, which needs no interface.
pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Missing>().add_systems(Update, ask.in_set(FrameSystems::Input));
}

/// The robots in other processes that do not take part.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct Missing {
    /// The robots that have not answered.
    pub robots: Vec<Awaited>,
    /// Those that the person does not wait for any longer.
    pub given_up: Vec<RobotId>,
}

/// Whether the match has not begun, since robots are missing.
pub fn is_waiting(world: &World) -> bool {
    world.resource::<Clock>().tick == 0
        && world.get_resource::<Missing>().is_some_and(|missing| !missing.robots.is_empty())
}

/// Asks who is missing, without waiting for anybody. A frame in which nothing changes costs next to nothing.
pub fn ask(world: &mut World) {
    let given_up = world.resource_mut::<Missing>().bypass_change_detection().given_up.split_off(0);
    for robot in given_up {
        if let Err(error) = net::give_up(world, robot) {
            world.resource_mut::<FileError>().0 = Some(error.to_string());
        }
    }
    let robots = match net::poll_greeting(world) {
        Greeting::Done => Vec::new(),
        Greeting::Awaiting(robots) => robots,
    };
    world.resource_mut::<Missing>().set_if_neq(Missing { robots, given_up: Vec::new() });
}

#[cfg(test)]
pub(in crate::app) mod tests {
    use std::net::{Ipv4Addr, UdpSocket};
    use std::path::Path;
    use std::time::Duration;

    use super::*;
    use crate::app::view::played_without_a_window;
    use crate::game::Choice;
    use crate::game::net::NetworkPlan;
    use crate::ids::Team;
    use crate::robot::Robot;

    pub const REMOTE: RobotId = RobotId::new(Team::Home, 1);

    /// Writes where robots and this match are: at free ports, but for the remote robot, whose socket never answers.
    pub fn write_addresses(file: &Path) -> UdpSocket {
        let free = || UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).expect("a free port");
        let silent = free();
        let mut lines = Vec::new();
        let mut held = Vec::new();
        let mut entry = |name: String, socket: &UdpSocket| {
            lines.push(format!("\"{name}\": \"{}\"", socket.local_addr().expect("an address")));
        };
        for team in Team::BOTH {
            for number in 0..4 {
                let socket = free();
                let is_remote = RobotId::new(team, number) == REMOTE;
                entry(format!("{team} {number}"), if is_remote { &silent } else { &socket });
                held.push(socket);
            }
        }
        let computer = free();
        entry(crate::comms::tcm::HOST.to_string(), &computer);
        std::fs::write(file, format!("{{{}}}", lines.join(", "))).expect("a file");
        silent
    }

    #[test]
    fn the_window_lives_while_a_robot_is_silent_and_plays_it_when_it_is_given_up() {
        let folder = tempfile::tempdir().expect("a folder");
        let addresses = folder.path().join("addresses.ron");
        let _silent = write_addresses(&addresses);
        let network = NetworkPlan { udp: true, remote: vec![REMOTE], ..NetworkPlan::default() };
        let choice =
            Choice { network: Box::new(network), addresses: Some(addresses), seed: 3, ..Choice::default() };
        let mut app = played_without_a_window(&choice, Duration::from_millis(50));
        for _ in 0..10 {
            app.update();
        }
        assert_eq!(app.world().resource::<FileError>().0, None);
        let awaited = &app.world().resource::<Missing>().robots;
        assert_eq!(awaited.iter().map(|awaited| awaited.robot).collect::<Vec<_>>(), [REMOTE]);
        assert_eq!(app.world().resource::<Clock>().tick, 0, "the match waits");
        app.world_mut().resource_mut::<Missing>().given_up.push(REMOTE);
        for _ in 0..10 {
            app.update();
        }
        assert_eq!(*app.world().resource::<Missing>(), Missing::default());
        assert!(app.world().resource::<Clock>().tick > 0, "the match goes on");
        let mut robots = app.world_mut().query::<(&RobotId, &Robot)>();
        assert!(robots.iter(app.world()).all(|(_, robot)| !robot.remote));
    }
}
