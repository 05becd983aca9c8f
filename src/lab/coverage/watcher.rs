//! Counts in scenarios.

use bevy::prelude::Vec2;

use super::counts::MatchCoverage;
use super::table::Coverage;
use crate::game::Match;
use crate::lab::scenario::{RunWatcher, ScenarioPlan};

/// Adds what the teams do in the runs of a scenario to a coverage, if there is one; a run that was stopped does not count.
pub struct CoverageWatcher<'a> {
    sum: Option<&'a mut Coverage>,
    names: [String; 2],
    counted: Option<MatchCoverage>,
}

impl<'a> CoverageWatcher<'a> {
    /// Nothing is counted yet.
    pub fn new(plan: &ScenarioPlan, sum: Option<&'a mut Coverage>) -> CoverageWatcher<'a> {
        CoverageWatcher { sum, names: plan.strategy_names(), counted: None }
    }
}

impl RunWatcher for CoverageWatcher<'_> {
    fn begin(&mut self, _: (Vec2, u64), game: &mut Match) {
        self.counted = self.sum.is_some().then(|| MatchCoverage::new(game.world_mut(), self.names.clone()));
    }

    fn after_tick(&mut self, game: &mut Match) {
        if let Some(counted) = &mut self.counted {
            counted.observe(game.world());
        }
    }

    fn end(&mut self) {
        if let (Some(sum), Some(counted)) = (&mut self.sum, self.counted.take()) {
            sum.add(&counted.sum());
        }
    }
}
