//! Plays a stretch of a match, as it was and with one thing changed.

use std::collections::BTreeMap;

use super::candidates::Candidate;
use super::standing::MatchStanding;
use crate::game::requests::{Request, Script};
use crate::game::{Match, MatchPlan};
use crate::state::Snapshot;

/// A stretch of a match, with copies of it to begin at.
pub(super) struct ReplayedStretch<'a> {
    pub plan: &'a MatchPlan,
    /// Its last tick.
    pub at: u64,
    pub snapshots: BTreeMap<u64, Snapshot>,
}

/// Ticks between two copies.
pub(super) const SPACING: u64 = 60;

impl ReplayedStretch<'_> {
    /// What the match comes to from a tick on, with a change and with dice that are stirred in that tick, in the world of another
    /// play of it; none if the match does not reach its end.
    pub fn play(
        &self,
        game: &mut Match,
        from: u64,
        change: Option<&Candidate>,
        stirred: Option<u64>,
    ) -> Option<MatchStanding> {
        let (begun, snapshot) = self.snapshots.range(..=from).next_back()?;
        snapshot.restore(game.world_mut()).ok()?;
        let dt = game.clock().dt;
        let mut script =
            change.map_or_else(|| self.plan.script.clone(), |it| it.applied(&self.plan.script, dt));
        script.retain(|(tick, _)| tick >= begun);
        script.extend(stirred.map(|salt| (from, Request::StirDice(salt))));
        game.world_mut().insert_resource(Script::new(&script));
        while game.clock().tick <= self.at {
            game.tick();
        }
        Some(MatchStanding::of(game.world_mut()))
    }
}
