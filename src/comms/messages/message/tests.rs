use proptest::prelude::*;

use super::*;
use crate::protocol::role_swap::{Assignment, Configuration, Holding, Order};

fn position(configuration: Option<Configuration>) -> TeamMessage {
    let (position, heading) = (Vec2::new(1.5, -0.25), Vec2::X);
    TeamMessage::Position(Position { time: 1500, robot: 3, position, heading, configuration })
}

fn is(message: TeamMessage, data_type: DataType, bytes: &[u8]) {
    let (known, written) = message.serialise();
    assert_eq!((known.number, written.as_slice()), (data_type, bytes), "{message:?}");
    assert_eq!(TeamMessage::unserialise(data_type, bytes), Some(message));
}

fn configuration() -> Configuration {
    Configuration { epoch: 300, initiator: 1, assignment: Assignment::new([0, 3, 1, 2]) }
}

/// Figure 3's three messages, byte by byte.
#[test]
fn the_messages_of_figure_3_have_these_bytes() {
    is(
        position(None),
        DataType::POSITION,
        &[0xDC, 0x0B, 3, 0, 0, 0xC0, 0x3F, 0, 0, 0x80, 0xBE, 0, 0, 0x80, 0x3F, 0, 0, 0, 0, 0],
    );
    let claim = HaveBall { time: 1800, robot: 0, have_ball: true, role: 2 };
    is(TeamMessage::HaveBall(claim), DataType::HAVE_BALL, &[0x88, 0x0E, 0, 1, 2]);
    let (behaviour, side) = (GoalieBehaviour::Leaving, GoalSide::Right);
    let news = GoalieNews { time: 650, robot: 2, behaviour, side };
    is(TeamMessage::Goalie(news), DataType::GOALIE_NEWS, &[0x8A, 0x05, 2, 0, 2]);
}

#[test]
fn the_messages_of_the_role_swap_are_four_types_and_have_these_bytes() {
    use role_swap::Message::{AckLock, AckSwap, Lock, Swap};
    let holds = Holding::Configuration(configuration());
    let order = Order::Assignment(Assignment::new([1, 0]));
    let is = |message, data_type, bytes| is(TeamMessage::RoleSwap(message), data_type, bytes);
    is(Lock { sequence: 7 }, DataType::LOCK, &[7]);
    is(AckLock { sequence: 7, holds: Holding::Role(2) }, DataType::ACK_LOCK, &[7, 0, 2]);
    is(AckLock { sequence: 7, holds }, DataType::ACK_LOCK, &[7, 1, 0xAC, 2, 1, 4, 0, 3, 1, 2]);
    is(Swap { sequence: 7, order: Order::Role(1) }, DataType::SWAP, &[7, 0, 1]);
    is(Swap { sequence: 7, order }, DataType::SWAP, &[7, 1, 2, 1, 0]);
    is(AckSwap { sequence: 7 }, DataType::ACK_SWAP, &[7]);
}

#[test]
fn the_messages_about_the_ball_have_these_bytes() {
    let (distance, key) = (b3p::Distance(800), b3p::Distance(1500));
    let book = b3p::Book { distance, term: 3, key };
    is(TeamMessage::Book(book), DataType::BOOK, &[0xA0, 0x06, 3, 0xDC, 0x0B]);
    let report = BallReport { time: 1500, position: Vec2::new(1.5, -0.25), age: 0.0 };
    let bytes = [0xDC, 0x0B, 0, 0, 0xC0, 0x3F, 0, 0, 0x80, 0xBE, 0, 0, 0, 0];
    is(TeamMessage::BallReport(report), DataType::BALL_REPORT, &bytes);
    is(TeamMessage::Text("go".into()), DataType::TEXT, &[2, b'g', b'o']);
}

#[test]
fn a_configuration_rides_on_a_position_message_and_costs_nothing_without_one() {
    let bytes = |message: TeamMessage| message.serialise().1.len();
    assert_eq!(bytes(position(Some(configuration()))), bytes(position(None)) + 8);
}

#[test]
fn every_message_has_a_number_a_name_and_a_word_of_its_own() {
    let mut numbers = std::collections::BTreeSet::new();
    for known in TeamMessage::TYPES {
        assert!(numbers.insert(known.number.0), "{} is there twice", known.number.0);
        let word = ron::to_string(&known.number).expect("it has a word");
        assert_eq!(ron::from_str(&word), Ok(known.number), "{word}");
        assert_eq!(known.number.to_string(), known.name);
    }
    assert_eq!(ron::from_str("AckSwap"), Ok(DataType::ACK_SWAP));
    let error = ron::from_str::<DataType>("Acknowledge").expect_err("there is no such message");
    assert!(error.to_string().contains("AckLock"), "{error}");
    assert!(ron::to_string(&DataType::FIRST_FREE).is_err());
}

#[test]
fn what_is_cut_off_lengthened_or_not_a_number_is_no_message() {
    let bytes = position(None).serialise().1;
    let read = |bytes: &[u8]| TeamMessage::unserialise(DataType::POSITION, bytes);
    assert_eq!(read(&bytes[..bytes.len() - 1]), None);
    assert_eq!(read(&[bytes.as_slice(), &[0]].concat()), None);
    let mut nan = bytes.clone();
    nan[3..7].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(read(&nan), None);
    assert_eq!(TeamMessage::unserialise(DataType::FIRST_FREE, &bytes), None);
}

proptest! {
    #[test]
    fn any_bytes_are_a_message_or_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..64)) {
        for known in TeamMessage::TYPES {
            if let Some(message) = TeamMessage::unserialise(known.number, &bytes) {
                let (again, bytes) = message.serialise();
                prop_assert_eq!(again, known);
                prop_assert_eq!(TeamMessage::unserialise(known.number, &bytes), Some(message));
            }
        }
    }
}
