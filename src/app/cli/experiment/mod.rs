//! `touchline experiment`: the matches of a design, on all cores, as tables.

mod folder;
mod matches;
mod shard;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;

pub(super) use self::folder::{ResultsFolder, check_design};
pub(super) use self::matches::{play_wanted, quietly};
use self::shard::Shard;
use super::ending::{CommandError, Ending, print_json, tell};
use super::interrupt::Interrupt;
use crate::data::{AssetFolder, DataError};
use crate::lab::experiment::{ExperimentPlan, ExperimentRow, ExperimentSummary, Metric};

#[derive(Args, Debug)]
pub(super) struct ExperimentCommand {
    /// The experiments, one after the other: names among the assets or paths.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// Play no more seeds of each experiment than these, the first ones; later, more can be played in the same folder.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    seeds: Option<u32>,
    /// The folder of the tables; the name of the experiment with `.results` behind it if not given. What is there already is
    /// not played again.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Play only this part of the matches, such as 2/8 for the second of eight; `merge` puts the parts together.
    #[arg(long, value_name = "K/N", conflicts_with = "row")]
    shard: Option<Shard>,
    /// Play the match of this row alone, print its figures, and compare it with the table if it is there.
    #[arg(long, value_name = "N")]
    row: Option<u64>,
    /// Print the summary as JSON.
    #[arg(long, conflicts_with = "row")]
    json: bool,
}

impl ExperimentCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let plans = self.files.iter().map(|file| ExperimentPlan::read(assets, file));
        let plans = plans.collect::<Result<Vec<_>, _>>()?;
        for (option, is_given) in [("--out", self.out.is_some()), ("--row", self.row.is_some())] {
            if is_given && plans.len() > 1 {
                return Err(DataError::new(option, "goes with one experiment alone").into());
            }
        }
        if self.shard.is_some() && plans.iter().any(|plan| plan.file.until.is_some()) {
            let message = "parts cannot know when enough is known; the design has `until`";
            return Err(DataError::new("--shard", message).into());
        }
        let mut experiments = self.files.iter().zip(&plans).map(|(file, plan)| {
            (plan, ResultsFolder::new(self.out.clone().unwrap_or_else(|| folder_beside(file, "results"))))
        });
        if let Some(row) = self.row {
            return experiments.try_fold(Ending::Done, |_, (plan, folder)| play_row(plan, row, &folder, out));
        }
        let interrupt = Interrupt::listen();
        for (plan, folder) in experiments {
            self.play((plan, &folder), &interrupt, out)?;
            if interrupt.is_asked() {
                break;
            }
        }
        Ok(Ending::of_run(interrupt.is_asked()))
    }

    fn play(
        &self,
        (plan, folder): (&ExperimentPlan, &ResultsFolder),
        interrupt: &Interrupt,
        out: &mut impl Write,
    ) -> Result<(), CommandError> {
        let rows = play_wanted((plan, folder), |rows| self.wanted(plan, rows), interrupt)?;
        let summary = ExperimentSummary::of(plan, &rows);
        if self.json {
            print_json(&summary, out)?;
        } else {
            write!(out, "{summary}")?;
            writeln!(out, "{} of {} matches in {}", rows.len(), plan.matches(), folder.path().display())?;
        }
        Ok(())
    }

    /// The rows that are wanted, as far as those that are there tell.
    fn wanted(&self, plan: &ExperimentPlan, rows: &[ExperimentRow]) -> Vec<u64> {
        let seeds = plan.wanted_seeds(rows).min(self.seeds.unwrap_or(u32::MAX));
        let mine = |row: &u64| self.shard.is_none_or(|shard| shard.has(plan, *row));
        (0..u64::from(seeds) * plan.in_block()).filter(mine).collect()
    }
}

/// A folder of this directory, named as a file with another ending.
pub(super) fn folder_beside(file: &str, ending: &str) -> PathBuf {
    let stem = Path::new(file).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    PathBuf::from(format!("{}.{ending}", stem.unwrap_or_default()))
}

fn play_row(
    plan: &ExperimentPlan,
    number: u64,
    folder: &ResultsFolder,
    out: &mut impl Write,
) -> Result<Ending, CommandError> {
    if number >= plan.matches() {
        let message = format!("there are {} matches, counted from 0", plan.matches());
        return Err(DataError::new("--row", message).into());
    }
    let known = folder.read(plan)?.into_iter().find(|row| row.key.row == number);
    let row = quietly(|| plan.play(number));
    print(plan, &row, out)?;
    let Some(known) = known else { return Ok(Ending::Done) };
    if known.result == row.result {
        writeln!(out, "the match is as it is in {}", folder.csv().display())?;
        return Ok(Ending::Done);
    }
    tell(format_args!("{}: row {number} has come out differently", folder.csv().display()));
    Ok(Ending::Failed)
}

fn print(plan: &ExperimentPlan, row: &ExperimentRow, out: &mut impl Write) -> std::io::Result<()> {
    for (factor, level) in plan.file.factors.iter().zip(&row.levels) {
        writeln!(out, "{:20} {level}", factor.name)?;
    }
    writeln!(out, "{:20} {}", "seed", row.key.seed)?;
    writeln!(out, "{:20} {}", "sides", if row.key.swapped { "swapped" } else { "as named" })?;
    match &row.result {
        Err(error) => writeln!(out, "{:20} {error}", "error"),
        Ok(result) => {
            writeln!(out, "{:20} {:016x}", "digest", result.digest)?;
            writeln!(out, "{:20} {:>12} {:>12}", "", row.strategies[0], row.strategies[1])?;
            let [own, opponents] = &result.values;
            for ((metric, own), other) in Metric::ALL.iter().zip(own).zip(opponents) {
                let [own, other] =
                    [own, other].map(|value| value.map_or_else(|| "-".into(), |value| format!("{value:.4}")));
                writeln!(out, "{:20} {own:>12} {other:>12} {}", metric.column(), metric.unit())?;
            }
            Ok(())
        }
    }
}
