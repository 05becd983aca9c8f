//! Writes a replay while the match is played.

use std::fs::File;
use std::io::{self, Write};
use std::mem::take;
use std::path::Path;

use bevy::prelude::*;

use super::block::{Block, Bookmark, KeptRequest};
use super::frame;
use super::header::ReplayHeader;
use super::reader::{Replay, first_line};
use super::states::hashes;
use crate::clock::{Clock, TICK_HZ};
use crate::game::record::{Record, TickTrace};
use crate::game::requests::Requests;

/// Seconds between two hashes of all state: those take a few milliseconds.
const STATES_EVERY: u64 = 10;

/// Writes a replay while the match is played.
#[derive(Resource, Debug)]
pub struct Recorder {
    file: File,
    written: Replay,
    /// The second that is played.
    block: Block,
    /// How many ticks are recorded.
    ticks: u64,
}

impl Recorder {
    /// Begins a file, in place of one that is there.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn create(path: &Path, header: ReplayHeader) -> io::Result<Recorder> {
        let written = Replay { path: path.to_owned(), header, blocks: Vec::new(), is_whole: false };
        Recorder::rewrite(written)
    }

    /// Begins the file of a branch: what was recorded here before a tick, and what will be played from there on.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn branch(&self, tick: u64, path: &Path) -> io::Result<Recorder> {
        let mut replay = Replay { path: path.to_owned(), is_whole: false, ..self.written.clone() };
        replay.blocks.push(self.block.clone());
        replay.header.branched = Some(tick);
        Recorder::rewrite(replay.before(tick))
    }

    fn rewrite(mut replay: Replay) -> io::Result<Recorder> {
        let bookmarks = replay.bookmarks();
        replay.blocks.iter_mut().for_each(|block| block.bookmarks.clear());
        replay.blocks.retain(|block| block.traces.len() > 0);
        let mut bytes = first_line().into_bytes();
        bytes.extend(frame::write(&replay.header)?);
        for block in replay.blocks.iter().filter(|block| block.is_full()) {
            bytes.extend(frame::write(block)?);
        }
        let mut file = File::create(&replay.path)?;
        file.write_all(&bytes)?;
        let ticks = replay.ticks();
        let block = replay.blocks.pop_if(|block| !block.is_full()).unwrap_or_default();
        let mut recorder = Recorder { file, written: replay, block, ticks };
        bookmarks.into_iter().try_for_each(|bookmark| recorder.mark(bookmark))?;
        Ok(recorder)
    }

    /// Records the tick that was just played. One that is recorded already, as after a look back, is passed over.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn note(&mut self, world: &mut World) -> io::Result<()> {
        let tick = self.ticks;
        if world.resource::<Clock>().tick != tick + 1 {
            return Ok(());
        }
        let due = world.resource::<Requests>().due();
        self.block.requests.extend(due.map(|request| (tick, KeptRequest::of(request))));
        self.block.traces.push(&TickTrace::take(world));
        self.block.digest = world.resource::<Record>().digest;
        self.ticks += 1;
        if !self.block.is_full() {
            return Ok(());
        }
        if self.ticks.is_multiple_of(STATES_EVERY * TICK_HZ as u64) {
            self.block.states = Some(hashes(world).0);
        }
        self.write()
    }

    /// Notes something about a tick, in the file at once: time may stand still. An empty note takes the one before away.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn mark(&mut self, bookmark: Bookmark) -> io::Result<()> {
        let digest = self.written.digest().unwrap_or_default();
        self.append(Block { bookmarks: vec![bookmark], digest, ..Block::default() })
    }

    /// What was noted, by tick.
    pub fn bookmarks(&self) -> Vec<Bookmark> {
        self.written.bookmarks()
    }

    /// How many ticks are recorded.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// Where it is written.
    pub fn path(&self) -> &Path {
        &self.written.path
    }

    /// Ends the recording.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn finish(mut self) -> io::Result<()> {
        self.block.is_last = true;
        if self.block.traces.len() == 0 {
            self.block.digest = self.written.digest().unwrap_or_default();
        }
        self.write()
    }

    fn write(&mut self) -> io::Result<()> {
        let block = take(&mut self.block);
        self.append(block)
    }

    /// One frame in one call: it is in the file or it is not.
    fn append(&mut self, block: Block) -> io::Result<()> {
        let written = frame::write(&block).and_then(|bytes| self.file.write_all(&bytes));
        self.written.blocks.push(block);
        written
    }
}

impl Block {
    fn is_full(&self) -> bool {
        self.traces.len() >= TICK_HZ as u64
    }
}

impl Replay {
    /// The same up to a tick.
    fn before(mut self, tick: u64) -> Replay {
        let mut first = 0;
        for block in &mut self.blocks {
            let kept = tick.saturating_sub(first).min(block.traces.len());
            first += block.traces.len();
            if kept < block.traces.len() {
                block.traces.truncate(kept as usize);
                block.states = None;
            }
            block.is_last = false;
            block.requests.retain(|(of, _)| *of < tick);
            block.bookmarks.retain(|bookmark| bookmark.tick <= tick);
        }
        self.blocks.retain(|block| block.traces.len() > 0 || !block.bookmarks.is_empty());
        self
    }
}
