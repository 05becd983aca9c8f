//! Matches that cross a network: team messages over real sockets, robots in other processes, referee boxes.

mod announced;
mod chaos;
mod greeting;
mod league;
mod processes;
mod recorded;
mod referee_box;
mod stamps;

use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use touchline::comms::messages::TeamMessage;
use touchline::comms::radio::{RadioRecord, TransmissionState};
use touchline::comms::tcm::fragments::{Assembly, Header, Limits, USUAL_DATAGRAM, cut};
use touchline::comms::tcm::udp::UdpError;
use touchline::comms::tcm::{Data, DataType, Directory, ExternalMessage, HOST, Module, Peer, Tcm};
use touchline::game::net::{self, CarrierFigures, Greeting, NetworkError, NetworkPlan, UdpCarrier};
use touchline::game::{Choice, Match, MatchPlan};
use touchline::ids::{RobotId, Team};
use touchline::protocol::role_swap;

use crate::support::{assets, digest_of};

const HOME_0: RobotId = RobotId::new(Team::Home, 0);
const HOME_1: RobotId = RobotId::new(Team::Home, 1);

/// A match over the radio that loses nothing, with halves of so many minutes.
fn plan(file: &str, strategies: [&str; 2], half_minutes: f32) -> MatchPlan {
    let [home, away] = strategies.map(|name| Some(name.to_owned()));
    let choice = Choice {
        file: Some(file.into()),
        home,
        away,
        radio: Some("perfect".into()),
        half_minutes: Some(half_minutes),
        seed: 7,
        ..Choice::default()
    };
    MatchPlan::read(&assets(), &choice).expect("the shipped files are sound")
}

/// The Hammerheads with role swaps against themselves: eight robots that talk much.
fn talkative(half_minutes: f32) -> MatchPlan {
    plan("friendly", ["hammerheads_swap"; 2], half_minutes)
}

/// The first of the ports that are tried, and how many lie below those that Linux gives out by itself.
const PORTS: (u32, u32) = (10_000, 22_500);

/// So many addresses of this machine that nobody uses. Another process may take one before it is used here, though tests
/// that run at the same time begin to look at different places: then look again.
fn free_addresses(count: usize) -> Vec<SocketAddr> {
    static LOOKS: AtomicU32 = AtomicU32::new(0);
    loop {
        let look = LOOKS.fetch_add(1, Ordering::Relaxed);
        let place =
            std::process::id().wrapping_mul(37).wrapping_add(look.wrapping_mul(1009)) % (PORTS.1 - 64);
        let ports = (PORTS.0 + place..).take(count).filter_map(|port| u16::try_from(port).ok());
        let addresses: Vec<_> = ports.map(|port| SocketAddr::from((Ipv4Addr::LOCALHOST, port))).collect();
        if addresses.iter().map(UdpSocket::bind).collect::<Result<Vec<_>, _>>().is_ok() {
            return addresses;
        }
    }
}

/// Addresses for the robots of a match, for a computer that listens, and for the match itself.
fn free_directory(plan: &MatchPlan) -> Directory {
    let everybody: Vec<Peer> = plan.robots().map(Peer::from).chain([Peer::Computer(0), HOST]).collect();
    let addresses = free_addresses(everybody.len());
    everybody.into_iter().zip(addresses).collect()
}

/// Starts the match at free addresses.
fn open(plan: &MatchPlan) -> (Match, MatchPlan) {
    let mut plan = plan.clone();
    loop {
        plan.addresses = Some(free_directory(&plan));
        if let Some(address) = &mut plan.network.gamecontroller {
            *address = free_addresses(1)[0];
        }
        if let Some(chaos) = &mut plan.network.chaos {
            chaos.at = free_addresses(3)[0];
        }
        let mut game = Match::new(&plan);
        match net::open(game.world_mut(), &plan) {
            Ok(()) => return (game, plan),
            Err(NetworkError::Udp(UdpError::Bind { .. })) => {}
            Err(error) => panic!("{error}"),
        }
    }
}

/// Waits until all robots in other processes take part; they come for certain.
fn greet(game: &mut Match) {
    let greeting = net::greet(game.world_mut(), Duration::MAX, &mut |_| true);
    assert_eq!(greeting.expect("they come"), Greeting::Done);
}

fn by_udp(plan: MatchPlan) -> MatchPlan {
    MatchPlan { network: NetworkPlan { udp: true, ..NetworkPlan::default() }, ..plan }
}

