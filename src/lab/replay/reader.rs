//! Reading a replay.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::block::{Block, Bookmark};
use super::frame::{self, Framed};
use super::header::{Plans, ReplayHeader};
use crate::data::DataError;
use crate::game::MatchPlan;
use crate::game::record::TickTrace;
use crate::game::requests::Request;

/// Behind it, on the first line, comes the version of the program.
const MAGIC: &str = "touchline replay ";
/// No recording is longer, bytes: a match of 20 minutes takes one or two million.
const LONGEST: u64 = 256 << 20;

/// The first line of a file.
pub(super) fn first_line() -> String {
    format!("{MAGIC}{}\n", env!("CARGO_PKG_VERSION"))
}

/// A recorded match.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// Where it was read from.
    pub path: PathBuf,
    /// What it was played from.
    pub header: ReplayHeader,
    pub(super) blocks: Vec<Block>,
    /// Whether the recording ended as it should, rather than with the program.
    pub is_whole: bool,
}

impl Replay {
    /// Whether a file begins as a replay does.
    pub fn is_at(path: &Path) -> bool {
        let mut start = [0; MAGIC.len()];
        let read = File::open(path).and_then(|mut file| file.read_exact(&mut start));
        read.is_ok() && start == *MAGIC.as_bytes()
    }

    /// Reads a file.
    ///
    /// # Errors
    /// If it is no replay, one of another version of the program, or damaged. One that was cut off is read as far as it goes.
    pub fn read(path: &Path) -> Result<Replay, DataError> {
        let unread = |error: io::Error| fault(path, format!("cannot be read: {error}"));
        if path.is_dir() {
            return Err(fault(path, "is a folder, not a file"));
        }
        let (mut file, mut bytes) = (File::open(path).map_err(unread)?, Vec::new());
        file.by_ref().take(MAGIC.len() as u64).read_to_end(&mut bytes).map_err(unread)?;
        // What does not begin as a recording is not read on.
        if bytes == MAGIC.as_bytes() {
            file.take(LONGEST).read_to_end(&mut bytes).map_err(unread)?;
        }
        if bytes.len() as u64 > LONGEST {
            return Err(fault(path, format!("is longer than {} MB", LONGEST >> 20)));
        }
        Replay::from_bytes(path, &bytes)
    }

    /// Reads what a file holds.
    ///
    /// # Errors
    /// As [`Replay::read`].
    pub fn from_bytes(path: &Path, bytes: &[u8]) -> Result<Replay, DataError> {
        let rest = after_first_line(bytes).map_err(|message| fault(path, message))?;
        let (header, mut rest) = match frame::read::<ReplayHeader>(rest) {
            Framed::Whole(header, rest) => (header, rest),
            Framed::CutOff => return Err(fault(path, "is cut off before the match begins")),
            Framed::Damaged => return Err(fault(path, "is damaged before the match begins")),
        };
        let mut replay = Replay { path: path.to_owned(), header, blocks: Vec::new(), is_whole: false };
        while !rest.is_empty() && !replay.is_whole {
            match frame::read::<Block>(rest) {
                Framed::Whole(block, behind) => {
                    (replay.is_whole, rest) = (block.is_last, behind);
                    replay.blocks.push(block);
                }
                Framed::CutOff => break,
                Framed::Damaged => {
                    return Err(fault(path, format!("is damaged after tick {}", replay.ticks())));
                }
            }
        }
        Ok(replay)
    }

    /// The match and the scenario that it belongs to, with the recorded requests as its script.
    ///
    /// # Errors
    /// The first fault of the files in it: they were read by another program.
    pub fn plans(&self) -> Result<Plans, DataError> {
        let (mut plan, scenario) = self.header.recorded.plans(&self.header.assets())?;
        plan.script = self.requests(&plan)?;
        Ok((plan, scenario))
    }

    fn requests(&self, plan: &MatchPlan) -> Result<Vec<(u64, Request)>, DataError> {
        let kept = self.blocks.iter().flat_map(|block| &block.requests);
        kept.map(|(tick, request)| Ok((*tick, request.request(plan)?))).collect()
    }

    /// How many ticks were recorded.
    pub fn ticks(&self) -> u64 {
        self.blocks.iter().map(|block| block.traces.len()).sum()
    }

    /// The digest at its end.
    pub fn digest(&self) -> Option<u64> {
        self.blocks.last().map(|block| block.digest)
    }

    /// What people noted, by tick: of each the last note, unless that is empty.
    pub fn bookmarks(&self) -> Vec<Bookmark> {
        let all = self.blocks.iter().flat_map(|block| &block.bookmarks);
        let last: BTreeMap<u64, &Bookmark> = all.map(|bookmark| (bookmark.tick, bookmark)).collect();
        last.into_values().filter(|bookmark| !bookmark.note.is_empty()).cloned().collect()
    }

    /// The traces of all ticks.
    pub(super) fn traces(&self) -> impl Iterator<Item = (TickTrace, &Block, bool)> {
        self.blocks.iter().flat_map(|block| {
            let ticks = block.traces.len();
            (0..ticks)
                .filter_map(move |tick| Some((block.traces.get(tick as usize)?, block, tick + 1 == ticks)))
        })
    }
}

/// What comes after the first line, if that is of this version.
fn after_first_line(bytes: &[u8]) -> Result<&[u8], String> {
    let no_replay = || "is not a replay".to_owned();
    let rest = bytes.strip_prefix(MAGIC.as_bytes()).ok_or_else(no_replay)?;
    let end = rest.iter().take(100).position(|byte| *byte == b'\n').ok_or_else(no_replay)?;
    let version = String::from_utf8_lossy(&rest[..end]);
    if version == env!("CARGO_PKG_VERSION") {
        return Ok(&rest[end + 1..]);
    }
    let ours = env!("CARGO_PKG_VERSION");
    Err(format!("was recorded by version {version}, and this is version {ours}"))
}

fn fault(path: &Path, message: impl Into<String>) -> DataError {
    DataError::new(path, message)
}
