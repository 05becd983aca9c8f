use proptest::prelude::*;

use super::*;
use crate::comms::tcm::fragments::{HEADER, cut};
use crate::data::Validate;

const LIMITS: Limits = Limits { messages: 3, bytes: 6_000, message_bytes: 1_000, timeout: 10 };

fn robot(number: u8) -> Peer {
    Peer::Robot { team: 0, number }
}

fn message(from: u8, data: &[u8]) -> ExternalMessage {
    ExternalMessage {
        source: Address { peer: robot(from), module: Module::WORLD_MODEL },
        destination: Address { peer: Peer::Team(0), module: Module::WORLD_MODEL },
        data_type: DataType::FIRST_FREE,
        data: data.to_vec(),
    }
}

/// In pieces of four bytes.
fn pieces(from: u8, counter: u32, data: &[u8]) -> Vec<Vec<u8>> {
    cut(&message(from, data), counter, HEADER + 4).unwrap()
}

/// The messages that arrive, all in one tick.
fn accept<'a>(
    assembly: &mut Assembly,
    now: u64,
    datagrams: impl IntoIterator<Item = &'a Vec<u8>>,
) -> Vec<ExternalMessage> {
    datagrams.into_iter().filter_map(|datagram| assembly.accept(now, datagram).unwrap()).collect()
}

#[test]
fn a_message_in_one_datagram_passes_straight_through() {
    let mut assembly = Assembly::new(Limits { messages: 0, bytes: 0, ..LIMITS });
    let single = pieces(0, 1, b"abcd");
    assert_eq!(
        accept(&mut assembly, 0, [&single[0], &single[0]]),
        [message(0, b"abcd"), message(0, b"abcd")]
    );
    assert_eq!((assembly.memory(), assembly.counters().single), (0, 2));
    let empty = pieces(0, 2, b"");
    assert_eq!(accept(&mut assembly, 0, &empty), [message(0, b"")]);
}

#[test]
fn an_unfinished_message_tells_what_has_arrived() {
    let mut assembly = Assembly::new(LIMITS);
    let parts = pieces(2, 7, b"0123456789");
    assert_eq!(accept(&mut assembly, 5, [&parts[2], &parts[0], &parts[2]]), []);
    let unfinished = Unfinished {
        source: message(2, b"").source,
        counter: 7,
        data_type: DataType::FIRST_FREE,
        have: 2,
        of: 3,
        bytes: 6,
        since: 5,
    };
    assert_eq!(assembly.in_assembly().collect::<Vec<_>>(), [unfinished]);
    assert_eq!(assembly.counters().duplicate, 1);
    assert_eq!(accept(&mut assembly, 6, [&parts[1]]), [message(2, b"0123456789")]);
    assert_eq!(assembly.in_assembly().len(), 0);
    assert_eq!(accept(&mut assembly, 6, [&parts[0]]), []);
    assert_eq!((assembly.in_assembly().len(), assembly.counters().late), (0, 1));
}

#[test]
fn what_waits_too_long_is_given_up_and_its_last_fragments_are_ignored() {
    let mut assembly = Assembly::new(LIMITS);
    let parts = pieces(0, 1, b"01234567");
    accept(&mut assembly, 5, [&parts[0]]);
    assert_eq!((assembly.expire(14), assembly.expire(15), assembly.counters().expired), (0, 1, 1));
    assert_eq!(accept(&mut assembly, 16, &parts), []);
    assert_eq!((assembly.in_assembly().len(), assembly.counters().late), (0, 2));
    assembly.expire(25);
    assert_eq!(assembly.memory(), 0);
    assert_eq!(accept(&mut assembly, 25, &parts), [message(0, b"01234567")]);
}

#[test]
fn a_fragment_that_comes_too_late_completes_nothing_although_nobody_called_expire() {
    let mut assembly = Assembly::new(LIMITS);
    let parts = pieces(0, 1, b"01234567");
    accept(&mut assembly, 5, [&parts[0]]);
    assert_eq!(accept(&mut assembly, 15, [&parts[1]]), []);
    assert_eq!((assembly.counters().expired, assembly.counters().late), (1, 1));
}

