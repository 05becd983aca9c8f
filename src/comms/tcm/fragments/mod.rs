//! Messages as datagrams (TeamChaos, section 3): one that does not fit into a datagram is cut into pieces at its source and
//! put together again at its destination. Nothing is acknowledged and nothing is sent twice.
//!
//! A datagram is a [`Header`] of [`HEADER`] bytes and a piece of the data. Its layout, byte by byte, is in
//! `docs/tcm.md`. All fragments of a message but the last bring equally much, so that each tells its own place.

mod assembly;
mod header;
mod limits;

use crate::comms::tcm::external_message::{ExternalMessage, Peer};

pub use assembly::{Assembly, AssemblyCounters, Refused, Unfinished};
pub use header::{HEADER, Header, LARGEST_DATAGRAM, MAGIC, Malformed, VERSION};
pub use limits::Limits;

/// A datagram that crosses usual networks without being cut up again by IP, bytes.
pub const USUAL_DATAGRAM: usize = 1_400;

/// Why a message cannot be sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum CannotCut {
    /// Its data, or for the smallest datagrams even a header, do not fit into as many datagrams as a message may have.
    #[error("a message of {bytes} bytes is too large for datagrams of {datagram} bytes")]
    TooLarge { bytes: usize, datagram: usize },
    /// A team and everybody can be spoken to but cannot speak.
    #[error("a message cannot come from {0}")]
    Source(Peer),
}

/// The datagrams of a message, in their order. `counter` tells it from the other messages of its source; `datagram`
/// is the size that none exceeds, bytes.
///
/// # Errors
/// If it needs more than 65535 datagrams, or its source is a group.
pub fn cut(message: &ExternalMessage, counter: u32, datagram: usize) -> Result<Vec<Vec<u8>>, CannotCut> {
    let too_large = CannotCut::TooLarge { bytes: message.data.len(), datagram };
    if !message.source.peer.is_one() {
        return Err(CannotCut::Source(message.source.peer));
    }
    let room = datagram.min(LARGEST_DATAGRAM).checked_sub(HEADER).ok_or(too_large)?;
    let total = u32::try_from(message.data.len()).map_err(|_| too_large)?;
    let count = if message.data.len() <= room {
        1
    } else {
        let count = message.data.len().checked_next_multiple_of(room).ok_or(too_large)? / room;
        u16::try_from(count).map_err(|_| too_large)?
    };
    let header = |index| Header {
        source: message.source,
        destination: message.destination,
        data_type: message.data_type,
        counter,
        total,
        index,
        count,
    };
    if count == 1 {
        return Ok(vec![header(0).datagram(&message.data)]);
    }
    Ok((0..count)
        .zip(message.data.chunks(room))
        .map(|(index, piece)| header(index).datagram(piece))
        .collect())
}

#[cfg(test)]
mod tests;
