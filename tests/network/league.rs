//! Team messages that arrive at the league's ports, too.
#![cfg(target_os = "linux")]

use std::net::{IpAddr, Ipv4Addr, UdpSocket};

use touchline::comms::tcm::counters::Dropped;
use touchline::comms::tcm::{MessageBudgets, Tcm};
use touchline::game::net::NetworkPlan;
use touchline::game::{Choice, Match, MatchPlan};
use touchline::ids::{RobotId, Team};
use touchline::world::gamecontroller::control::Version;

use super::announced::next;
use super::{figures, open};
use crate::support::assets;

/// A referee box that listens to both teams, at an address of its own: Linux has all that begin with 127.
fn ears(last: u8) -> (IpAddr, [UdpSocket; 2]) {
    let [.., high, low] = std::process::id().to_be_bytes();
    let host = Ipv4Addr::new(127, 2 + high % 250, low, last);
    let listen = |team: u16| {
        let socket = UdpSocket::bind((host, 10_000 + team)).expect("nobody else has this address");
        socket.set_nonblocking(true).expect("sockets can do that");
        socket
    };
    (host.into(), [1, 2].map(listen))
}

/// A match between talkative teams that keeps to the limits of a version, played for a minute, and what the box has heard.
fn played(version: Version, udp: bool, last: u8) -> (Match, [Vec<usize>; 2]) {
    let (host, sockets) = ears(last);
    let network = NetworkPlan { league_ports: Some(host), version, ..NetworkPlan::default() };
    let teams = Some("hammerheads_swap".to_owned());
    let choice =
        Choice { home: teams.clone(), away: teams, seed: 7, network: Box::new(network), ..Choice::default() };
    let plan = MatchPlan::read(&assets(), &choice).expect("the shipped match is sound");
    let network = NetworkPlan { udp, ..plan.network.clone() };
    let (mut game, _) = open(&MatchPlan { network, ..plan });
    let mut heard = [vec![], vec![]];
    for _ in 0..3_600 {
        game.tick();
        for (heard, socket) in heard.iter_mut().zip(&sockets) {
            heard.extend(std::iter::from_fn(|| next(socket)).map(|bytes| bytes.len()));
        }
    }
    (game, heard)
}

/// Messages that a team's robots have sent, and those that they were not let.
fn said(game: &mut Match, team: Team) -> (u64, u64) {
    let mut robots = game.world_mut().query::<(&RobotId, &Tcm)>();
    let robots = robots.iter(game.world()).filter(|(id, _)| id.team == team);
    let counts = robots.map(|(_, tcm)| tcm.counters.total());
    counts.fold((0, 0), |(sent, held_back), count| {
        (sent + count.messages_sent, held_back + count.dropped_as(Dropped::OverBudget))
    })
}

#[test]
fn a_box_hears_each_message_once_and_the_budget_is_spread_over_the_match() {
    for (last, version, longest, per_minute) in [(1, Version::V18, 128, 60), (2, Version::V20, 512, 600)] {
        let (mut game, heard) = played(version, false, last);
        for team in Team::BOTH {
            let budgets = game.world().resource::<MessageBudgets>();
            let (spent, left) = (budgets.spent(team), budgets.left(team));
            let heard = &heard[team.index()];
            assert_eq!((heard.len() as u64, left), (spent.counted, version.message_budget() - spent.counted));
            assert_eq!(said(&mut game, team), (spent.counted, spent.over_budget));
            assert!(heard.iter().all(|bytes| *bytes <= longest), "{heard:?}");
            // Four robots begin with four saved messages each.
            assert!((per_minute / 2..=per_minute + 16).contains(&spent.counted), "{version:?}: {spent:?}");
            assert!(spent.over_budget > 100, "{version:?}: {spent:?}");
        }
    }
}

#[test]
fn over_sockets_the_box_hears_what_the_robots_hear() {
    let (game, heard) = played(Version::V20, true, 3);
    let said: usize = heard.iter().map(Vec::len).sum();
    assert!(said > 500, "{said}");
    let to_mates = figures(&game).sent as usize;
    assert!((said..=3 * said).contains(&to_mates), "{said} messages are {to_mates} datagrams");
}

#[test]
fn messages_are_cut_into_datagrams_that_the_league_allows() {
    for (version, longest) in Version::ALL.into_iter().zip([128, 512, 512]) {
        let network =
            NetworkPlan { league_ports: Some(Ipv4Addr::LOCALHOST.into()), version, ..NetworkPlan::default() };
        let choice = Choice { network: Box::new(network), ..Choice::default() };
        let plan = MatchPlan::read(&assets(), &choice).expect("the shipped files are sound");
        assert_eq!(plan.tcm.datagram, longest, "{version:?}");
    }
}