fn address_of(plan: &MatchPlan, robot: RobotId) -> SocketAddr {
    plan.directory().address_of(Peer::from(robot)).expect("the robot has an address")
}

fn figures(game: &Match) -> CarrierFigures {
    game.world().resource::<UdpCarrier>().figures
}

/// A socket of somebody whom no match knows.
fn stranger() -> UdpSocket {
    UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).expect("there is a free port")
}

/// A datagram with a whole message.
fn datagram<T: Data>(from: Peer, to: Peer, counter: u32, data: &T) -> Vec<u8> {
    cut(&ExternalMessage::of(data, from, to), counter, USUAL_DATAGRAM).expect("it can be sent").remove(0)
}

#[test]
fn a_match_over_sockets_is_the_very_match_over_a_radio_that_loses_nothing() {
    for (file, strategies) in
        [("four_legged_2005", ["chaos_b3p", "chaos_plain"]), ("friendly", ["hammerheads_swap"; 2])]
    {
        let by_radio = plan(file, strategies, 0.25);
        let (mut game, _) = open(&by_udp(by_radio.clone()));
        while !game.is_over() {
            game.tick();
        }
        net::finish(game.world_mut());
        assert_eq!(game.record().digest, digest_of(&by_radio), "{file}");
        let figures = figures(&game);
        assert!(figures.sent > 500, "{file}: {figures:?}");
        let all_arrived = CarrierFigures { sent: figures.sent, received: figures.sent, ..Default::default() };
        assert_eq!(figures, all_arrived, "{file}");
        let traffic = game.world().resource::<RadioRecord>().total();
        assert_eq!((traffic.sent, traffic.lost_in_all()), (figures.sent, 0), "{file}");
    }
}

#[test]
fn what_is_not_ours_is_counted_and_changes_nothing() {
    let by_radio = talkative(0.1);
    let (mut game, plan) = open(&by_udp(by_radio.clone()));
    let (stranger, to) = (stranger(), address_of(&plan, HOME_0));
    let text = TeamMessage::Text("hello".into());
    let mut times = 0;
    while !game.is_over() {
        if game.clock().tick.is_multiple_of(100) {
            let forged = datagram(Peer::from(HOME_1), Peer::Team(0), times, &text);
            let told = datagram(Peer::Computer(0), Peer::from(HOME_0), times, &text);
            for bytes in [&b"RGme"[..], b"", &[7; 2000], &forged, &told] {
                stranger.send_to(bytes, to).expect("it is sent");
            }
            times += 1;
        }
        game.tick();
    }
    net::finish(game.world_mut());
    let figures = figures(&game);
    let times = u64::from(times);
    assert!(times >= 10, "{times}");
    assert_eq!((figures.foreign, figures.from_computers), (4 * times, times));
    assert_eq!((figures.sent, figures.refused), (figures.received, 0));
    assert_eq!(game.record().digest, digest_of(&by_radio));
    let mut robots = game.world_mut().query::<(&RobotId, &Tcm)>();
    let heard: Vec<_> = robots
        .iter(game.world())
        .map(|(id, tcm)| (*id, tcm.counters.of(Module::CHAOS_MANAGER, DataType::TEXT).messages_received))
        .filter(|(_, heard)| *heard > 0)
        .collect();
    assert_eq!(heard, [(HOME_0, times)]);
}

#[test]
fn a_computer_in_the_addresses_hears_what_robots_tell_their_teams() {
    let (mut game, plan) = open(&by_udp(talkative(0.1)));
    let at = plan.directory().address_of(Peer::Computer(0)).expect("it is in the addresses");
    let computer = UdpSocket::bind(at).expect("the address was free");
    computer.set_nonblocking(true).expect("sockets can do that");
    let mut assembly = Assembly::new(Limits::default());
    let (mut heard, mut bytes) = (0, [0; 2000]);
    while !game.is_over() {
        game.tick();
        while let Ok(length) = computer.recv(&mut bytes) {
            let message = assembly.accept(game.clock().tick, &bytes[..length]).expect("it is of the TCM");
            let message = message.expect("team messages are short");
            let Peer::Robot { team, .. } = message.source.peer else { panic!("{message:?}") };
            assert_eq!(message.destination.peer, Peer::Team(team));
            heard += 1;
        }
    }
    let mut robots = game.world_mut().query::<&Tcm>();
    let all = robots.iter(game.world()).map(|tcm| tcm.counters.total());
    let (said, datagrams) = all.fold((0, 0), |(said, datagrams), count| {
        (said + count.messages_sent, datagrams + count.datagrams_sent)
    });
    // Three mates get each of them; some messages of a role swap are for one mate only.
    let for_a_team = (datagrams - said) / 3;
    assert!(heard > 100, "{heard}");
    assert_eq!(heard, for_a_team);
    assert_eq!(figures(&game).sent, datagrams - heard);
}

