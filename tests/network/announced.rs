//! Matches that are announced as if by a referee box.

use std::net::{Ipv4Addr, SocketAddr, UdpSocket};

use touchline::comms::tcm::Tcm;
use touchline::game::net::{self, NetworkPlan};
use touchline::game::requests::{Request, Requests, RobotChange};
use touchline::game::{Match, MatchPlan};
use touchline::ids::{RobotId, Team};
use touchline::world::gamecontroller::control::{Colour, ControlPacket, Penalty, State, Version};
use touchline::world::gamecontroller::referee_box::RefereeBox;
use touchline::world::referee::Phase;

use super::referee_box::{IN_THE_EASTERN_GOAL, put_ball};
use super::{open, plan, stranger, talkative};

/// A match that is announced, and the socket to which it is.
pub fn announced(plan: MatchPlan) -> (Match, UdpSocket) {
    let socket = stranger();
    socket.set_nonblocking(true).expect("sockets can do that");
    let announce = Some(socket.local_addr().expect("it is bound"));
    let (game, _) = open(&MatchPlan { network: NetworkPlan { announce, ..plan.network }, ..plan });
    (game, socket)
}

/// The next packet that has arrived.
pub fn next(socket: &UdpSocket) -> Option<Vec<u8>> {
    let mut bytes = [0; 600];
    socket.recv(&mut bytes).ok().map(|length| bytes[..length].to_vec())
}

/// All packets that have arrived.
fn packets(socket: &UdpSocket) -> Vec<ControlPacket> {
    let packets = std::iter::from_fn(|| next(socket));
    packets.map(|bytes| ControlPacket::read(&bytes).expect("it is a control packet")).collect()
}

#[test]
fn a_match_that_is_announced_can_be_followed_with_its_score_state_and_seconds() {
    let (mut game, socket) = announced(talkative(0.1));
    let from = SocketAddr::from((Ipv4Addr::LOCALHOST, 4000));
    let mut follower = RefereeBox::new(Some([1, 2]), [4; 2]);
    let (mut shot, mut states, mut half) = (false, Vec::new(), 1);
    while !game.is_over() {
        if game.state().phase == Phase::Playing && !shot {
            put_ball(&mut game, IN_THE_EASTERN_GOAL);
            shot = true;
        }
        let before = game.state().clone();
        let clock = game.clock();
        game.tick();
        let packets: Vec<_> = std::iter::from_fn(|| next(&socket)).collect();
        let half_time = std::mem::replace(&mut half, before.half) < before.half;
        let due = if half_time { 3 } else { usize::from(clock.tick.is_multiple_of(30)) };
        assert_eq!(packets.len(), due, "twice a second and at half time");
        let mut views = packets.iter().map(|packet| {
            let view = follower.hear(from, packet, (1000.0 * clock.now()) as u64);
            view.expect("it is a packet about this match").expect("it is news")
        });
        let Some(view) = views.by_ref().inspect(|view| states.push((view.first_half, view.state))).last()
        else {
            continue;
        };
        assert_eq!((view.score, view.first_half), (before.score, before.half == 1));
        if before.phase != Phase::Playing {
            assert_eq!(view.kicking, Some(before.kick_off.index()));
        }
        assert_eq!(f64::from(view.seconds_left), before.time_left.ceil());
        let phase = [State::Initial, State::Ready, State::Set, State::Playing];
        assert_eq!(Some(&view.state), phase.get(before.phase as usize));
        let off: Vec<_> = before.removed.iter().map(|removal| removal.robot).collect();
        let penalised = view.penalties.iter().zip(Team::BOTH);
        let penalised =
            penalised.flat_map(|(of, team)| of.iter().map(move |it| RobotId::new(team, it.player)));
        assert_eq!(penalised.collect::<Vec<_>>(), off);
    }
    assert_eq!(game.state().score, [1, 0], "there was something to follow");
    net::finish(game.world_mut());
    states.extend(packets(&socket).iter().map(|packet| (packet.first_half.is_set(), packet.state)));
    states.dedup();
    let half = |first| move |state| (first, state);
    let kick_off = [State::Ready, State::Set, State::Playing];
    let first = [&[State::Initial][..], &kick_off, &kick_off, &[State::Finished]].concat();
    let second = [&[State::Initial][..], &kick_off, &[State::Finished]].concat();
    let expected = first.into_iter().map(half(true)).chain(second.into_iter().map(half(false)));
    assert_eq!(states, expected.collect::<Vec<_>>());
}

