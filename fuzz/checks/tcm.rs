//! What must hold of the TCM whatever arrives. The fuzz targets call it with new inputs, the tests with those in the corpus.
#![allow(dead_code, reason = "each fuzz target calls one of these")]

use std::fmt::Debug;

use touchline::comms::tcm::Data;
use touchline::comms::tcm::external_message::{Address, DataType, ExternalMessage, Module, Peer};
use touchline::comms::tcm::fragments::{Assembly, HEADER, Header, Limits, cut};
use touchline::game::net::chaos::{CameraData, ChaosOrder, DebugData, ImageData, OrderAnswer};

const LIMITS: Limits = Limits { messages: 4, bytes: 16_000, message_bytes: 4_000, timeout: 8 };

/// Takes an input for datagrams: each is a byte for the ticks that pass before it, a byte for its length, and its bytes, of
/// which those that are the same for all datagrams are left out.
pub fn datagrams(input: &[u8]) {
    let mut assembly = Assembly::new(LIMITS);
    let (mut now, mut rest) = (0, input);
    while let [wait, length, after @ ..] = rest {
        let (bytes, after) = after.split_at(usize::from(*length).min(after.len()));
        rest = after;
        now += u64::from(wait % 16);
        if wait % 5 == 0 {
            assembly.expire(now);
        }
        let datagram = [b"TCM\x02", bytes].concat();
        let before = total(&assembly);
        let accepted = assembly.accept(now, &datagram);
        assert!(assembly.memory() <= LIMITS.memory());
        assert!(assembly.in_assembly().len() <= LIMITS.messages);
        for one in assembly.in_assembly() {
            assert!(
                one.have > 0 && one.have < one.of && one.bytes >= usize::from(one.have) && one.since <= now
            );
        }
        assert!(total(&assembly) > before, "every datagram is counted");
        match accepted {
            Ok(Some(message)) => {
                assert!(message.data.len() <= LIMITS.message_bytes && message.source.peer.is_one());
                let counter = Header::read(&datagram).map(|(header, _)| header.counter);
                survives(&message, counter.unwrap_or_default(), datagram.len());
            }
            Ok(None) => assert!(Header::read(&datagram).is_ok_and(|(header, _)| header.count > 1)),
            Err(refused) => assert!(!refused.to_string().is_empty()),
        }
    }
    assembly.expire(now + LIMITS.timeout);
    assembly.expire(now + 2 * LIMITS.timeout);
    assert_eq!(assembly.memory(), 0);
}

/// All that an assembly has counted, with what arrived for unfinished messages.
fn total(assembly: &Assembly) -> u64 {
    let counted = assembly.counters();
    let messages =
        counted.single + counted.completed + counted.expired + counted.evicted + counted.contradictory;
    let datagrams = counted.duplicate + counted.late + counted.too_large + counted.malformed_in_all();
    let over = 100_000 * (messages + datagrams);
    over + assembly.in_assembly().map(|one| u64::from(one.have)).sum::<u64>()
}

/// Takes an input for a datagram.
pub fn header(input: &[u8]) {
    if let Ok((header, piece)) = Header::read(input) {
        assert_eq!(header.datagram(piece), input);
        assert!(header.index < header.count && header.source.peer.is_one());
        assert!(piece.len() <= header.total as usize && piece.len() + HEADER == input.len());
        if header.count == 1 {
            let arrived = Assembly::new(LIMITS).accept(0, input);
            assert_eq!(arrived.is_ok(), piece.len() <= LIMITS.message_bytes);
        }
    }
}

/// Takes an input for a message, how it is cut, and the order in which its datagrams arrive; and for an entity's name.
pub fn external_message(input: &[u8]) {
    if let Ok(text) = std::str::from_utf8(input)
        && let Ok(peer) = text.parse::<Peer>()
    {
        assert_eq!(peer.to_string().parse(), Ok(peer));
    }
    let Some(([kind, team, number, module, to, data_type, piece, step], data)) = input.split_first_chunk()
    else {
        return;
    };
    let peer = |kind: u8| match kind % 4 {
        0 => Peer::Robot { team: *team, number: *number },
        1 => Peer::Computer(*number),
        2 => Peer::Team(*team),
        _ => Peer::Everybody,
    };
    let message = ExternalMessage {
        source: Address { peer: peer(*kind), module: Module(*module) },
        destination: Address { peer: peer(kind / 4), module: Module(*to) },
        data_type: DataType(u16::from(*data_type) * 256),
        data: data.to_vec(),
    };
    let Ok(datagrams) = cut(&message, u32::MAX, HEADER + usize::from(*piece)) else {
        assert!(!message.source.peer.is_one() || (*piece == 0 && !data.is_empty()));
        return;
    };
    let mut assembly = Assembly::new(Limits::default());
    let mut arrived = Vec::new();
    for place in 0..datagrams.len() {
        // Twice the same, then a step on; a step that is no divisor visits all.
        let place = (place * (usize::from(*step) + 1)) % datagrams.len();
        for datagram in [&datagrams[place], &datagrams[place]].into_iter().take(datagrams.len().min(2)) {
            arrived.extend(assembly.accept(0, datagram).unwrap());
        }
    }
    for datagram in &datagrams[..if arrived.is_empty() { datagrams.len() } else { 0 }] {
        arrived.extend(assembly.accept(0, datagram).unwrap());
    }
    assert_eq!(arrived, [message]);
}

/// Takes an input for what ChaosManager and robots say to each other: a byte for the type, then the data.
pub fn chaos_data(input: &[u8]) {
    let Some((data_type, bytes)) = input.split_first() else { return };
    let data_type = DataType((*data_type).into());
    if let Some(image) = comes_back::<ImageData>(data_type, bytes) {
        let picture = image.image();
        assert_eq!(picture.pixels.len(), picture.width * picture.height);
    }
    comes_back::<CameraData>(data_type, bytes);
    comes_back::<DebugData>(data_type, bytes);
    comes_back::<OrderAnswer>(data_type, bytes);
    comes_back::<ChaosOrder>(data_type, bytes);
}

/// The data in these bytes, which are the same after they have been written and read again.
fn comes_back<T: Data + PartialEq + Debug>(data_type: DataType, bytes: &[u8]) -> Option<T> {
    let data = T::unserialise(data_type, bytes)?;
    let (known, written) = data.serialise();
    assert_eq!((known.number, T::unserialise(data_type, &written).as_ref()), (data_type, Some(&data)));
    Some(data)
}

/// A message that has arrived can be sent on in datagrams of another size.
fn survives(message: &ExternalMessage, counter: u32, datagram: usize) {
    let Ok(datagrams) = cut(message, counter, datagram) else { return };
    let mut assembly = Assembly::new(Limits { message_bytes: LIMITS.message_bytes, ..Limits::default() });
    let arrived = datagrams.iter().filter_map(|datagram| assembly.accept(0, datagram).unwrap());
    assert!(arrived.eq([message.clone()]));
}
