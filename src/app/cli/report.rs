//! `touchline report`: the tables of experiments as something to read.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;

use super::ending::{CommandError, Ending};
use super::experiment::{ResultsFolder, folder_beside};
use super::shell_word::quoted;
use super::tune::reports_in;
use crate::app::whole_file::{check_writable, write_whole};
use crate::data::{AssetFolder, AssetKind, DataError, Source};
use crate::lab::kinds::kind_of;
use crate::lab::report::{ReportBlock, ReportDocument, ReportedExperiment, chapter_head};
use crate::lab::tune::teams_beside_each_other;

#[derive(Args, Debug)]
pub(super) struct ReportCommand {
    /// The folders of experiments and tunings, as `experiment` and `tune` leave them, in the order of the chapters; tunings come first.
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
        let (mut experiments, mut tunings) = (Vec::new(), Vec::new());
        for folder in &self.folders {
            match is_tuned(folder)? {
                true => tunings.extend(tuned(assets, folder)?),
                false => experiments.push(reported(assets, folder)?),
            }
        }
        let report = ReportDocument::of(&experiments, tunings, &self.command());
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

/// Whether a folder was left by a tuning. What is told of a design that is no tuning is for experiments to say.
fn is_tuned(folder: &Path) -> Result<bool, DataError> {
    let design = folder.join("design.ron");
    if !design.is_file() {
        let message = "holds no design.ron: it is no folder of an experiment or a tuning";
        return Err(DataError::new(folder, message));
    }
    Ok(kind_of(&Source::read(&design)?) == Ok(AssetKind::Tuning))
}

/// The chapter of a tuning.
fn tuned(assets: &AssetFolder, path: &Path) -> Result<Vec<ReportBlock>, DataError> {
    let (plan, reports) = reports_in(assets, path)?;
    let command = command(("tune", "tuned"), shipped_name(assets, AssetKind::Tuning, plan.text()), path, "");
    let matches = reports.iter().map(|report| report.matches).sum::<usize>();
    let facts =
        vec![format!("{} teams, {matches} matches; Touchline {}.", reports.len(), env!("CARGO_PKG_VERSION"))];
    let mut blocks = chapter_head(&plan.file.name, &plan.file.description, facts, &command);
    blocks.extend(teams_beside_each_other(&plan, &reports));
    Ok(blocks)
}

fn reported(assets: &AssetFolder, path: &Path) -> Result<ReportedExperiment, DataError> {
    let folder = ResultsFolder::new(path.to_owned());
    let plan = folder.plan(assets)?;
    let rows = folder.played(&plan)?;
    if rows.is_empty() {
        return Err(DataError::new(folder.csv(), "has no rows"));
    }
    let last = rows.iter().map(|row| row.key.seed - plan.file.blocks.first + 1).max().unwrap_or_default();
    let is_part = last < plan.file.blocks.number.into() && plan.file.until.is_none();
    let seeds = if is_part { format!(" --seeds {last}") } else { String::new() };
    let command = command(
        ("experiment", "results"),
        shipped_name(assets, AssetKind::Experiment, &plan.text),
        path,
        &seeds,
    );
    Ok(ReportedExperiment { plan, rows, command })
}

/// What plays what is in a folder again, by the name of the asset if there is one; `ending` is that of the command's folders.
fn command((command, ending): (&str, &str), name: Option<String>, folder: &Path, options: &str) -> String {
    let design = name.clone().unwrap_or_else(|| quoted(&folder.join("design.ron")));
    let usual = name.map(|name| folder_beside(&name, ending));
    let out = match usual {
        Some(usual) if folder.file_name() == usual.file_name() => String::new(),
        _ => format!(" --out {}", quoted(folder)),
    };
    format!("touchline {command} {design}{options}{out}")
}

/// The name of the asset that is word for word this one.
fn shipped_name(assets: &AssetFolder, kind: AssetKind, text: &str) -> Option<String> {
    let mut names = assets.names(kind).into_iter();
    names.find(|name| fs::read_to_string(assets.file(kind, name)).is_ok_and(|shipped| shipped == text))
}
