//! `touchline tune`: the numbers with which a team does best, and what they are worth on seeds that were held out.

mod folder;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;

use self::folder::TuningFolder;
use super::ending::{CommandError, Ending, print_json};
use super::experiment::{folder_beside, quietly};
use super::interrupt::Interrupt;
use super::progress::progress_bar;
use crate::data::{AssetFolder, DataError};
use crate::lab::report::ReportDocument;
use crate::lab::tune::{
    KnownMatches, RaceEntrant, TuningPlan, TuningReport, WantedMatches, search, teams_beside_each_other,
};

#[derive(Args, Debug)]
pub(super) struct TuneCommand {
    /// The tuning: a name among the assets or a path.
    file: String,
    /// The folder of what comes out; the name of the tuning with `.tuned` behind it if not given. Matches that are there already are
    /// not played again.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Print the report as JSON; of a tuning that names several teams, a list of reports.
    #[arg(long)]
    json: bool,
}

impl TuneCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let plans = TuningPlan::read(assets, &self.file)?;
        let folder =
            TuningFolder::new(self.out.clone().unwrap_or_else(|| folder_beside(&self.file, "tuned")));
        let interrupt = Interrupt::listen();
        let mut reports = Vec::new();
        for plan in &plans {
            let folder = folder.of_team(plan);
            let mut known = folder.begin(plan)?;
            match played(plan, &folder, &interrupt, &mut known) {
                Ok(winner) => reports.push(self.tell(plan, &folder, &winner, &known, out)?),
                Err(Stopped::Interrupted) => {
                    let (count, path) = (known.len(), folder.path().display());
                    writeln!(out, "{count} matches in {path}; the same command goes on from there")?;
                    return Ok(Ending::Interrupted);
                }
                Err(Stopped::Broken(error)) => return Err(error),
            }
        }
        match (plans.as_slice(), reports.as_slice()) {
            ([plan], [report]) if plan.team().is_none() => {
                if self.json {
                    print_json(report, out)?;
                }
            }
            (plans, reports) => self.tell_teams(&plans[0], &folder, reports, out)?,
        }
        Ok(Ending::Done)
    }

    /// Says what the search has come to, and leaves it in the folder.
    fn tell(
        &self,
        plan: &TuningPlan,
        folder: &TuningFolder,
        winner: &RaceEntrant,
        known: &KnownMatches,
        out: &mut impl Write,
    ) -> Result<TuningReport, CommandError> {
        let report = TuningReport::of(plan, winner, known);
        let text = report.document().to_markdown();
        folder.write("report.md", text.as_bytes())?;
        if winner.number != 0 {
            for (name, text) in plan.files(&winner.values, &report.comment())? {
                folder.write(&name, text.as_bytes())?;
            }
        }
        if !self.json {
            write!(out, "{text}")?;
            match winner.number {
                0 => writeln!(out, "No candidate was better than the values of before.")?,
                _ => writeln!(out, "The files with the tuned values are in {}.", folder.path().display())?,
            }
        }
        Ok(report)
    }

    /// The same of several teams together.
    fn tell_teams(
        &self,
        plan: &TuningPlan,
        folder: &TuningFolder,
        reports: &[TuningReport],
        out: &mut impl Write,
    ) -> Result<(), CommandError> {
        let title = plan.file.name.clone();
        let text = ReportDocument { title, blocks: teams_beside_each_other(plan, reports) }.to_markdown();
        folder.write("report.md", text.as_bytes())?;
        match self.json {
            true => print_json(&reports, out)?,
            false => write!(out, "{text}")?,
        }
        Ok(())
    }
}

/// What each team of a tuning has come to, by the matches in a folder.
///
/// # Errors
/// If some are missing, or were played from other files.
pub(super) fn reports_in(
    assets: &AssetFolder,
    path: &Path,
) -> Result<(TuningPlan, Vec<TuningReport>), DataError> {
    let folder = TuningFolder::new(path.to_owned());
    let mut plans = TuningPlan::read_file(assets, folder.design())?;
    let mut reports = Vec::new();
    for plan in &plans {
        let folder = folder.of_team(plan);
        let mut known = folder.known()?;
        let missing = |wanted: WantedMatches, _: &mut KnownMatches| {
            let message = format!("{} of its matches are missing", wanted.matches.len());
            Err(DataError::new(folder.path(), message))
        };
        let winner = search(plan, &mut known, missing)?;
        reports.push(TuningReport::of(plan, &winner, &known));
    }
    Ok((plans.swap_remove(0), reports))
}

/// Why a search came to no end.
enum Stopped {
    Interrupted,
    Broken(CommandError),
}

impl From<CommandError> for Stopped {
    fn from(error: CommandError) -> Stopped {
        Stopped::Broken(error)
    }
}

impl From<DataError> for Stopped {
    fn from(error: DataError) -> Stopped {
        Stopped::Broken(error.into())
    }
}

/// Searches, and plays what it takes.
fn played(
    plan: &TuningPlan,
    folder: &TuningFolder,
    interrupt: &Interrupt,
    known: &mut KnownMatches,
) -> Result<RaceEntrant, Stopped> {
    let bar = progress_bar(0, "{spinner} {prefix}{pos} of {len} matches so far");
    bar.set_prefix(plan.team().map(|team| format!("{team}: ")).unwrap_or_default());
    let found = quietly(|| {
        search(plan, known, |wanted, known| {
            bar.inc_length(wanted.matches.len() as u64);
            plan.play(wanted, |row| {
                bar.inc(1);
                known.add(row);
                Ok::<_, Stopped>(!interrupt.is_asked())
            })?;
            folder.keep(known)?;
            if interrupt.is_asked() { Err(Stopped::Interrupted) } else { Ok(()) }
        })
    });
    bar.finish_and_clear();
    found
}
