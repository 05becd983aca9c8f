//! `touchline play`, and `touchline` alone: the window, or a headless match where there is none.

use std::process::ExitCode;

use clap::Args;

use super::MatchOptions;
use crate::data::{AssetFolder, DataError};
use crate::ids::RobotId;

#[derive(Args, Debug, Default)]
pub(super) struct Play {
    #[command(flatten)]
    options: MatchOptions,
    /// The robot that you drive, such as `away:3`.
    #[arg(long, value_name = "ROBOT")]
    pilot: Option<RobotId>,
}

impl Play {
    pub(super) fn run(&self, assets: &AssetFolder) -> Result<ExitCode, DataError> {
        let plan = self.options.plan(assets, self.pilot)?;
        if let Some(missing) = missing_for_a_window() {
            eprintln!("{missing}, so the match is played headless");
            super::run::play_headless(&plan, false);
            return Ok(ExitCode::SUCCESS);
        }
        Ok(open_window(assets, &self.options.choice(self.pilot)))
    }
}

#[cfg(feature = "window")]
use crate::view::{missing_for_a_window, open_window};

#[cfg(not(feature = "window"))]
fn missing_for_a_window() -> Option<&'static str> {
    Some("this build has no window")
}

#[cfg(not(feature = "window"))]
fn open_window(_: &AssetFolder, _: &crate::game::Choice) -> ExitCode {
    ExitCode::FAILURE
}
