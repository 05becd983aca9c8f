//! The folder in which an experiment leaves its tables, and from which it goes on.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::app::cli::ending::CommandError;
use crate::app::whole_file::write_whole;
use crate::data::{AssetFolder, DataError, Source};
use crate::lab::experiment::{
    ExperimentPlan, ExperimentRow, TableWriter, read_csv, write_csv, write_parquet,
};

/// A folder with the design, `design.ron`, and the tables, `rows.csv` and `rows.parquet`.
pub(in crate::app::cli) struct ResultsFolder(PathBuf);

impl ResultsFolder {
    pub fn new(path: PathBuf) -> ResultsFolder {
        ResultsFolder(path)
    }

    pub fn path(&self) -> &Path {
        &self.0
    }

    /// The table that grows match by match.
    pub fn csv(&self) -> PathBuf {
        self.0.join("rows.csv")
    }

    /// What was asked.
    pub fn design(&self) -> PathBuf {
        self.0.join("design.ron")
    }

    /// Reads the experiment that left the folder.
    ///
    /// # Errors
    /// If there is none, or it cannot be played any more.
    pub fn plan(&self, assets: &AssetFolder) -> Result<ExperimentPlan, DataError> {
        let design = self.design();
        if !design.is_file() {
            return Err(DataError::new(&self.0, "holds no design.ron: it is no folder of an experiment"));
        }
        ExperimentPlan::read_file(assets, &design)
    }

    /// Makes the folder, or goes on in it: the rows that are there.
    ///
    /// # Errors
    /// If it holds something else than matches of this very experiment, or cannot be written.
    pub fn begin(&self, plan: &ExperimentPlan) -> Result<Vec<ExperimentRow>, CommandError> {
        fs::create_dir_all(&self.0).map_err(CommandError::file(&self.0))?;
        let rows = self.read(plan)?;
        let design = self.design();
        if !design.is_file() {
            write_whole(&design, plan.text.as_bytes()).map_err(CommandError::file(&design))?;
        }
        // What a crash has left of a line would spoil the next one.
        self.write_table(plan, &rows)?;
        Ok(rows)
    }

    /// The rows that are there; none if there is no table.
    ///
    /// # Errors
    /// If it holds something else than matches of this very experiment.
    pub fn read(&self, plan: &ExperimentPlan) -> Result<Vec<ExperimentRow>, DataError> {
        check_design(&self.design(), &plan.text, "experiment")?;
        let path = self.csv();
        if !path.exists() {
            return Ok(Vec::new());
        }
        read_csv(plan, &path, &Source::read(&path)?.text)
    }

    /// As [`ResultsFolder::read`], of a table that must be there.
    ///
    /// # Errors
    /// As there, and if there is no table.
    pub fn played(&self, plan: &ExperimentPlan) -> Result<Vec<ExperimentRow>, DataError> {
        if !self.csv().is_file() {
            return Err(DataError::new(&self.0, "holds no rows.csv"));
        }
        self.read(plan)
    }

    /// The table, to add rows to.
    pub fn table(&self, plan: &ExperimentPlan) -> Result<TableWriter, CommandError> {
        let path = self.csv();
        TableWriter::open(&path, plan).map_err(CommandError::file(&path))
    }

    /// Writes both tables, in the order of the rows.
    pub fn finish(&self, plan: &ExperimentPlan, rows: &[ExperimentRow]) -> Result<(), CommandError> {
        self.write_table(plan, rows)?;
        let (path, mut bytes) = (self.0.join("rows.parquet"), Vec::new());
        let written = write_parquet(plan, rows, &mut bytes).and_then(|()| write_whole(&path, &bytes));
        written.map_err(CommandError::file(&path))
    }

    fn write_table(&self, plan: &ExperimentPlan, rows: &[ExperimentRow]) -> Result<(), CommandError> {
        let (path, mut bytes) = (self.csv(), Vec::new());
        let written = write_csv(plan, rows, &mut bytes).and_then(|()| write_whole(&path, &bytes));
        written.map_err(CommandError::file(&path))
    }
}

/// Whether there is a design in a folder, which must be this one.
///
/// # Errors
/// If it is another, or cannot be read.
pub(in crate::app::cli) fn check_design(path: &Path, text: &str, what: &str) -> Result<bool, DataError> {
    match fs::read_to_string(path) {
        Ok(known) if known == text => Ok(true),
        Ok(_) => Err(DataError::new(path, format!("is another {what}; name another folder with --out"))),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(DataError::new(path, format!("cannot be read: {error}"))),
    }
}
