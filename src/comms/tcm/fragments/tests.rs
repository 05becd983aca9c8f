use proptest::prelude::*;
use proptest::sample::Index;

use super::header::LARGEST_PIECE;
use super::*;
use crate::comms::tcm::external_message::{Address, DataType, Module};

const HOME_3: Peer = Peer::Robot { team: 0, number: 3 };

fn message(source: Peer, bytes: usize) -> ExternalMessage {
    ExternalMessage {
        source: Address { peer: source, module: Module::WORLD_MODEL },
        destination: Address { peer: Peer::Team(0), module: Module::WORLD_MODEL },
        data_type: DataType::FIRST_FREE,
        data: (0..bytes).map(|place| (place % 251) as u8).collect(),
    }
}

fn assembly() -> Assembly {
    Assembly::new(Limits::default())
}

/// The only message that a sequence of datagrams completes.
fn assembled(assembly: &mut Assembly, datagrams: &[Vec<u8>]) -> Option<ExternalMessage> {
    let mut messages = datagrams.iter().filter_map(|datagram| assembly.accept(0, datagram).unwrap());
    let message = messages.next();
    assert_eq!(messages.next(), None);
    message
}

/// The example of `docs/tcm.md` of a message that fits into a datagram.
#[test]
fn a_text_has_these_bytes() {
    let manager = Module::CHAOS_MANAGER;
    let message = ExternalMessage {
        source: Address { peer: Peer::Computer(0), module: manager },
        destination: Address { peer: Peer::Robot { team: 1, number: 2 }, module: manager },
        data_type: DataType::TEXT,
        data: b"\x05hello".to_vec(),
    };
    #[rustfmt::skip]
    let golden = [
        0x54, 0x43, 0x4D, 0x02, // "TCM", version 2
        0x01, 0x00, 0x00, 0x06, // from a computer, (no team,) number 0, module ChaosManager
        0x00, 0x01, 0x02, 0x06, // to a robot, team away, number 2, module ChaosManager
        0x07, 0x00, 0x00, 0x00, // the source's message 7
        0x06, 0x00, 0x00, 0x00, // of 6 bytes
        0x08, 0x00,             // a text
        0x00, 0x00, 0x01, 0x00, // fragment 0 of 1
        0x06, 0x00,             // its piece has 6 bytes
        0x05, 0x68, 0x65, 0x6C, 0x6C, 0x6F, // a string of 5 bytes: "hello"
    ];
    assert_eq!(cut(&message, 7, USUAL_DATAGRAM).unwrap(), [golden]);
    assert_eq!(assembly().accept(0, &golden), Ok(Some(message)));
}

/// The example of `docs/tcm.md` of a message in two fragments.
#[test]
fn a_position_in_small_datagrams_has_these_bytes() {
    #[rustfmt::skip]
    let data = [
        0xDC, 0x0B,             // time: 1500 ms
        0x03,                   // robot 3
        0x00, 0x00, 0xC0, 0x3F, // x: 1.5 m
        0x00, 0x00, 0x80, 0xBE, // y: -0.25 m
        0x00, 0x00, 0x80, 0x3F, // heading x: 1
        0x00, 0x00, 0x00, 0x00, // heading y: 0
        0x00,                   // no configuration
    ];
    let message =
        ExternalMessage { data_type: DataType::POSITION, data: data.to_vec(), ..message(HOME_3, 0) };
    #[rustfmt::skip]
    let head = [
        0x54, 0x43, 0x4D, 0x02, // "TCM", version 2
        0x00, 0x00, 0x03, 0x00, // from a robot, team home, number 3, module world model
        0x02, 0x00, 0x00, 0x00, // to a team, home, (no number,) module world model
        0x02, 0x01, 0x00, 0x00, // the source's message 258
        0x14, 0x00, 0x00, 0x00, // of 20 bytes
        0x01, 0x00,             // a position
    ];
    let first = [0x00, 0x00, 0x02, 0x00, 0x10, 0x00]; // fragment 0 of 2, its piece has 16 bytes
    let second = [0x01, 0x00, 0x02, 0x00, 0x04, 0x00]; // fragment 1 of 2, its piece has 4 bytes
    let golden = [[&head[..], &first, &data[..16]].concat(), [&head[..], &second, &data[16..]].concat()];
    assert_eq!(cut(&message, 258, 44).unwrap(), golden);
    assert_eq!(assembled(&mut assembly(), &golden), Some(message));
}

#[test]
fn what_does_not_fit_into_the_largest_number_of_datagrams_is_refused() {
    let datagram = HEADER + 1;
    let most = usize::from(u16::MAX);
    assert_eq!(cut(&message(HOME_3, most), 0, datagram).unwrap().len(), most);
    let bytes = most + 1;
    assert_eq!(cut(&message(HOME_3, bytes), 0, datagram), Err(CannotCut::TooLarge { bytes, datagram }));
    assert_eq!(cut(&message(HOME_3, 1), 0, HEADER), Err(CannotCut::TooLarge { bytes: 1, datagram: HEADER }));
    assert_eq!(cut(&message(HOME_3, 0), 0, HEADER).unwrap().len(), 1);
    assert!(cut(&message(HOME_3, 0), 0, HEADER - 1).is_err());
    let large = cut(&message(HOME_3, 70_000), 0, usize::MAX).unwrap();
    assert_eq!(
        large.iter().map(Vec::len).collect::<Vec<_>>(),
        [LARGEST_DATAGRAM, 70_000 - LARGEST_PIECE + HEADER]
    );
}

