//! How a match and its robots in other processes meet, miss each other, and meet again. The robots are threads of the test.

use std::net::UdpSocket;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use touchline::comms::messages::TeamMessage;
use touchline::comms::tcm::fragments::{Assembly, Limits};
use touchline::comms::tcm::{Addresses, Data, ExternalMessage, HOST, Peer};
use touchline::game::net::{
    self, Greeting, Introduction, NetworkError, NetworkPlan, RobotEnd, RobotProcess, RobotReport,
};
use touchline::game::requests::{Request, Requests, RobotChange};
use touchline::game::{Match, MatchPlan};
use touchline::ids::RobotId;
use touchline::robot::{Restart, RobotFailure};

use super::{HOME_0, HOME_1, address_of, datagram, figures, greet, open, stranger, talkative};
use crate::support::digest_of;

pub(super) fn with_remote(plan: MatchPlan, remote: &[RobotId]) -> MatchPlan {
    let network = NetworkPlan { udp: true, remote: remote.to_vec(), ..NetworkPlan::default() };
    MatchPlan { network, ..plan }
}

/// A robot that plays in a thread of its own until it is told to stop.
pub(super) struct Elsewhere {
    stops: Arc<AtomicBool>,
    thread: Option<JoinHandle<Result<RobotReport, NetworkError>>>,
}

impl Elsewhere {
    pub fn start(plan: &MatchPlan, robot: RobotId) -> Elsewhere {
        let (plan, stops) = (plan.clone(), Arc::new(AtomicBool::new(false)));
        let stopped = stops.clone();
        let play = move || {
            let mut process = RobotProcess::open(&plan, robot, address_of(&plan, robot))?;
            process.play(net::PATIENCE, &|| stopped.load(Ordering::Relaxed))
        };
        Elsewhere { stops, thread: Some(std::thread::spawn(play)) }
    }

    fn end(&mut self) -> Result<RobotReport, NetworkError> {
        self.thread.take().expect("it was not ended yet").join().expect("it does not panic")
    }

    pub fn stop(&mut self) -> RobotReport {
        self.stops.store(true, Ordering::Relaxed);
        self.end().expect("it belongs to the match")
    }
}

impl Drop for Elsewhere {
    fn drop(&mut self) {
        self.stops.store(true, Ordering::Relaxed);
    }
}

fn ticks(game: &mut Match, count: u32) {
    (0..count).for_each(|_| game.tick());
}

fn answered(game: &Match) -> u64 {
    net::remote_figures(game.world())[0].answered
}

/// Plays on until the robot is missed.
fn until_it_is_missed(game: &mut Match) {
    while net::poll_greeting(game.world_mut()) == Greeting::Done {
        game.tick();
    }
}

/// The next message that reaches a socket.
pub(super) fn next_message(socket: &UdpSocket) -> Option<ExternalMessage> {
    socket.set_read_timeout(Some(Duration::from_millis(20))).expect("sockets can do that");
    let mut bytes = [0; 2000];
    let length = socket.recv(&mut bytes).ok()?;
    Assembly::new(Limits::default()).accept(0, &bytes[..length]).expect("it is of the TCM")
}

#[test]
fn a_match_and_a_robot_that_is_told_to_stop_report_what_they_have_done_so_far() {
    let (mut game, plan) = open(&with_remote(talkative(0.1), &[HOME_1]));
    let mut robot = Elsewhere::start(&plan, HOME_1);
    greet(&mut game);
    ticks(&mut game, 10);
    let report = robot.stop();
    assert_eq!((report.robot, report.ending), (HOME_1, RobotEnd::Stopped));
    assert!(report.answered >= answered(&game) && answered(&game) > 0, "{report:?}");
}