#[test]
fn where_a_place_is_missing_the_oldest_goes() {
    let mut assembly = Assembly::new(LIMITS);
    let parts: Vec<_> = (0..4).map(|from| pieces(from, 1, b"01234567")).collect();
    for now in [2, 0, 1, 3] {
        accept(&mut assembly, now, [&parts[now as usize][0]]);
    }
    let left: Vec<_> = assembly.in_assembly().map(|unfinished| unfinished.source.peer).collect();
    assert_eq!(left, [robot(0), robot(1), robot(3)]);
    assert_eq!(assembly.counters().evicted, 1);
    assert_eq!(accept(&mut assembly, 4, parts.iter().map(|parts| &parts[1])).len(), 3);
}

#[test]
fn who_begins_too_many_messages_loses_its_own() {
    let mut assembly = Assembly::new(LIMITS);
    let honest = pieces(0, 1, b"01234567");
    accept(&mut assembly, 0, [&honest[0]]);
    for counter in 0..50 {
        accept(&mut assembly, 1, [&pieces(1, counter, b"01234567")[0]]);
    }
    assert_eq!(assembly.counters().evicted, 48);
    assert_eq!(accept(&mut assembly, 2, [&honest[1]]), [message(0, b"01234567")]);
}

#[test]
fn where_memory_is_missing_the_oldest_goes_even_if_the_fragment_is_its_own() {
    let data = [7; 1_000];
    let datagrams = |from| cut(&message(from, &data), 1, HEADER + 200).unwrap();
    let (old, newer) = (datagrams(0), datagrams(1));
    let mut tight = Assembly::new(Limits { bytes: 2 * ENTRY_COST + 7 * (200 + PIECE_COST), ..LIMITS });
    accept(&mut tight, 0, &old[..4]);
    accept(&mut tight, 1, &newer[..3]);
    assert_eq!(tight.counters().evicted, 0);
    assert_eq!(accept(&mut tight, 2, &old[4..]), []);
    assert_eq!(tight.counters().evicted, 1);
    assert_eq!(accept(&mut tight, 2, &newer[3..]), [message(1, &data)]);
}

#[test]
fn a_message_that_contradicts_an_unfinished_one_of_the_same_counter_takes_its_place() {
    let old = pieces(0, 1, b"01234567");
    let module = ExternalMessage {
        source: Address { module: Module(9), ..message(0, b"").source },
        ..message(0, b"abcdefgh")
    };
    let to = ExternalMessage { destination: message(3, b"").source, ..message(0, b"abcdefgh") };
    let data_type = ExternalMessage { data_type: DataType::TEXT, ..message(0, b"abcdefgh") };
    let length = message(0, b"abcdefghijkl");
    let bytes = message(0, b"abcdefgh");
    for newer in [module, to, data_type, length, bytes] {
        let mut assembly = Assembly::new(LIMITS);
        accept(&mut assembly, 0, [&old[0]]);
        assert_eq!(accept(&mut assembly, 1, &cut(&newer, 1, HEADER + 4).unwrap()), [newer]);
        assert_eq!((assembly.counters().contradictory, assembly.in_assembly().len()), (1, 0));
    }
    let mut assembly = Assembly::new(LIMITS);
    accept(&mut assembly, 0, [&old[0]]);
    let finer = cut(&message(0, b"01234567"), 1, HEADER + 3).unwrap();
    assert_eq!(accept(&mut assembly, 0, &finer), [message(0, b"01234567")]);
    accept(&mut assembly, 0, [&old[0]]);
    assert_eq!(accept(&mut assembly, 0, &pieces(0, 1, b"abc")), [message(0, b"abc")]);
    assert_eq!((assembly.counters().contradictory, assembly.in_assembly().len()), (2, 0));
}

