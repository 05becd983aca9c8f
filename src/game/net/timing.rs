//! How the time of a network meets the ticks of a match.

use std::time::SystemTime;

/// The datagrams that a tick takes from a socket at most when it waits for nobody: a flood does not stop a match.
pub(super) const DATAGRAMS_A_TICK: usize = 128;

/// When a robot sent a datagram. It stands before each datagram of the TCM between two robots of a match, so that none is heard
/// in the tick in which it was sent, however fast the network is, and none that belongs to another match.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Stamp {
    /// Of the match, as it was introduced.
    pub session: u32,
    pub tick: u64,
}

/// The first bytes of a stamp.
const MAGIC: [u8; 4] = *b"TICK";

impl Stamp {
    /// The bytes that cross the network: the magic, session and tick, little-endian, and the datagram.
    pub fn before(self, datagram: &[u8]) -> Vec<u8> {
        [&MAGIC[..], &self.session.to_le_bytes(), &self.tick.to_le_bytes(), datagram].concat()
    }

    /// The stamp, if there is one, and the datagram.
    pub fn split(bytes: &[u8]) -> (Option<Stamp>, &[u8]) {
        let stamp = || {
            let rest = bytes.strip_prefix(&MAGIC)?;
            let (session, rest) = rest.split_first_chunk()?;
            let (tick, rest) = rest.split_first_chunk()?;
            Some((Stamp { session: u32::from_le_bytes(*session), tick: u64::from_le_bytes(*tick) }, rest))
        };
        stamp().map_or((None, bytes), |(stamp, rest)| (Some(stamp), rest))
    }
}

/// A number that the last process at this place has not used, for counting on from: milliseconds on the wall's clock.
pub(super) fn unused_number() -> u32 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    since.map_or(0, |since| since.as_millis() as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stamp_has_these_bytes_and_comes_off_again() {
        let stamp = Stamp { session: 0x0102, tick: 0x0304 };
        let bytes = stamp.before(b"TCM...");
        assert_eq!(bytes, b"TICK\x02\x01\0\0\x04\x03\0\0\0\0\0\0TCM...");
        assert_eq!(Stamp::split(&bytes), (Some(stamp), &b"TCM..."[..]));
    }

    #[test]
    fn what_has_no_whole_stamp_stays_as_it_is() {
        for bytes in [&b"TCM..."[..], b"", b"TICK", b"TICK\x02\x01\0\0\x04\x03\0\0\0\0\0"] {
            assert_eq!(Stamp::split(bytes), (None, bytes));
        }
    }
}
