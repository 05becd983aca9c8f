//! Datagrams between processes are heard in a later tick than they were sent in, and by the match to which they belong.

use std::net::UdpSocket;

use touchline::comms::messages::TeamMessage;
use touchline::comms::tcm::{Data, DataType, Module, Tcm};
use touchline::game::Match;
use touchline::game::net::{self, Introduction};
use touchline::ids::RobotId;

use super::greeting::{next_message, with_remote};
use super::{HOME_0, HOME_1, address_of, datagram, figures, open, stranger, talkative};

/// The match's session, as it introduces itself to a robot.
pub(super) fn session(game: &mut Match, robot: &UdpSocket) -> u32 {
    loop {
        net::poll_greeting(game.world_mut());
        if let Some(message) = next_message(robot) {
            return Introduction::unserialise(message.data_type, &message.data)
                .expect("the match is not played")
                .session;
        }
    }
}

/// A datagram as it crosses the network between robots of a match.
pub(super) fn stamped(session: u32, tick: u64, datagram: &[u8]) -> Vec<u8> {
    [&b"TICK"[..], &session.to_le_bytes(), &tick.to_le_bytes(), datagram].concat()
}

/// Texts that a robot has received so far.
fn heard(game: &mut Match, robot: RobotId) -> u64 {
    let mut robots = game.world_mut().query::<(&RobotId, &Tcm)>();
    let found = robots.iter(game.world()).find(|(id, _)| **id == robot);
    found.map_or(0, |(_, tcm)| tcm.counters.of(Module::CHAOS_MANAGER, DataType::TEXT).messages_received)
}

#[test]
fn a_datagram_is_never_heard_in_the_tick_in_which_it_was_sent() {
    let (mut game, plan) = open(&with_remote(talkative(0.1), &[HOME_1]));
    let mate = UdpSocket::bind(address_of(&plan, HOME_1)).expect("it was free");
    let session = session(&mut game, &mate);
    let to = address_of(&plan, HOME_0);
    let mut counter = 0;
    let mut send = |from: &UdpSocket, session: u32, tick: u64| {
        counter += 1;
        let text = datagram(HOME_1.into(), HOME_0.into(), counter, &TeamMessage::Text("hello".into()));
        from.send_to(&stamped(session, tick, &text), to).expect("it is sent");
    };
    for tick in [0, 2, 1, 0] {
        send(&mate, session, tick);
    }
    let mut expected = [0, 2, 3, 4, 4].into_iter();
    let mut tick = |game: &mut Match| {
        game.tick();
        assert_eq!(Some(heard(game, HOME_0)), expected.next(), "before tick {}", game.clock().tick);
    };
    (0..4).for_each(|_| tick(&mut game));
    let before = figures(&game).foreign;
    send(&mate, session.wrapping_add(1), 1);
    send(&stranger(), session, 1);
    let unstamped = datagram(HOME_1.into(), HOME_0.into(), 99, &TeamMessage::Text("hello".into()));
    mate.send_to(&unstamped, to).expect("it is sent");
    tick(&mut game);
    assert_eq!(figures(&game).foreign - before, 3, "of another match, from elsewhere, of no match");
}