#[test]
fn a_robot_elsewhere_hears_what_is_asked_of_its_mind() {
    let (mut game, plan) = open(&with_remote(talkative(0.5), &[HOME_1]));
    let _robot = Elsewhere::start(&plan, HOME_1);
    greet(&mut game);
    // A tick for the answer that tells of it, and one more for an answer that comes late.
    let mut says = |change: Option<RobotChange>, count: u32| {
        if let Some(change) = change {
            game.world_mut().resource_mut::<Requests>().ask(Request::Robot(HOME_1, change));
            ticks(&mut game, 2);
        }
        let before = net::remote_figures(game.world())[0].sent;
        ticks(&mut game, count);
        net::remote_figures(game.world())[0].sent > before
    };
    assert!(says(None, 120), "it talks");
    assert!(!says(Some(RobotChange::Fail(RobotFailure::Crashed)), 120), "its computer is off");
    assert!(says(Some(RobotChange::Revive(Restart::Lost)), 120), "it is on again");
}

#[test]
fn the_wait_for_robots_ends_when_somebody_wants_it_to() {
    let (mut game, plan) = open(&with_remote(talkative(0.1), &[HOME_0, HOME_1]));
    let mut asked = 0;
    let greeting = net::greet(game.world_mut(), Duration::MAX, &mut |awaited| {
        asked += 1;
        awaited.len() == 2 && asked < 3
    });
    let Ok(Greeting::Awaiting(awaited)) = greeting else { panic!("{greeting:?}") };
    let awaited: Vec<_> = awaited.iter().map(|robot| (robot.robot, robot.address, &robot.refusal)).collect();
    let expected = [HOME_0, HOME_1].map(|robot| (robot, address_of(&plan, robot), &None));
    assert_eq!((awaited, asked), (expected.to_vec(), 3));
}

#[test]
fn a_robot_that_comes_back_is_taken_in_again() {
    let (mut game, plan) = open(&with_remote(talkative(0.5), &[HOME_1]));
    let mut robot = Elsewhere::start(&plan, HOME_1);
    greet(&mut game);
    ticks(&mut game, 20);
    robot.stop();
    until_it_is_missed(&mut game);
    let before = answered(&game);
    ticks(&mut game, 20);
    assert_eq!(answered(&game), before);
    let _back = Elsewhere::start(&plan, HOME_1);
    while answered(&game) < before + 5 {
        // On a busy machine it may be missed again before it has answered so often.
        greet(&mut game);
        game.tick();
    }
}

#[test]
fn who_comes_back_with_another_strategy_is_refused_and_the_match_goes_on() {
    let (mut game, plan) = open(&with_remote(talkative(0.5), &[HOME_1]));
    let mut robot = Elsewhere::start(&plan, HOME_1);
    greet(&mut game);
    robot.stop();
    until_it_is_missed(&mut game);
    let mut other = plan.clone();
    other.teams[0] = super::plan("friendly", ["ball_chasers"; 2], 0.5).teams[0].clone();
    let mut back = Elsewhere::start(&other, HOME_1);
    let refusal = loop {
        game.tick();
        let Greeting::Awaiting(awaited) = net::poll_greeting(game.world_mut()) else {
            panic!("it is another")
        };
        if let Some(refusal) = awaited[0].refusal.clone() {
            break refusal;
        }
    };
    assert!(refusal.contains("the strategy of home differs"), "{refusal}");
    let error = back.end().expect_err("it is another");
    assert!(matches!(error, NetworkError::OtherMatch { robot: HOME_1, .. }), "{error}");
}

#[test]
fn a_robot_given_up_before_the_first_tick_plays_as_if_it_had_never_been_elsewhere() {
    let by_radio = talkative(0.1);
    let (mut game, _) = open(&with_remote(by_radio.clone(), &[HOME_1]));
    net::give_up(game.world_mut(), HOME_1).expect("its address is free");
    assert_eq!(net::poll_greeting(game.world_mut()), Greeting::Done);
    while !game.is_over() {
        game.tick();
    }
    assert_eq!(game.record().digest, digest_of(&by_radio));
}