#[test]
fn a_group_cannot_speak() {
    let bad = message(Peer::Team(1), 3);
    assert_eq!(cut(&bad, 0, 100), Err(CannotCut::Source(Peer::Team(1))));
}

#[test]
fn every_inconsistency_is_named() {
    let good = cut(&message(HOME_3, 20), 0, HEADER + 8).unwrap();
    let spoilt = |fragment: usize, changes: &[(usize, u8)]| {
        let mut bytes = good[fragment].clone();
        changes.iter().for_each(|&(place, byte)| bytes[place] = byte);
        Header::read(&bytes).err()
    };
    assert_eq!((spoilt(0, &[]), spoilt(1, &[]), spoilt(2, &[])), (None, None, None));
    assert_eq!(Header::read(&good[0][..HEADER - 1]), Err(Malformed::TooShort));
    assert_eq!(spoilt(0, &[(0, b'X')]), Some(Malformed::Magic));
    assert_eq!(spoilt(0, &[(3, VERSION - 1)]), Some(Malformed::Version));
    for (place, byte) in [(4, 1), (4, 2), (4, 3), (4, 4)] {
        // As a computer, a team or everybody, the source has a number too many.
        let expected = (byte != 1).then_some(Malformed::Source);
        assert_eq!(spoilt(0, &[(place, byte)]), expected);
    }
    assert_eq!(spoilt(0, &[(4, 1), (5, 1)]), Some(Malformed::Source));
    assert_eq!(spoilt(0, &[(8, 3), (9, 1)]), Some(Malformed::Destination));
    assert_eq!(spoilt(0, &[(8, 2), (10, 1)]), Some(Malformed::Destination));
    assert_eq!(spoilt(0, &[(24, 0)]), Some(Malformed::Index));
    assert_eq!(spoilt(2, &[(22, 3)]), Some(Malformed::Index));
    assert_eq!(spoilt(0, &[(26, 7)]), Some(Malformed::PieceLength));
    // 8 + 8 + 4 bytes are neither 16, 25 nor 20 in two or four fragments, and the last of three brings no 8.
    for change in [(16, 16), (16, 25), (24, 2), (24, 4), (22, 2)] {
        assert_eq!(spoilt(0, &[change]), Some(Malformed::Total), "{change:?}");
    }
    assert_eq!(spoilt(2, &[(16, 21)]), Some(Malformed::Total));
    let longer = [&good[0][..], &[0]].concat();
    assert_eq!(Header::read(&longer), Err(Malformed::PieceLength));
}

fn any_message() -> impl Strategy<Value = (ExternalMessage, usize)> {
    let one = prop_oneof![
        any::<(u8, u8)>().prop_map(|(team, number)| Peer::Robot { team, number }),
        any::<u8>().prop_map(Peer::Computer),
    ];
    let group = prop_oneof![any::<u8>().prop_map(Peer::Team), Just(Peer::Everybody)];
    let data = prop::collection::vec(any::<u8>(), 0..300);
    (one.clone(), prop_oneof![one, group], any::<(u8, u8, u16)>(), data, 1usize..64).prop_map(
        |(source, destination, (from, to, data_type), data, piece)| {
            let source = Address { peer: source, module: Module(from) };
            let destination = Address { peer: destination, module: Module(to) };
            (ExternalMessage { source, destination, data_type: DataType(data_type), data }, piece)
        },
    )
}

proptest! {
    #[test]
    fn messages_survive_shuffling_doubling_and_interleaving(
        messages in prop::collection::vec(any_message(), 1..8),
        first_counter: u32,
        order in prop::collection::vec(any::<Index>(), 0..600),
        doubles in prop::collection::vec(any::<Index>(), 0..40),
    ) {
        let counter = |place: usize| first_counter.wrapping_add(place as u32);
        let mut datagrams: Vec<Vec<u8>> = Vec::new();
        for (place, (message, piece)) in messages.iter().enumerate() {
            let cut = cut(message, counter(place), HEADER + piece).unwrap();
            prop_assert!(cut.iter().all(|datagram| datagram.len() <= HEADER + piece));
            datagrams.extend(cut);
        }
        // A message in a single datagram comes as often as that does.
        let fragments = |datagram: &Vec<u8>| Header::read(datagram).unwrap().0.count;
        let doubled: Vec<_> = doubles.iter().map(|double| double.get(&datagrams).clone()).collect();
        datagrams.extend(doubled.into_iter().filter(|datagram| fragments(datagram) > 1));
        for (place, other) in order.iter().enumerate().take(datagrams.len()) {
            let other = other.index(datagrams.len());
            datagrams.swap(place, other);
        }
        let mut assembly = assembly();
        let arrived = datagrams.iter().filter_map(|datagram| assembly.accept(3, datagram).unwrap());
        let mut arrived: Vec<ExternalMessage> = arrived.collect();
        let mut sent: Vec<ExternalMessage> = messages.into_iter().map(|(message, _)| message).collect();
        arrived.sort();
        sent.sort();
        prop_assert_eq!(arrived, sent);
        prop_assert_eq!(assembly.in_assembly().len(), 0);
    }

    #[test]
    fn what_is_read_is_written_the_same_way(bytes in prop::collection::vec(any::<u8>(), 0..80), valid: bool) {
        let mut bytes = bytes;
        if valid && bytes.len() >= HEADER {
            bytes[..4].copy_from_slice(b"TCM\x02");
            let piece = (bytes.len() - HEADER) as u16;
            bytes[26..28].copy_from_slice(&piece.to_le_bytes());
        }
        if let Ok((header, piece)) = Header::read(&bytes) {
            prop_assert_eq!(header.datagram(piece), bytes);
        }
    }
}
