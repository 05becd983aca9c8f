//! `touchline merge`: the parts of an experiment, played on several machines, as one.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;

use super::ending::{CommandError, Ending};
use super::experiment::ResultsFolder;
use crate::data::{AssetFolder, DataError};
use crate::lab::experiment::{ExperimentPlan, ExperimentRow};

#[derive(Args, Debug)]
pub(super) struct MergeCommand {
    /// The experiment: a name among the assets or a path.
    file: String,
    /// The folders with the parts.
    #[arg(required = true)]
    parts: Vec<PathBuf>,
    /// The folder of the whole; rows that are there already stay.
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
}

impl MergeCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let plan = ExperimentPlan::read(assets, &self.file)?;
        let whole = ResultsFolder::new(self.out.clone());
        let mut rows = whole.read(&plan)?;
        for part in &self.parts {
            rows.extend(ResultsFolder::new(part.clone()).played(&plan)?);
        }
        rows.sort_by_key(|row| row.key.row);
        no_contradiction(&rows).map_err(|message| DataError::new(&self.out, message))?;
        rows.dedup_by_key(|row| row.key.row);
        whole.begin(&plan)?;
        whole.finish(&plan, &rows)?;
        writeln!(out, "{} of {} matches in {}", rows.len(), plan.matches(), self.out.display())?;
        Ok(Ending::Done)
    }
}

/// A match that was played twice has come out the same.
fn no_contradiction(rows: &[ExperimentRow]) -> Result<(), String> {
    let same = |pair: &[ExperimentRow]| pair[0].key.row != pair[1].key.row || pair[0] == pair[1];
    rows.windows(2).find(|pair| !same(pair)).map_or(Ok(()), |pair| {
        Err(format!("row {} has come out differently in two of the folders", pair[0].key.row))
    })
}