#[test]
fn messages_of_one_counter_but_several_sources_are_apart() {
    let mut assembly = Assembly::new(LIMITS);
    let (one, other) = (pieces(0, u32::MAX, b"01234567"), pieces(1, u32::MAX, b"abcdefgh"));
    let arrived = accept(&mut assembly, 0, [&one[0], &other[1], &other[0], &one[1]]);
    assert_eq!(arrived, [message(1, b"abcdefgh"), message(0, b"01234567")]);
    assert_eq!(assembly.counters().contradictory, 0);
}

#[test]
fn what_the_limits_can_never_hold_is_refused_at_its_first_fragment() {
    let mut assembly = Assembly::new(Limits { bytes: 2_500, ..LIMITS });
    let long = cut(&message(0, &[1; 1_001]), 1, HEADER + 2_000).unwrap();
    let too_large = Refused::TooLarge { bytes: 1_001, most: 1_000 };
    assert_eq!(assembly.accept(0, &long[0]), Err(too_large));
    let fine = cut(&message(0, &[1; 900]), 1, HEADER + 1).unwrap();
    assert!(matches!(assembly.accept(0, &fine[0]), Err(Refused::TooFine { fragments: 900, .. })));
    assert_eq!((assembly.counters().too_large, assembly.memory()), (2, 0));
}

#[test]
fn malformed_datagrams_are_counted_by_their_reason() {
    let mut assembly = Assembly::new(LIMITS);
    assert_eq!(assembly.accept(0, b"TCM"), Err(Refused::Malformed(Malformed::TooShort)));
    assert_eq!(assembly.accept(0, &[0; HEADER]), Err(Refused::Malformed(Malformed::Magic)));
    let counters = assembly.counters();
    assert_eq!((counters.malformed[Malformed::TooShort.index()], counters.malformed_in_all()), (1, 2));
    assert!(Malformed::ALL.iter().enumerate().all(|(place, reason)| reason.index() == place));
}

#[test]
fn limits_that_make_no_sense_are_named() {
    assert_eq!((LIMITS.validate(), Limits::default().validate()), (Ok(()), Ok(())));
    for (limits, field) in [
        (Limits { messages: 0, ..LIMITS }, "messages"),
        (Limits { timeout: 0, ..LIMITS }, "timeout"),
        (Limits { bytes: 1_000, ..LIMITS }, "bytes"),
    ] {
        assert_eq!(limits.validate().unwrap_err().field.to_string(), field);
    }
}

proptest! {
    #[test]
    fn memory_stays_within_the_limits_whatever_arrives(
        datagrams in prop::collection::vec((0u8..4, 0u32..3, 0usize..700, 1usize..200, any::<prop::sample::Index>(), 0u64..4), 0..200),
        noise in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), any::<u8>()), 0..30),
    ) {
        let mut assembly = Assembly::new(LIMITS);
        let mut now = 0;
        let mut datagrams: Vec<_> = datagrams
            .into_iter()
            .map(|(from, counter, bytes, piece, fragment, wait)| {
                let datagrams = cut(&message(from, &vec![from; bytes]), counter, HEADER + piece).unwrap();
                (fragment.get(&datagrams).clone(), wait)
            })
            .collect();
        for (datagram, place, byte) in noise {
            if !datagrams.is_empty() {
                let datagram = datagram.index(datagrams.len());
                let bytes = &mut datagrams[datagram].0;
                let place = place.index(bytes.len());
                bytes[place] = byte;
            }
        }
        for (datagram, wait) in datagrams {
            now += wait;
            let _ = assembly.accept(now, &datagram);
            prop_assert!(assembly.memory() <= LIMITS.memory());
            prop_assert!(assembly.in_assembly().len() <= LIMITS.messages);
            let bytes: usize = assembly.in_assembly().map(|unfinished| unfinished.bytes).sum();
            prop_assert!(bytes <= LIMITS.bytes);
            prop_assert!(assembly.in_assembly().all(|one| one.have > 0 && one.have < one.of));
        }
        assembly.expire(now + LIMITS.timeout);
        assembly.expire(now + 2 * LIMITS.timeout);
        prop_assert_eq!((assembly.memory(), assembly.in_assembly().len()), (0, 0));
    }
}
