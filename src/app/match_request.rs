//! What a person wants to see in the window, and the plans that this comes to.

use std::path::PathBuf;

use crate::data::{AssetFolder, DataError};
use crate::game::Choice;
use crate::lab::replay::{Plans, Recorded, Replay, ReplayHeader};
use crate::lab::scenario::{ScenarioPlan, ScenarioRef};
use crate::rng::DEFAULT_SEED;

/// What a person wants to see.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum MatchRequest {
    /// A match, as a person chose it.
    Match(Choice),
    /// A scenario with one of its seeds or with any other.
    Scenario {
        scenario: ScenarioRef,
        /// Its first one, if not given.
        seed: Option<u64>,
    },
    /// A recorded match, in a file.
    Replay(PathBuf),
}

impl Default for MatchRequest {
    fn default() -> MatchRequest {
        MatchRequest::Match(Choice::default())
    }
}

impl MatchRequest {
    /// Reads the files; also as a recording of the match keeps them.
    ///
    /// # Errors
    /// The first fault of a file.
    pub fn read(&self, assets: &AssetFolder) -> Result<(ReplayHeader, Plans), DataError> {
        match self {
            MatchRequest::Match(choice) => ReplayHeader::of(Recorded::Match(choice.clone()), assets),
            MatchRequest::Scenario { scenario, seed } => {
                let plan = ScenarioPlan::read(assets, scenario)?.scenario;
                let seed = seed.or_else(|| plan.seeds.first().copied()).unwrap_or(DEFAULT_SEED);
                let (scenario, place) = (scenario.clone(), plan.first_place());
                ReplayHeader::of(Recorded::Scenario { scenario, place, seed, without: None }, assets)
            }
            MatchRequest::Replay(path) => {
                let replay = Replay::read(path)?;
                let plans = replay.plans()?;
                Ok((replay.header, plans))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scenario_is_played_with_its_first_seed_or_with_the_one_asked_for() {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let scenario = ScenarioRef::named(&assets, "swap_figure_8");
        let seed_of = |seed| {
            let scenario = scenario.clone();
            let (_, (plan, scenario)) = MatchRequest::Scenario { scenario, seed }.read(&assets).unwrap();
            assert!(scenario.is_some() && plan.situation.is_some());
            plan.seed
        };
        assert_eq!((seed_of(None), seed_of(Some(77))), (1, 77));
    }
}
