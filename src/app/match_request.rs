//! What a person wants to see in the window, and the plans that this comes to.

use crate::data::{AssetFolder, DataError};
use crate::game::{Choice, MatchPlan};
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
}

impl Default for MatchRequest {
    fn default() -> MatchRequest {
        MatchRequest::Match(Choice::default())
    }
}

/// The plan of a match, and of the scenario that it belongs to.
pub type Plans = (MatchPlan, Option<ScenarioPlan>);

impl MatchRequest {
    /// Reads the files.
    ///
    /// # Errors
    /// The first fault of a file.
    pub fn plans(&self, assets: &AssetFolder) -> Result<Plans, DataError> {
        match self {
            MatchRequest::Match(choice) => MatchPlan::read(assets, choice).map(|plan| (plan, None)),
            MatchRequest::Scenario { scenario, seed } => {
                let scenario = ScenarioPlan::read(assets, scenario)?;
                let seed = seed.or_else(|| scenario.scenario.seeds.first().copied()).unwrap_or(DEFAULT_SEED);
                Ok((scenario.with_seed(seed), Some(scenario)))
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
            let (plan, scenario) = MatchRequest::Scenario { scenario, seed }.plans(&assets).unwrap();
            assert!(scenario.is_some() && plan.situation.is_some());
            plan.seed
        };
        assert_eq!((seed_of(None), seed_of(Some(77))), (1, 77));
    }
}
