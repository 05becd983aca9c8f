//! The folder in which a tuning leaves its matches and what it found, and from which it goes on.

use std::fs;
use std::path::{Path, PathBuf};

use crate::app::cli::ending::CommandError;
use crate::app::cli::experiment::check_design;
use crate::app::whole_file::write_whole;
use crate::data::{DataError, Source};
use crate::lab::tune::{KnownMatches, TuningPlan};

/// A folder with the design, `design.ron`, and, for the tuning's one team or in a folder for each of its teams, every match,
/// `matches.csv`, a report, `report.md`, and the files with the values that were found, by their names in the asset folder.
pub(super) struct TuningFolder {
    design: PathBuf,
    path: PathBuf,
}

impl TuningFolder {
    pub fn new(path: PathBuf) -> TuningFolder {
        TuningFolder { design: path.join("design.ron"), path }
    }

    /// The part of it that is this team's.
    pub fn of_team(&self, plan: &TuningPlan) -> TuningFolder {
        let path = plan.team().map_or_else(|| self.path.clone(), |team| self.path.join(team));
        TuningFolder { design: self.design.clone(), path }
    }

    /// Makes the folder, or goes on in it: the matches that are there.
    ///
    /// # Errors
    /// If it holds something else than matches of this very tuning, or cannot be written.
    pub fn begin(&self, plan: &TuningPlan) -> Result<KnownMatches, CommandError> {
        fs::create_dir_all(&self.path).map_err(CommandError::file(&self.path))?;
        if !check_design(&self.design, plan.text(), "tuning")? {
            write_whole(&self.design, plan.text().as_bytes()).map_err(CommandError::file(&self.design))?;
        }
        Ok(self.known()?)
    }

    /// The matches that are there.
    ///
    /// # Errors
    /// If they cannot be read.
    pub fn known(&self) -> Result<KnownMatches, DataError> {
        let matches = self.matches();
        match matches.exists() {
            true => KnownMatches::read(&matches, &Source::read(&matches)?.text),
            false => Ok(KnownMatches::default()),
        }
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What was asked.
    pub fn design(&self) -> &Path {
        &self.design
    }

    fn matches(&self) -> PathBuf {
        self.path.join("matches.csv")
    }

    /// Writes the table of all matches.
    pub fn keep(&self, known: &KnownMatches) -> Result<(), CommandError> {
        let table = known.table().map_err(|error| DataError::new(self.matches(), error.to_string()))?;
        self.write("matches.csv", &table)
    }

    /// Writes a file, and the folder that it is in.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<(), CommandError> {
        let path = self.path.join(name);
        let made = path.parent().map_or(Ok(()), fs::create_dir_all);
        made.and_then(|()| write_whole(&path, content)).map_err(CommandError::file(&path))
    }
}
