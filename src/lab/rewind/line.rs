//! All ways that a match has taken, and which of them it takes now.

use std::collections::VecDeque;

use bevy::prelude::*;

use super::branch::{Branch, BranchId};
use super::events::{EventWatch, MatchEvent};
use super::keyframes::Keyframe;
use super::log::{LoggedRequest, is_of_a_seat};
use super::track::Ghost;
use crate::clock::Clock;
use crate::game::requests::Script;

/// The past of a match in a world: all branches, and the one that is played.
#[derive(Resource)]
pub struct Rewind {
    pub(super) branches: Vec<Branch>,
    pub(super) present: BranchId,
    pub(super) watch: EventWatch,
}

impl Rewind {
    /// From now on, the match in this world can go back to now. What its script has planned is asked for by
    /// [`Rewind::play`], which every further tick is to be played with.
    pub fn begin(world: &mut World) -> Rewind {
        let tick = world.resource::<Clock>().tick;
        let mut first = Branch::new(None, "as it was played".into(), tick);
        let planned = world.resource_mut::<Script>().take();
        first.planned = (planned.into_iter())
            .map(|(tick, request)| LoggedRequest { tick, request, scripted: true })
            .collect::<VecDeque<_>>();
        first.track.push(world);
        first.keyframes.insert(tick, Keyframe::take(world));
        Rewind { branches: vec![first], present: BranchId(0), watch: EventWatch::of(world) }
    }

    /// The branch that is played.
    pub fn present(&self) -> BranchId {
        self.present
    }

    /// All branches with their numbers, the oldest first.
    pub fn branches(&self) -> impl ExactSizeIterator<Item = (BranchId, &Branch)> {
        self.branches.iter().enumerate().map(|(number, branch)| (BranchId(number), branch))
    }

    /// A branch.
    pub fn branch(&self, branch: BranchId) -> &Branch {
        &self.branches[branch.0]
    }

    /// The first tick that has not been played in the present branch.
    pub fn end(&self) -> u64 {
        self.branch(self.present).end
    }

    /// The first tick to which the match can go back.
    pub fn start(&self) -> u64 {
        self.branches[0].from
    }

    /// Whether a tick of the present branch goes by what was asked for before, and not by what a person does now.
    pub fn is_known(&self, tick: u64) -> bool {
        tick < self.end()
    }

    /// Whether in a tick or later robots are driven as a person drove them before.
    pub fn drives_itself(&self, tick: u64) -> bool {
        let planned = &self.branch(self.present).planned;
        self.is_known(tick) || planned.iter().any(|made| is_of_a_seat(&made.request))
    }

    /// A branch and those that it has come from, each with the first tick after the part that counts.
    pub fn lineage(&self, branch: BranchId) -> impl Iterator<Item = (BranchId, u64)> {
        let mut next = Some((branch, self.branch(branch).end));
        std::iter::from_fn(move || {
            let (present, until) = next?;
            let Branch { parent, from, .. } = self.branch(present);
            next = parent.map(|parent| (parent, *from));
            Some((present, until))
        })
    }

    /// The branch in which a tick of a branch was played: itself, or one that it has come from.
    pub fn owner(&self, branch: BranchId, tick: u64) -> BranchId {
        let mut lineage = self.lineage(branch).map(|(branch, _)| branch);
        lineage.find(|branch| self.branch(*branch).from <= tick).unwrap_or_default()
    }

    /// The first tick that the present branch and another do not share.
    pub fn parting(&self, other: BranchId) -> u64 {
        let mine: Vec<(BranchId, u64)> = self.lineage(self.present).collect();
        let shared = self.lineage(other).find_map(|(branch, until)| {
            let (_, mine) = mine.iter().find(|(known, _)| *known == branch)?;
            Some(until.min(*mine))
        });
        shared.unwrap_or_else(|| self.start())
    }

    /// The moment of a branch at which so many ticks were over, if it has been played that far.
    pub fn ghost(&self, branch: BranchId, tick: u64) -> Option<Ghost<'_>> {
        self.lineage(branch)
            .filter(|(_, until)| tick <= *until)
            .find_map(|(id, _)| self.branch(id).track.at(tick))
    }

    /// What happened in a branch and in those that it has come from, as far as it shares their ticks; the newest part first.
    pub fn events(&self, branch: BranchId) -> impl Iterator<Item = &MatchEvent> {
        self.lineage(branch).flat_map(|(branch, until)| {
            self.branch(branch).events.iter().filter(move |event| event.tick < until)
        })
    }

    /// The nearest tick before or after another in which something happened in the present branch or which has a bookmark, and what
    /// it was. Nothing is known yet of ticks that have not been played.
    pub fn nearest_event(&self, tick: u64, ahead: bool) -> Option<(u64, String)> {
        let events = self.events(self.present).map(|event| (event.tick, event.what.to_string()));
        let notes = self.bookmarks(self.present).map(|(tick, note)| (tick, note.to_owned()));
        let all = events.chain(notes);
        if ahead {
            let known = tick + 1..=self.end();
            all.filter(|(of, _)| known.contains(of)).min_by_key(|(of, _)| *of)
        } else {
            all.filter(|(of, _)| *of < tick).max_by_key(|(of, _)| *of)
        }
    }

    /// The notes of people in a branch and in those that it has come from, with their ticks.
    pub fn bookmarks(&self, branch: BranchId) -> impl Iterator<Item = (u64, &str)> {
        self.lineage(branch).flat_map(move |(id, until)| {
            // Those of a recording may be of ticks to come.
            let until = if id == branch { u64::MAX } else { until };
            let notes = self.branch(id).bookmarks.range(..=until);
            notes.map(|(tick, note)| (*tick, note.as_str()))
        })
    }

    /// Keeps a note with a tick of the present branch; an empty one takes it away.
    pub fn set_bookmark(&mut self, tick: u64, note: String) {
        let owner = self.owner(self.present, tick.saturating_sub(1));
        let bookmarks = &mut self.branches[owner.0].bookmarks;
        if note.is_empty() {
            bookmarks.remove(&tick);
        } else {
            bookmarks.insert(tick, note);
        }
    }

    /// The requests of a branch from a tick on, those that were carried out and those that are planned.
    pub(super) fn requests_from(&self, branch: BranchId, tick: u64) -> Vec<LoggedRequest> {
        let mut parts: Vec<&[LoggedRequest]> = (self.lineage(branch))
            .map(|(id, until)| {
                let log = &self.branch(id).log;
                let of = |tick: u64| log.partition_point(|made| made.tick < tick);
                &log[of(tick).min(of(until))..of(until)]
            })
            .collect();
        parts.reverse();
        let planned = self.branch(branch).planned.iter().cloned();
        parts.into_iter().flatten().cloned().chain(planned).filter(|made| made.tick >= tick).collect()
    }
}
