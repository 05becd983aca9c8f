use proptest::prelude::*;

use super::*;
use crate::protocol::role_swap::{Assignment, Configuration, Holding, Order};

fn position(configuration: Option<Configuration>) -> Position {
    Position { time: 1500, robot: 3, position: Vec2::new(1.5, -0.25), heading: Vec2::X, configuration }
}

fn has_bytes<T: Data + PartialEq + std::fmt::Debug>(data: T, bytes: &[u8]) {
    assert_eq!(data.serialise(), bytes, "{data:?}");
    assert_eq!(T::unserialise(bytes), Some(data));
}

fn configuration() -> Configuration {
    Configuration { epoch: 300, initiator: 1, assignment: Assignment::new([0, 3, 1, 2]) }
}

/// Figure 3's three messages, byte by byte.
#[test]
fn the_messages_of_figure_3_have_these_bytes() {
    has_bytes(
        position(None),
        &[0xDC, 0x0B, 3, 0, 0, 0xC0, 0x3F, 0, 0, 0x80, 0xBE, 0, 0, 0x80, 0x3F, 0, 0, 0, 0, 0],
    );
    has_bytes(HaveBall { time: 1800, robot: 0, have_ball: true, role: 2 }, &[0x88, 0x0E, 0, 1, 2]);
    let (behaviour, side) = (GoalieBehaviour::Leaving, Side::Right);
    has_bytes(GoalieNews { time: 650, robot: 2, behaviour, side }, &[0x8A, 0x05, 2, 0, 2]);
}

#[test]
fn the_messages_of_the_role_swap_have_these_bytes() {
    let holds = Holding::Configuration(configuration());
    let order = Order::Assignment(Assignment::new([1, 0]));
    has_bytes(role_swap::Message::Lock { sequence: 7 }, &[0, 7]);
    has_bytes(role_swap::Message::AckLock { sequence: 7, holds: Holding::Role(2) }, &[1, 7, 0, 2]);
    has_bytes(role_swap::Message::AckLock { sequence: 7, holds }, &[1, 7, 1, 0xAC, 2, 1, 4, 0, 3, 1, 2]);
    has_bytes(role_swap::Message::Swap { sequence: 7, order: Order::Role(1) }, &[2, 7, 0, 1]);
    has_bytes(role_swap::Message::Swap { sequence: 7, order }, &[2, 7, 1, 2, 1, 0]);
    has_bytes(role_swap::Message::AckSwap { sequence: 7 }, &[3, 7]);
}

#[test]
fn the_messages_about_the_ball_have_these_bytes() {
    let (distance, key) = (b3p::Distance(800), b3p::Distance(1500));
    has_bytes(Book(b3p::Book { distance, term: 3, key }), &[0xA0, 0x06, 3, 0xDC, 0x0B]);
    let report = BallReport { time: 1500, position: Vec2::new(1.5, -0.25), age: 0.0 };
    has_bytes(report, &[0xDC, 0x0B, 0, 0, 0xC0, 0x3F, 0, 0, 0x80, 0xBE, 0, 0, 0, 0]);
    has_bytes(Text("go".into()), &[2, b'g', b'o']);
}

#[test]
fn a_configuration_rides_on_a_position_message_and_costs_nothing_without_one() {
    let (with, without) = (position(Some(configuration())).serialise(), position(None).serialise());
    assert_eq!(with.len(), without.len() + 8);
}

#[test]
fn every_kind_has_a_message_and_an_attempt_where_it_belongs_to_one() {
    let lock = role_swap::Message::Lock { sequence: 4 };
    assert_eq!((lock.kind(), Data::sequence(&lock)), (MessageKind::Lock, Some(4)));
    assert_eq!((position(None).kind(), position(None).sequence()), (MessageKind::Position, None));
    assert_eq!(MessageKind::AckSwap.to_string(), "ACKSWAP");
}

#[test]
fn what_is_cut_off_lengthened_or_not_a_number_is_no_message() {
    let bytes = position(None).serialise();
    assert_eq!(Position::unserialise(&bytes[..bytes.len() - 1]), None);
    assert_eq!(Position::unserialise(&[bytes.as_slice(), &[0]].concat()), None);
    let mut nan = bytes.clone();
    nan[3..7].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(Position::unserialise(&nan), None);
}

fn read_again<T: Data + PartialEq + std::fmt::Debug>(bytes: &[u8]) {
    if let Some(data) = T::unserialise(bytes) {
        assert_eq!(T::unserialise(&data.serialise()), Some(data));
    }
}

proptest! {
    #[test]
    fn any_bytes_are_data_or_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..64)) {
        read_again::<Position>(&bytes);
        read_again::<HaveBall>(&bytes);
        read_again::<GoalieNews>(&bytes);
        read_again::<role_swap::Message>(&bytes);
        read_again::<Values>(&bytes);
        read_again::<Book>(&bytes);
        read_again::<BallReport>(&bytes);
        read_again::<Text>(&bytes);
    }
}
