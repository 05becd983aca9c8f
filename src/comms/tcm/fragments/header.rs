//! The header of a datagram.

use binrw::io::Cursor;
use binrw::{BinRead, BinWrite, binrw};

use crate::comms::tcm::external_message::{Address, DataType, Module, Peer};

/// The length of a header, bytes.
pub const HEADER: usize = 28;

/// The largest datagram that UDP over IPv4 can carry, bytes.
pub const LARGEST_DATAGRAM: usize = 65_507;

/// The largest piece in a datagram, bytes.
pub(super) const LARGEST_PIECE: usize = LARGEST_DATAGRAM - HEADER;

/// The first bytes of every datagram.
pub const MAGIC: [u8; 3] = *b"TCM";
/// The version of the layout, the byte after the magic.
pub const VERSION: u8 = 2;

/// What a datagram tells about its message and about its own piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Header {
    /// The sender.
    pub source: Address,
    /// The receiver, perhaps a group.
    pub destination: Address,
    /// How the data are to be read.
    pub data_type: DataType,
    /// Tells the message from others of the same source. May wrap around.
    pub counter: u32,
    /// The length of the whole message's data, bytes.
    pub total: u32,
    /// The place of this fragment, counted from 0.
    pub index: u16,
    /// The number of fragments, at least 1.
    pub count: u16,
}

/// Why bytes are not a datagram of the TCM. If there are several reasons, the first of these counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, thiserror::Error)]
pub enum Malformed {
    /// It is shorter than a header.
    #[error("shorter than a header")]
    TooShort,
    /// It does not begin with the magic bytes.
    #[error("not of the TCM")]
    Magic,
    /// Its version is unknown.
    #[error("another version")]
    Version,
    /// Its source is no robot or computer.
    #[error("an unknown kind of source, or a group")]
    Source,
    /// Its destination is nobody.
    #[error("an unknown kind of destination")]
    Destination,
    /// Its index is not below its count.
    #[error("no such fragment")]
    Index,
    /// Its piece has another length than it says.
    #[error("the piece's length is not that of the rest")]
    PieceLength,
    /// Its total, index, count and piece length contradict each other.
    #[error("the piece does not fit the message's length")]
    Total,
}

/// The header as it crosses the network.
#[binrw]
#[brw(little)]
struct WireHeader {
    magic: [u8; 3],
    version: u8,
    source: WireAddress,
    destination: WireAddress,
    counter: u32,
    total: u32,
    data_type: u16,
    index: u16,
    count: u16,
    piece: u16,
}

#[binrw]
#[brw(little)]
#[derive(Clone, Copy)]
struct WireAddress {
    kind: u8,
    team: u8,
    number: u8,
    module: u8,
}

impl Header {
    /// The header at the beginning of a datagram, and the piece after it.
    ///
    /// # Errors
    /// If anything in it contradicts the format, the rest of the header or the datagram's length.
    pub fn read(bytes: &[u8]) -> Result<(Header, &[u8]), Malformed> {
        let (head, piece) = bytes.split_at_checked(HEADER).ok_or(Malformed::TooShort)?;
        let wire = WireHeader::read(&mut Cursor::new(head)).map_err(|_| Malformed::TooShort)?;
        if wire.magic != MAGIC {
            return Err(Malformed::Magic);
        }
        if wire.version != VERSION {
            return Err(Malformed::Version);
        }
        let source = wire.source.address().filter(|source| source.peer.is_one()).ok_or(Malformed::Source)?;
        let header = Header {
            source,
            destination: wire.destination.address().ok_or(Malformed::Destination)?,
            data_type: DataType(wire.data_type),
            counter: wire.counter,
            total: wire.total,
            index: wire.index,
            count: wire.count,
        };
        if header.index >= header.count {
            return Err(Malformed::Index);
        }
        if usize::from(wire.piece) != piece.len() {
            return Err(Malformed::PieceLength);
        }
        header.step(piece.len()).ok_or(Malformed::Total)?;
        Ok((header, piece))
    }

    /// A datagram with this header and piece. The piece has to be the one that the header tells of; otherwise
    /// [`Header::read`] refuses what comes out.
    pub fn datagram(&self, piece: &[u8]) -> Vec<u8> {
        let wire = WireHeader {
            magic: MAGIC,
            version: VERSION,
            source: WireAddress::new(self.source),
            destination: WireAddress::new(self.destination),
            counter: self.counter,
            total: self.total,
            data_type: self.data_type.0,
            index: self.index,
            count: self.count,
            piece: u16::try_from(piece.len()).unwrap_or(u16::MAX),
        };
        let mut datagram = Cursor::new(Vec::with_capacity(HEADER + piece.len()));
        // Writing numbers into a growing vector does not fail.
        let written = wire.write(&mut datagram);
        debug_assert!(written.is_ok());
        let mut datagram = datagram.into_inner();
        datagram.extend_from_slice(piece);
        datagram
    }

    /// How many bytes each fragment but the last brings, if this one brings `piece`; `None` if no such message has such a
    /// fragment.
    pub(super) fn step(&self, piece: usize) -> Option<usize> {
        let total = usize::try_from(self.total).ok()?;
        let others = usize::from(self.count).checked_sub(1)?;
        if others == 0 {
            return (piece == total && piece <= LARGEST_PIECE).then_some(piece);
        }
        let is_last = usize::from(self.index) == others;
        let step = if is_last { total.checked_sub(piece)? / others } else { piece };
        let last = total.checked_sub(step.checked_mul(others)?)?;
        let mine = if is_last { last } else { step };
        (mine == piece && (1..=step).contains(&last) && step <= LARGEST_PIECE).then_some(step)
    }
}

impl WireAddress {
    fn new(address: Address) -> WireAddress {
        let (kind, team, number) = match address.peer {
            Peer::Robot { team, number } => (0, team, number),
            Peer::Computer(number) => (1, 0, number),
            Peer::Team(team) => (2, team, 0),
            Peer::Everybody => (3, 0, 0),
        };
        WireAddress { kind, team, number, module: address.module.0 }
    }

    /// `None` for an unknown kind, or for a number where there is nothing to number.
    fn address(self) -> Option<Address> {
        let peer = match (self.kind, self.team, self.number) {
            (0, team, number) => Peer::Robot { team, number },
            (1, 0, number) => Peer::Computer(number),
            (2, team, 0) => Peer::Team(team),
            (3, 0, 0) => Peer::Everybody,
            _ => return None,
        };
        Some(Address { peer, module: Module(self.module) })
    }
}

impl Malformed {
    /// All reasons, in their order.
    pub const ALL: [Malformed; 8] = [
        Malformed::TooShort,
        Malformed::Magic,
        Malformed::Version,
        Malformed::Source,
        Malformed::Destination,
        Malformed::Index,
        Malformed::PieceLength,
        Malformed::Total,
    ];

    /// The place of this reason in [`Malformed::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }
}
