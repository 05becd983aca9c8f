//! Frames: a length, a checksum and compressed data, so that a file that was cut off is told from one that was damaged.

use std::io::{self, Read, Write};

use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use serde::Serialize;
use serde::de::DeserializeOwned;
use xxhash_rust::xxh3::xxh3_64;

/// Bytes of a frame before its data.
const HEAD: usize = 8;

/// No frame is longer, compressed or not.
const LONGEST: usize = 64 << 20;

/// A value as a frame.
///
/// # Errors
/// If it is too long.
pub(super) fn write(value: &impl Serialize) -> io::Result<Vec<u8>> {
    let plain = postcard::to_stdvec(value).map_err(io::Error::other)?;
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(&plain)?;
    let data = encoder.finish()?;
    if plain.len() > LONGEST {
        return Err(io::Error::other("too much for one frame"));
    }
    let head = [data.len() as u32, checksum(&data)];
    Ok(head.into_iter().flat_map(u32::to_le_bytes).chain(data).collect())
}

/// What stands at the beginning of some bytes.
pub(super) enum Framed<'a, T> {
    /// A value, and the bytes behind it.
    Whole(T, &'a [u8]),
    /// Less than a frame.
    CutOff,
    /// No frame, or one that holds something else.
    Damaged,
}

/// Reads the frame at the beginning of some bytes.
pub(super) fn read<T: DeserializeOwned>(bytes: &[u8]) -> Framed<'_, T> {
    let Some((head, rest)) = bytes.split_at_checked(HEAD) else { return Framed::CutOff };
    let word = |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
    let (length, sum) = (word(0) as usize, word(4));
    if length > LONGEST {
        return Framed::Damaged;
    }
    let Some((data, rest)) = rest.split_at_checked(length) else { return Framed::CutOff };
    let mut plain = Vec::new();
    let inflated = DeflateDecoder::new(data).take(LONGEST as u64).read_to_end(&mut plain);
    match postcard::from_bytes(&plain) {
        Ok(value) if checksum(data) == sum && inflated.is_ok() => Framed::Whole(value, rest),
        _ => Framed::Damaged,
    }
}

fn checksum(data: &[u8]) -> u32 {
    xxh3_64(data) as u32
}
