//! What a recorded match was played from.

use std::path::PathBuf;

use bevy::math::Vec2;
use serde::{Deserialize, Serialize};

use crate::data::{AssetFolder, AssetTexts, DataError};
use crate::game::{Choice, MatchPlan};
use crate::lab::scenario::{Dependency, ScenarioPlan, ScenarioRef};

/// What a recorded match was played from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReplayHeader {
    /// What was played.
    pub recorded: Recorded,
    /// Where the asset folder was.
    root: PathBuf,
    /// The files that were read, with their texts.
    files: AssetTexts,
    /// The first tick of a branch: up to there another recording went the same way.
    pub branched: Option<u64>,
}

/// What was played.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum Recorded {
    /// A match, as a person chose it.
    Match(Choice),
    /// One run of a scenario: where the ball was, and the mechanism that was switched off.
    Scenario { scenario: ScenarioRef, place: Vec2, seed: u64, without: Option<Dependency> },
}

/// The plan of a match, and of the scenario that it belongs to.
pub type Plans = (MatchPlan, Option<ScenarioPlan>);

impl Recorded {
    /// Reads the files.
    ///
    /// # Errors
    /// The first fault of a file.
    pub fn plans(&self, assets: &AssetFolder) -> Result<Plans, DataError> {
        match self {
            Recorded::Match(choice) => Ok((MatchPlan::read(assets, choice)?, None)),
            Recorded::Scenario { scenario, place, seed, without } => {
                let plan = ScenarioPlan::read(assets, scenario)?;
                let plan = without.map_or(plan.clone(), |dependency| plan.without(dependency));
                Ok((plan.with_ball_at(*place, *seed), Some(plan)))
            }
        }
    }
}

impl ReplayHeader {
    /// Reads the files once more, and keeps them as they are now.
    ///
    /// # Errors
    /// The first fault of a file.
    pub fn of(recorded: Recorded, assets: &AssetFolder) -> Result<(ReplayHeader, Plans), DataError> {
        let (noting, notes) = assets.noting();
        let plans = recorded.plans(&noting)?;
        let header =
            ReplayHeader { recorded, root: assets.root().to_owned(), files: notes.texts(), branched: None };
        Ok((header, plans))
    }

    /// The files as they were.
    pub fn assets(&self) -> AssetFolder {
        AssetFolder::kept(&self.root, self.files.clone())
    }
}
