//! The match that the window plays, and the one that a person wants next.

use bevy::prelude::*;

use crate::app::match_request::MatchRequest;
use crate::data::AssetFolder;
use crate::game::MatchPlan;
use crate::ids::Team;
use crate::lab::replay::ReplayHeader;
use crate::lab::rewind::BranchId;
use crate::lab::scenario::ScenarioPlan;

/// Where the files are.
#[derive(Resource, Clone, Debug)]
pub struct Folder(pub AssetFolder);

/// What is wanted next.
#[derive(Resource, Clone, Debug, Default)]
pub struct PendingMatch(pub Option<MatchRequest>);

/// The match that is played.
#[derive(Resource, Clone, Debug, Default)]
pub struct Session {
    /// What it was made of.
    pub request: MatchRequest,
    /// What that came to; none before the first match.
    pub plan: Option<MatchPlan>,
    /// The scenario that it belongs to.
    pub scenario: Option<ScenarioPlan>,
    /// What a recording of it begins with; none before the first match.
    pub header: Option<ReplayHeader>,
}

impl Session {
    /// Whether a team takes part.
    pub fn has(&self, team: Team) -> bool {
        self.scenario.as_ref().is_none_or(|plan| plan.scenario.sides[team.index()].is_some())
    }
}

/// Another branch of the match that is shown beside the one that is played.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Beside(pub Option<BranchId>);

/// A match has been put into the world, from its beginning.
#[derive(Event, Clone, Copy, Debug)]
pub struct MatchBegun;

/// The match in the world has gone to another tick, or to another branch. What looks after each tick has seen the way there;
/// what lies between two ticks has to start anew.
#[derive(Event, Clone, Copy, Debug)]
pub struct Rewound;
