//! The folder in which a tuning leaves its matches and what it found, and from which it goes on.

use std::fs;
use std::path::{Path, PathBuf};

use crate::app::cli::ending::CommandError;
use crate::app::cli::experiment::check_design;
use crate::app::whole_file::write_whole;
use crate::data::{DataError, Source};
use crate::lab::tune::{KnownMatches, TuningPlan};

/// A folder with the design, `design.ron`, every match, `matches.csv`, a report, `report.md`, and the files with the values that were
/// found, by their names in the asset folder.
pub(super) struct TuningFolder(PathBuf);

impl TuningFolder {
    /// Makes the folder, or goes on in it: the matches that are there.
    ///
    /// # Errors
    /// If it holds something else than matches of this very tuning, or cannot be written.
    pub fn begin(path: PathBuf, plan: &TuningPlan) -> Result<(TuningFolder, KnownMatches), CommandError> {
        let folder = TuningFolder(path);
        fs::create_dir_all(&folder.0).map_err(CommandError::file(&folder.0))?;
        let design = folder.0.join("design.ron");
        if !check_design(&design, plan.text(), "tuning")? {
            folder.write("design.ron", plan.text().as_bytes())?;
        }
        let matches = folder.matches();
        let known = match matches.exists() {
            true => KnownMatches::read(&matches, &Source::read(&matches)?.text)?,
            false => KnownMatches::default(),
        };
        Ok((folder, known))
    }

    pub fn path(&self) -> &Path {
        &self.0
    }

    pub fn matches(&self) -> PathBuf {
        self.0.join("matches.csv")
    }

    /// Writes the table of all matches.
    pub fn keep(&self, known: &KnownMatches) -> Result<(), CommandError> {
        let table = known.table().map_err(|error| DataError::new(self.matches(), error.to_string()))?;
        self.write("matches.csv", &table)
    }

    /// Writes a file, and the folder that it is in.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<(), CommandError> {
        let path = self.0.join(name);
        let made = path.parent().map_or(Ok(()), fs::create_dir_all);
        made.and_then(|()| write_whole(&path, content)).map_err(CommandError::file(&path))
    }
}
