use proptest::prelude::*;
use smallvec::smallvec;

use super::*;
use crate::protocol::role_swap::{Assignment, Configuration, Holding, Order};

fn position(configuration: Option<Configuration>) -> Message {
    Message::Position(Position {
        time: 1500,
        robot: 3,
        position: Vec2::new(1.5, -0.25),
        heading: Vec2::X,
        configuration,
    })
}

fn configuration() -> Configuration {
    Configuration { epoch: 300, initiator: 1, assignment: Assignment::new([0, 3, 1, 2]) }
}

/// Figure 3's three messages, byte by byte.
#[test]
fn the_messages_of_figure_3_have_these_bytes() {
    let golden: [(Message, &[u8]); 3] = [
        (
            position(None),
            &[0, 0xDC, 0x0B, 3, 0, 0, 0xC0, 0x3F, 0, 0, 0x80, 0xBE, 0, 0, 0x80, 0x3F, 0, 0, 0, 0, 0],
        ),
        (
            Message::HaveBall(HaveBall { time: 1800, robot: 0, have_ball: true, role: 2 }),
            &[1, 0x88, 0x0E, 0, 1, 2],
        ),
        (
            Message::Goalie(GoalieNews {
                time: 650,
                robot: 2,
                behaviour: GoalieBehaviour::Leaving,
                side: Side::Right,
            }),
            &[2, 0x8A, 0x05, 2, 0, 2],
        ),
    ];
    for (message, bytes) in golden {
        assert_eq!(message.encode().as_slice(), bytes, "{message:?}");
        assert_eq!(Message::decode(bytes), Ok(message));
    }
}

#[test]
fn the_messages_of_the_role_swap_have_these_bytes() {
    let holds = Holding::Configuration(configuration());
    let order = Order::Assignment(Assignment::new([1, 0]));
    let golden: [(role_swap::Message, &[u8]); 6] = [
        (role_swap::Message::Lock { sequence: 7 }, &[3, 0, 7]),
        (role_swap::Message::AckLock { sequence: 7, holds: Holding::Role(2) }, &[3, 1, 7, 0, 2]),
        (role_swap::Message::AckLock { sequence: 7, holds }, &[3, 1, 7, 1, 0xAC, 2, 1, 4, 0, 3, 1, 2]),
        (role_swap::Message::Swap { sequence: 7, order: Order::Role(1) }, &[3, 2, 7, 0, 1]),
        (role_swap::Message::Swap { sequence: 7, order }, &[3, 2, 7, 1, 2, 1, 0]),
        (role_swap::Message::AckSwap { sequence: 7 }, &[3, 3, 7]),
    ];
    for (message, bytes) in golden {
        let message = Message::RoleSwap(message);
        assert_eq!(message.encode().as_slice(), bytes, "{message:?}");
        assert_eq!(Message::decode(bytes), Ok(message));
    }
}

#[test]
fn a_configuration_rides_on_a_position_message_and_costs_nothing_without_one() {
    let (with, without) = (position(Some(configuration())).encode(), position(None).encode());
    assert_eq!(with.len(), without.len() + 8);
    assert_eq!(Message::decode(&with), Ok(position(Some(configuration()))));
}

#[test]
fn every_kind_has_a_message_and_an_attempt_where_it_belongs_to_one() {
    let lock = Message::RoleSwap(role_swap::Message::Lock { sequence: 4 });
    assert_eq!((lock.kind(), lock.sequence()), (MessageKind::Lock, Some(4)));
    assert_eq!((position(None).kind(), position(None).sequence()), (MessageKind::Position, None));
    assert_eq!(MessageKind::AckSwap.to_string(), "ACKSWAP");
}

#[test]
fn what_is_cut_off_lengthened_or_not_a_number_is_no_message() {
    let bytes = position(None).encode();
    assert_eq!(Message::decode(&bytes[..bytes.len() - 1]), Err(NotAMessage));
    let mut longer = bytes.clone();
    longer.push(0);
    assert_eq!(Message::decode(&longer), Err(NotAMessage));
    let mut nan: SmallVec<[u8; 40]> = smallvec![];
    nan.extend_from_slice(&bytes);
    nan[4..8].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(Message::decode(&nan), Err(NotAMessage));
}

proptest! {
    #[test]
    fn any_bytes_are_a_message_or_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..64)) {
        if let Ok(message) = Message::decode(&bytes) {
            prop_assert_eq!(Message::decode(&message.encode()), Ok(message));
        }
    }
}