#[test]
fn the_team_that_defends_the_left_goal_comes_first_in_its_colour_and_with_its_goalkeeper() {
    let (mut game, socket) = announced(plan("friendly", ["hammerheads_2001", "ball_chasers"], 0.05));
    let mut halves = [0, 0];
    while !game.is_over() {
        game.tick();
        for packet in packets(&socket) {
            let half = usize::from(!packet.first_half.is_set());
            let told = packet
                .teams
                .each_ref()
                .map(|team| (team.team_number, team.field_player_colour, team.goalkeeper));
            let (home, away) = ((1, Colour::Purple, 1), (2, Colour::Blue, 0));
            assert_eq!(told, [[home, away], [away, home]][half]);
            halves[half] += 1;
        }
    }
    assert!(halves.iter().all(|packets| *packets > 5), "{halves:?}");
}

#[test]
fn the_budget_of_messages_is_counted_down_in_every_version() {
    for (version, budget) in [(Version::V18, 1_200), (Version::V19, 12_000), (Version::V20, 12_000)] {
        let network = NetworkPlan { version, ..NetworkPlan::default() };
        let (mut game, socket) = announced(MatchPlan { network, ..talkative(0.1) });
        while !game.is_over() {
            game.tick();
        }
        net::finish(game.world_mut());
        let packets = packets(&socket);
        assert!(packets.iter().all(|packet| packet.version == version));
        let told =
            |packet: &ControlPacket| packet.teams.each_ref().map(|team| u64::from(team.message_budget));
        assert_eq!(packets.first().map(told), Some([budget; 2]));
        let mut robots = game.world_mut().query::<(&RobotId, &Tcm)>();
        let mut said = [0, 0];
        for (id, tcm) in robots.iter(game.world()) {
            said[id.team.index()] += tcm.counters.total().messages_sent;
        }
        assert!(said.iter().all(|said| *said > 100), "{said:?}");
        let [left, right] = [Team::Away, Team::Home].map(|team| budget - said[team.index()]);
        assert_eq!(packets.last().map(told), Some([left, right]), "away defends the left goal at the end");
    }
}

#[test]
fn a_robot_that_people_took_off_is_penalised_without_a_time() {
    let (mut game, socket) = announced(talkative(10.0));
    let penalise = Request::Robot(RobotId::new(Team::Away, 2), RobotChange::Penalise);
    game.world_mut().resource_mut::<Requests>().ask(penalise);
    (0..60).for_each(|_| game.tick());
    let packet = packets(&socket).pop().expect("it is announced");
    let player = packet.teams[1].players[2];
    assert_eq!((player.penalty, player.secs_till_unpenalised), (Penalty::PickUp, 0), "as version 20 says it");
}

#[test]
fn a_match_is_announced_by_broadcast_and_over_ipv6() {
    for (listens, host) in [("0.0.0.0:0", "127.255.255.255"), ("[::1]:0", "::1")] {
        let socket = UdpSocket::bind(listens).expect("this machine has such addresses");
        socket.set_nonblocking(true).expect("sockets can do that");
        let port = socket.local_addr().expect("it is bound").port();
        let announce = Some(SocketAddr::new(host.parse().expect("it is an address"), port));
        let network = NetworkPlan { announce, ..NetworkPlan::default() };
        let (mut game, _) = open(&MatchPlan { network, ..talkative(0.1) });
        game.tick();
        assert_eq!(packets(&socket).len(), 1, "{host}");
    }
}

#[test]
fn the_wall_clock_decides_once_a_window_asks_for_it_and_a_failure_is_told_once() {
    let (mut game, socket) = announced(talkative(10.0));
    let frames = |game: &mut Match, count| {
        (0..count).filter_map(|_| net::announce_in_real_time(game.world_mut(), 0.125)).collect::<Vec<_>>()
    };
    assert!(frames(&mut game, 40).is_empty());
    assert_eq!(packets(&socket).len(), 10, "five seconds in which no tick runs");
    (0..600).for_each(|_| game.tick());
    assert_eq!(packets(&socket).len(), 0, "ten seconds in which no frame is drawn");
    assert!(frames(&mut game, 4).is_empty());
    assert_eq!(packets(&socket).len(), 1);

    let nowhere = Some(SocketAddr::from(([127, 0, 0, 1], 0)));
    let network = NetworkPlan { announce: nowhere, ..NetworkPlan::default() };
    let (mut game, _) = open(&MatchPlan { network, ..talkative(10.0) });
    let told = frames(&mut game, 40);
    assert_eq!(told.len(), 1, "{told:?}");
    for words in ["the match cannot be announced", "127.0.0.1:0"] {
        assert!(told[0].contains(words), "{told:?}");
    }
    assert_eq!(told[0].lines().count(), 1, "{told:?}");
}

#[test]
fn a_match_is_announced_with_the_numbers_that_its_teams_have() {
    for (team_numbers, told) in [(None, [1, 2]), (Some([6, 9]), [6, 9])] {
        let plan = talkative(0.1);
        let network = NetworkPlan { team_numbers, ..NetworkPlan::default() };
        let (mut game, socket) = announced(MatchPlan { network, ..plan });
        game.tick();
        let packet = packets(&socket).remove(0);
        assert_eq!(packet.teams.each_ref().map(|team| team.team_number), told);
    }
}