#[test]
fn an_address_that_is_taken_or_missing_is_named_and_no_socket_stays_open() {
    let plan = by_udp(talkative(0.1));
    let everybody = free_directory(&plan);
    let first = everybody.address_of(Peer::from(HOME_0)).expect("it is there");
    let taken = stranger();
    let taken_at = taken.local_addr().expect("it is bound");
    let changed = |change: &dyn Fn(Peer, SocketAddr) -> Option<SocketAddr>| {
        let entries = everybody.entries();
        let entries = entries.filter_map(|(peer, address)| Some((peer, change(peer, address)?)));
        MatchPlan { addresses: Some(entries.collect()), ..plan.clone() }
    };
    let moved = changed(&|who, at| Some(if who == Peer::from(HOME_1) { taken_at } else { at }));
    let missing = changed(&|who, at| (who != Peer::from(HOME_1)).then_some(at));
    for (plan, expected) in [
        (moved, format!("cannot listen at {taken_at}: the port is taken")),
        (missing, "home 1 has no address: add it to the addresses".to_owned()),
    ] {
        let mut game = Match::new(&plan);
        let error = net::open(game.world_mut(), &plan).expect_err("it cannot be played").to_string();
        assert!(error.starts_with(&expected) && error.lines().count() == 1, "{error}");
        assert!(!game.world().contains_resource::<UdpCarrier>());
        UdpSocket::bind(first).expect("the first robot's socket was closed again");
        game.tick();
    }
}

/// The test plays the part of a robot in another process: it tells and hears nothing but team messages.
#[test]
fn a_lock_of_a_robot_in_another_process_is_recorded_with_its_kind_and_answered() {
    let remote = NetworkPlan { udp: true, remote: vec![HOME_1], ..NetworkPlan::default() };
    let (mut game, plan) = open(&MatchPlan { network: remote, ..talkative(0.1) });
    let robot =
        UdpSocket::bind(address_of(&plan, HOME_1)).expect("the match leaves the address to the robot");
    let session = stamps::session(&mut game, &robot);
    robot.set_nonblocking(true).expect("sockets can do that");
    game.tick();
    let lock = TeamMessage::RoleSwap(role_swap::Message::Lock { sequence: 7 });
    let lock = datagram(HOME_1.into(), HOME_0.into(), 1, &lock);
    robot.send_to(&stamps::stamped(session, 0, &lock), address_of(&plan, HOME_0)).expect("it is sent");
    (0..12).for_each(|_| game.tick());
    let record = game.world().resource::<RadioRecord>();
    let of = |kind, from: RobotId, to: RobotId| {
        let mut found = record
            .transmissions()
            .filter(|entry| (entry.packet.kind, entry.packet.from, entry.packet.to) == (kind, from, to));
        (found.next().map(|entry| (entry.sent, entry.state)), found.count())
    };
    assert_eq!(of(DataType::LOCK, HOME_1, HOME_0), (Some((0, TransmissionState::Arrived(1))), 0));
    assert_eq!(record.of_kind(DataType::LOCK, Some(HOME_1), Some(HOME_0)).delivered, 1);
    let (answer, others) = of(DataType::ACK_LOCK, HOME_0, HOME_1);
    assert!(matches!(answer, Some((_, TransmissionState::Arrived(_)))) && others == 0, "{answer:?}");
    let (mut bytes, mut heard) = ([0; 2000], Vec::new());
    while let Ok(length) = robot.recv(&mut bytes) {
        // What the match itself says to a robot has no stamp.
        let stamp = if bytes.starts_with(b"TICK") { 16 } else { 0 };
        let (header, data) = Header::read(&bytes[stamp..length]).expect("it is of the TCM");
        heard.extend(TeamMessage::unserialise(header.data_type, data));
    }
    let is_answer = |message: &TeamMessage| {
        matches!(message, TeamMessage::RoleSwap(role_swap::Message::AckLock { sequence: 7, .. }))
    };
    assert_eq!(heard.iter().filter(|message| is_answer(message)).count(), 1, "{heard:?}");
}