#[test]
fn a_robot_given_up_in_the_midst_of_a_match_plays_on_here_though_somebody_has_its_address() {
    let (mut game, plan) = open(&with_remote(talkative(0.2), &[HOME_1]));
    let mut robot = Elsewhere::start(&plan, HOME_1);
    greet(&mut game);
    ticks(&mut game, 60);
    robot.stop();
    until_it_is_missed(&mut game);
    let taken = UdpSocket::bind(address_of(&plan, HOME_1)).expect("the robot is gone");
    net::give_up(game.world_mut(), HOME_1).expect("there are other ports");
    assert_eq!(net::poll_greeting(game.world_mut()), Greeting::Done);
    let directory = game.world().resource::<Addresses>().0.clone();
    assert_ne!(directory.address_of(Peer::from(HOME_1)), taken.local_addr().ok());
    let before = figures(&game);
    let driven = |game: &Match| {
        game.record().driven.iter().find(|(robot, _)| *robot == HOME_1).map(|(_, driven)| *driven)
    };
    let stood_at = driven(&game);
    while !game.is_over() {
        game.tick();
    }
    net::finish(game.world_mut());
    let after = figures(&game);
    assert_eq!(after.sent - before.sent, after.received - before.received, "everybody hears everybody");
    assert_eq!(after.foreign, before.foreign);
    assert!(driven(&game) > stood_at, "{stood_at:?}");
}

/// Why a robot refuses a match that says nothing but this.
fn robots_refusal(plan: &MatchPlan, told: &[u8]) -> String {
    let host = plan.directory().address_of(HOST).expect("it is there");
    let host = UdpSocket::bind(host).expect("no match is there");
    let mut robot = Elsewhere::start(plan, HOME_1);
    while robot.thread.as_ref().is_some_and(|thread| !thread.is_finished()) {
        host.send_to(told, address_of(plan, HOME_1)).expect("it is sent");
        std::thread::yield_now();
    }
    robot.end().expect_err("it is no match of the robot's").to_string()
}

#[test]
fn a_program_that_speaks_another_language_is_told_apart_on_either_side() {
    let text = TeamMessage::Text("hello".into());
    let (mut game, plan) = open(&with_remote(talkative(0.1), &[HOME_1]));
    let host = plan.directory().address_of(HOST).expect("it is there");
    let robot = UdpSocket::bind(address_of(&plan, HOME_1)).expect("it was free");
    for bytes in [b"hello".to_vec(), datagram(Peer::from(HOME_1), HOST, 1, &text)] {
        robot.send_to(&bytes, host).expect("it is sent");
        let Greeting::Awaiting(awaited) = net::poll_greeting(game.world_mut()) else {
            panic!("it is no robot")
        };
        let refusal = awaited[0].refusal.as_ref().expect("it has been heard");
        assert!(refusal.ends_with("it says what no robot of this version says"), "{refusal}");
    }
    drop((game, robot));
    let error = robots_refusal(&plan, &datagram(HOST, Peer::from(HOME_1), 1, &text));
    assert!(error.ends_with("it says what no match of this version says"), "{error}");
}

#[test]
fn a_robot_of_another_version_of_the_program_is_refused_on_either_side() {
    let (mut game, plan) = open(&with_remote(talkative(0.1), &[HOME_1]));
    let host = plan.directory().address_of(HOST).expect("it is there");
    let robot = UdpSocket::bind(address_of(&plan, HOME_1)).expect("it was free");
    let introduction = loop {
        net::poll_greeting(game.world_mut());
        if let Some(message) = next_message(&robot) {
            break Introduction::unserialise(message.data_type, &message.data)
                .expect("the match is not played");
        }
    };
    let older = Introduction { version: "0.0.1".into(), ..introduction.clone() };
    let (here, there) = (&introduction.version, introduction.protocol);
    let differs =
        format!("the version differs: here {here} (protocol {there}), there 0.0.1 (protocol {there})");
    let refusal = loop {
        robot.send_to(&datagram(Peer::from(HOME_1), HOST, 1, &older), host).expect("it is sent");
        let Greeting::Awaiting(awaited) = net::poll_greeting(game.world_mut()) else {
            panic!("it is another")
        };
        if let Some(refusal) = awaited[0].refusal.clone() {
            break refusal;
        }
    };
    assert!(refusal.contains(&differs), "{refusal}");
    drop((game, robot));
    let error = robots_refusal(&plan, &datagram(HOST, Peer::from(HOME_1), 1, &older));
    assert!(error.contains(&differs) && error.lines().count() == 1, "{error}");
}

