//! A match as a file: what it was played from (the texts of its files, the seed, what was chosen), the requests of each tick, and
//! traces by which another play of it is compared, tick by tick.
//!
//! A [`Recorder`] writes one while a match is played; [`Replay::read`] reads it; [`Replay::plans`] gives the match once more; a
//! [`Comparison`] says where a play parts from the recorded one.
//!
//! A file begins with a line that names the version of the program. After it come frames, each a length, a checksum and
//! compressed data: first the [`ReplayHeader`], then one for every second of the match. A frame is written whole once its second is
//! over, so that a program that dies loses no more than a second.

mod block;
mod compare;
mod frame;
mod header;
mod reader;
mod recorder;
mod states;
#[cfg(test)]
mod tests;

pub use block::Bookmark;
pub use compare::{Comparison, Parting};
pub use header::{Plans, Recorded, ReplayHeader};
pub use reader::Replay;
pub use recorder::Recorder;
