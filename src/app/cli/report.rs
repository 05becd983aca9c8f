//! `touchline report`: the tables of experiments as something to read.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;

use super::ending::{CommandError, Ending};
use super::experiment::{ResultsFolder, folder_beside};
use super::shell_word::quoted;
use crate::app::whole_file::{check_writable, write_whole};
use crate::data::{AssetFolder, AssetKind, DataError};
use crate::lab::experiment::{ExperimentPlan, ExperimentRow};
use crate::lab::report::{ReportDocument, ReportedExperiment};

#[derive(Args, Debug)]
pub(super) struct ReportCommand {
    /// The folders of experiments, as `experiment` leaves them, in the order of the chapters.
    #[arg(required = true, value_name = "FOLDER")]
    folders: Vec<PathBuf>,
    /// Write a page for a browser, with plots; it needs no other file.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write Markdown, without plots; it is printed if no file is given.
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
}

impl ReportCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let files = [&self.html, &self.markdown];
        for file in files.into_iter().flatten() {
            check_writable(file).map_err(CommandError::file(file))?;
        }
        let experiments = self.folders.iter().map(|folder| reported(assets, folder));
        let experiments = experiments.collect::<Result<Vec<_>, _>>()?;
        let report = ReportDocument::of(&experiments, &self.command());
        if let Some(file) = &self.html {
            write_whole(file, report.to_html().as_bytes()).map_err(CommandError::file(file))?;
        }
        if let Some(file) = &self.markdown {
            write_whole(file, report.to_markdown().as_bytes()).map_err(CommandError::file(file))?;
        }
        if files.iter().all(|file| file.is_none()) {
            write!(out, "{}", report.to_markdown())?;
        }
        Ok(Ending::Done)
    }

    /// What writes the report again.
    fn command(&self) -> String {
        let folders = self.folders.iter().map(|folder| quoted(folder));
        let options = [("--html", &self.html), ("--markdown", &self.markdown)];
        let options = options
            .into_iter()
            .filter_map(|(option, file)| Some([option.to_owned(), quoted(file.as_ref()?)]));
        let words = ["touchline".to_owned(), "report".to_owned()].into_iter().chain(folders);
        words.chain(options.flatten()).collect::<Vec<_>>().join(" ")
    }
}

fn reported(assets: &AssetFolder, path: &Path) -> Result<ReportedExperiment, DataError> {
    let folder = ResultsFolder::new(path.to_owned());
    let plan = folder.plan(assets)?;
    let rows = folder.played(&plan)?;
    if rows.is_empty() {
        return Err(DataError::new(folder.csv(), "has no rows"));
    }
    let command = command(assets, &folder, &plan, &rows);
    Ok(ReportedExperiment { plan, rows, command })
}

/// What plays the rows of a folder again.
fn command(
    assets: &AssetFolder,
    folder: &ResultsFolder,
    plan: &ExperimentPlan,
    rows: &[ExperimentRow],
) -> String {
    let name = shipped_name(assets, plan);
    let design = name.clone().unwrap_or_else(|| quoted(&folder.design()));
    let usual = name.map(|name| folder_beside(&name, "results"));
    let out = match usual {
        Some(usual) if folder.path().file_name() == usual.file_name() => String::new(),
        _ => format!(" --out {}", quoted(folder.path())),
    };
    let last = rows.iter().map(|row| row.key.seed - plan.file.blocks.first + 1).max().unwrap_or_default();
    let is_part = last < plan.file.blocks.number.into() && plan.file.until.is_none();
    let seeds = if is_part { format!(" --seeds {last}") } else { String::new() };
    format!("touchline experiment {design}{seeds}{out}")
}

/// The name of the experiment among the assets that is word for word this one.
fn shipped_name(assets: &AssetFolder, plan: &ExperimentPlan) -> Option<String> {
    let mut names = assets.names(AssetKind::Experiment).into_iter();
    names.find(|name| {
        let text = fs::read_to_string(assets.file(AssetKind::Experiment, name));
        text.is_ok_and(|text| text == plan.text)
    })
}