#[test]
fn a_match_that_stands_still_reminds_its_robots_that_it_is_there() {
    let (mut game, plan) = open(&with_remote(talkative(0.1), &[HOME_1]));
    let robot = UdpSocket::bind(address_of(&plan, HOME_1)).expect("it was free");
    let host = plan.directory().address_of(HOST).expect("it is there");
    let mut introductions = 0;
    while introductions < 3 {
        let is_in = net::poll_greeting(game.world_mut()) == Greeting::Done;
        let Some(message) = next_message(&robot) else { continue };
        let introduction =
            Introduction::unserialise(message.data_type, &message.data).expect("the match is not played");
        robot.send_to(&datagram(Peer::from(HOME_1), HOST, 1, &introduction), host).expect("it is sent");
        introductions += u32::from(is_in);
    }
}

#[test]
fn a_robot_begins_again_with_its_match() {
    let plan = with_remote(talkative(0.02), &[HOME_1]);
    let (mut game, plan) = open(&plan);
    let mut robot = Elsewhere::start(&plan, HOME_1);
    greet(&mut game);
    ticks(&mut game, 30);
    net::close(game.world_mut());
    let mut game = Match::new(&plan);
    net::open(game.world_mut(), &plan).expect("the addresses are free again");
    greet(&mut game);
    while !game.is_over() {
        game.tick();
    }
    net::finish(game.world_mut());
    let report = robot.end().expect("it belongs to both");
    assert_eq!(report.ending, RobotEnd::MatchOver);
    assert!(report.answered <= game.clock().tick && report.answered > 30, "{report:?}");
}

#[test]
fn who_floods_a_match_with_datagrams_does_not_stop_it() {
    let (mut game, plan) = open(&with_remote(talkative(0.05), &[HOME_1]));
    let to = [HOST, Peer::from(HOME_0)].map(|who| plan.directory().address_of(who).expect("it is there"));
    let stops = Arc::new(AtomicBool::new(false));
    let threads = [(to[0], stranger()), (to[1], stranger()), (to[0], stranger())].map(|(to, socket)| {
        let stops = stops.clone();
        std::thread::spawn(move || {
            while !stops.load(Ordering::Relaxed) {
                // Who is not heard is no flood's concern.
                let _ = socket.send_to(&[7; 40], to);
            }
        })
    });
    while !game.is_over() {
        game.tick();
    }
    net::finish(game.world_mut());
    stops.store(true, Ordering::Relaxed);
    threads.into_iter().for_each(|thread| thread.join().expect("it does not panic"));
    assert!(figures(&game).foreign > 0);
}

#[test]
fn a_tick_takes_so_many_datagrams_at_most_and_the_next_ones_the_rest() {
    let (mut game, plan) = open(&super::by_udp(talkative(0.05)));
    let (stranger, to) = (stranger(), address_of(&plan, HOME_0));
    (0..200).for_each(|_| assert_eq!(stranger.send_to(b"?", to).ok(), Some(1)));
    let foreign = [(); 2].map(|()| {
        game.tick();
        figures(&game).foreign
    });
    assert_eq!(foreign, [128, 200]);
}

#[test]
fn addresses_of_ipv6_carry_a_match_and_its_robots() {
    let mut plan = with_remote(talkative(0.05), &[HOME_1]);
    let addresses = super::free_directory(&plan);
    let on_loopback = |(who, at): (Peer, std::net::SocketAddr)| {
        (who, std::net::SocketAddr::from((std::net::Ipv6Addr::LOCALHOST, at.port())))
    };
    plan.addresses = Some(addresses.entries().map(on_loopback).collect());
    let mut game = Match::new(&plan);
    net::open(game.world_mut(), &plan).expect("this machine has IPv6");
    let mut robot = Elsewhere::start(&plan, HOME_1);
    greet(&mut game);
    while !game.is_over() {
        game.tick();
    }
    net::finish(game.world_mut());
    let report = robot.end().expect("it belongs to the match");
    assert_eq!(report.ending, RobotEnd::MatchOver);
    assert!(
        report.answered > 0 && report.datagrams.received > 0 && report.datagrams.foreign == 0,
        "{report:?}"
    );
}
