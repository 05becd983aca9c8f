//! `touchline play`, and `touchline` alone: a match or a scenario in the window, or headless where there is none.

use std::path::Path;
use std::process::ExitCode;

use clap::Args;

use super::MatchOptions;
use crate::data::{AssetFolder, DataError};
use crate::ids::RobotId;
use crate::scenario::ScenarioPlan;

#[derive(Args, Debug, Default)]
pub(super) struct Play {
    /// A scenario: a name among the assets or a path; played with its first seed unless another is given.
    #[arg(conflicts_with_all = ["file", "home", "away", "radio", "minutes", "pilot"])]
    scenario: Option<String>,
    #[command(flatten)]
    options: MatchOptions,
    /// The robot that you drive, such as `away:3`.
    #[arg(long, value_name = "ROBOT")]
    pilot: Option<RobotId>,
}

impl Play {
    pub(super) fn run(&self, assets: &AssetFolder) -> Result<ExitCode, DataError> {
        if let Some(name) = &self.scenario {
            return self.run_scenario(assets, &assets.file("scenarios", name));
        }
        let plan = self.options.plan(assets, self.pilot)?;
        if let Some(missing) = missing_for_a_window() {
            eprintln!("{missing}, so the match is played headless");
            super::run::play_headless(&plan, false, self.options.patience())?;
            return Ok(ExitCode::SUCCESS);
        }
        Ok(open_window(assets, Wanted::Match(self.options.choice(self.pilot))))
    }

    fn run_scenario(&self, assets: &AssetFolder, path: &Path) -> Result<ExitCode, DataError> {
        let mut plan = ScenarioPlan::read(assets, path)?;
        let seed = self.options.seed;
        if let Some(missing) = missing_for_a_window() {
            eprintln!("{missing}, so the scenario is played headless");
            let seed = seed.or_else(|| plan.scenario.seeds.first().copied());
            plan.scenario.seeds = seed.into_iter().collect();
            println!("{}", plan.run(None));
            return Ok(ExitCode::SUCCESS);
        }
        Ok(open_window(assets, Wanted::Scenario { path: path.to_owned(), seed }))
    }
}

#[cfg(feature = "window")]
use crate::view::{Wanted, missing_for_a_window, open_window};

/// What would be shown.
#[cfg(not(feature = "window"))]
#[expect(dead_code, reason = "a build without a window shows nothing")]
enum Wanted {
    Match(crate::game::Choice),
    Scenario { path: std::path::PathBuf, seed: Option<u64> },
}

#[cfg(not(feature = "window"))]
fn missing_for_a_window() -> Option<&'static str> {
    Some("this build has no window")
}

#[cfg(not(feature = "window"))]
fn open_window(_: &AssetFolder, _: Wanted) -> ExitCode {
    ExitCode::FAILURE
}
