//! `touchline check`: reads assets as a match would, and says what is wrong with them.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::BAD_INPUT;
use crate::data::{AssetFolder, DataError};
use crate::game::{Choice, MatchPlan};
use crate::strategy::Strategy;

#[derive(Args, Debug, Default)]
pub(super) struct Check {
    /// Strategy files; all matches and strategies of the asset folder, if none is given.
    files: Vec<PathBuf>,
}

impl Check {
    pub(super) fn run(&self, assets: &AssetFolder) -> Result<ExitCode, DataError> {
        let mut faults = 0;
        let mut tell = |what: String, result: Result<(), DataError>| match result {
            Ok(()) => println!("ok    {what}"),
            Err(error) => {
                println!("fault {error}");
                faults += 1;
            }
        };
        for file in &self.files {
            tell(file.display().to_string(), Strategy::read(file).map(drop));
        }
        if self.files.is_empty() {
            for name in assets.names("strategies") {
                let path = assets.file("strategies", &name);
                tell(path.display().to_string(), Strategy::read(&path).map(drop));
            }
            for name in assets.names("matches") {
                let path = assets.file("matches", &name);
                let choice = Choice { file: Some(name), ..Choice::default() };
                tell(path.display().to_string(), MatchPlan::read(assets, &choice).map(drop));
            }
        }
        println!("{}", if faults == 0 { "all sound".into() } else { format!("{faults} with faults") });
        Ok(if faults == 0 { ExitCode::SUCCESS } else { ExitCode::from(BAD_INPUT) })
    }
}
