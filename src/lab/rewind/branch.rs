//! One way that a match has taken.

use std::collections::{BTreeMap, VecDeque};

use super::events::MatchEvent;
use super::keyframes::Keyframes;
use super::log::LoggedRequest;
use super::track::Track;

/// The number of a branch, in the order in which they began. The first is the match as it was played at first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BranchId(pub usize);

/// One way that a match has taken, from where it left another.
pub struct Branch {
    /// The branch that it left, none for the first.
    pub parent: Option<BranchId>,
    /// What was done otherwise, in a few words.
    pub name: String,
    /// The first tick that it does not share with the other.
    pub from: u64,
    /// The first tick that has not been played in it.
    pub end: u64,
    /// Where everybody was.
    pub track: Track,
    /// What happened in its own ticks, oldest first.
    pub events: Vec<MatchEvent>,
    /// Notes of people by tick.
    pub bookmarks: BTreeMap<u64, String>,
    /// The requests of its own ticks.
    pub(super) log: Vec<LoggedRequest>,
    /// What is to be asked for in ticks to come: by a script, or since it was asked for in the branch that it left.
    pub(super) planned: VecDeque<LoggedRequest>,
    pub(super) keyframes: Keyframes,
}

impl Branch {
    pub(super) fn new(parent: Option<BranchId>, name: String, from: u64) -> Branch {
        // The moment at which it leaves another is of that one.
        let first = from + u64::from(parent.is_some());
        Branch {
            parent,
            name,
            from,
            end: from,
            track: Track::starting(first),
            events: Vec::new(),
            bookmarks: BTreeMap::new(),
            log: Vec::new(),
            planned: VecDeque::new(),
            keyframes: Keyframes::default(),
        }
    }

    /// The requests of its own ticks, in the order in which they were carried out.
    pub fn requests(&self) -> &[LoggedRequest] {
        &self.log
    }

    /// Its copies of the match.
    pub fn keyframes(&self) -> &Keyframes {
        &self.keyframes
    }

    pub(super) fn requests_of(&self, tick: u64) -> &[LoggedRequest] {
        let begin = self.log.partition_point(|made| made.tick < tick);
        let length = self.log[begin..].partition_point(|made| made.tick == tick);
        &self.log[begin..begin + length]
    }

    pub(super) fn take_planned(&mut self, tick: u64) -> Vec<LoggedRequest> {
        let due = |made: &mut LoggedRequest| made.tick <= tick;
        std::iter::from_fn(|| self.planned.pop_front_if(due)).collect()
    }
}
