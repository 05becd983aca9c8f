//! Another branch, played on beside the present one in a world of its own.

use bevy::prelude::*;

use super::branch::BranchId;
use super::events::EventWatch;
use super::line::Rewind;
use crate::clock::Clock;
use crate::game::requests::Requests;
use crate::game::{Match, MatchPlan};
use crate::state::OtherMatch;

/// A branch in a world of its own, without a window.
#[derive(Resource)]
pub struct GhostMatch {
    branch: BranchId,
    watch: EventWatch,
    world: World,
}

impl GhostMatch {
    /// Brings a branch to its last moment in a world of its own; the plan is the one that the match began with.
    ///
    /// # Errors
    /// If the plan is of another match.
    pub fn new(rewind: &mut Rewind, plan: &MatchPlan, branch: BranchId) -> Result<GhostMatch, OtherMatch> {
        let mut world = Match::new(plan).into_world();
        let end = rewind.branch(branch).end;
        let nearest =
            rewind.lineage(branch).find_map(|(id, until)| rewind.branch(id).keyframes().before(until));
        if let Some((_, keyframe)) = nearest {
            keyframe.restore(&mut world)?;
        }
        world.resource_mut::<Requests>().clear();
        let mut ghost = GhostMatch { branch, watch: EventWatch::of(&mut world), world };
        ghost.play_to(rewind, end);
        Ok(ghost)
    }

    /// The branch that it plays.
    pub fn branch(&self) -> BranchId {
        self.branch
    }

    /// Plays on until so many ticks are over. The branch is longer then, and remembers all of it.
    pub fn play_to(&mut self, rewind: &mut Rewind, tick: u64) {
        while self.world.resource::<Clock>().tick < tick {
            rewind.play_in(self.branch, &mut self.watch, &mut self.world);
            rewind.keep(self.branch, &mut self.world);
            self.world.clear_trackers();
        }
    }
}
