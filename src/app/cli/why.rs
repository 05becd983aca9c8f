//! `touchline why`: what in a stretch of a recorded match has led to where it then stands.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;

use super::ending::{CommandError, Ending, print_json};
use super::export::export_replay;
use super::interrupt::Interrupt;
use super::options::number_of;
use super::progress::progress_bar;
use crate::app::whole_file::{check_writable, write_whole};
use crate::lab::export::{ExportWishes, MOST_FORKS, PageForks, PageWish};
use crate::lab::replay::Replay;
use crate::lab::why::{WhyChoice, WhyPlan, WhyReport};

#[derive(Args, Debug)]
pub(super) struct WhyCommand {
    /// A file that `--record` has written.
    file: PathBuf,
    /// The tick after which the match stands as it is to be explained; the last one if not given.
    #[arg(long, value_name = "TICK")]
    at: Option<u64>,
    /// How many seconds before that things are changed.
    // The radio remembers a minute.
    #[arg(long, value_name = "SECONDS", default_value_t = 30.0, value_parser = number_of("seconds", 0.1..=60.0_f32))]
    horizon: f32,
    /// With how many other dice each difference is tried.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(0..=1000))]
    seeds: u32,
    /// How many changes are tried at most, those nearest to the tick first.
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = clap::value_parser!(u32).range(1..))]
    most: u32,
    /// Record the matches of the first findings in this folder, from which `replay` plays them.
    #[arg(long, value_name = "FOLDER")]
    forks: Option<PathBuf>,
    /// Write the match as a page for a browser, with the first findings as other futures beside it.
    #[arg(long, value_name = "FILE")]
    page: Option<PathBuf>,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
}

impl WhyCommand {
    pub(super) fn run(&self, out: &mut impl Write) -> Result<Ending, CommandError> {
        if let Some(page) = &self.page {
            check_writable(page).map_err(CommandError::file(page))?;
        }
        let replay = Replay::read(&self.file)?;
        let (at, horizon, seeds, most) = (self.at, self.horizon, self.seeds, self.most as usize);
        let plan = WhyPlan::read(&replay, WhyChoice { at, horizon, seeds, most })?;
        let interrupt = Interrupt::listen();
        let bar = progress_bar(0, "{bar:40} {pos} of {len} changes, {eta} left");
        let begins = |count: usize| bar.set_length(count as u64);
        let report = plan.run(begins, |done| {
            bar.set_position(done.into());
            !interrupt.is_asked()
        });
        bar.finish_and_clear();
        if self.json {
            print_json(&report, out)?;
        } else {
            write!(out, "{report}")?;
        }
        if !interrupt.is_asked() {
            self.record_forks(&plan, &report, &interrupt)?;
            self.write_page(&replay, &plan, &report, &interrupt)?;
        }
        Ok(Ending::of_run(report.interrupted || interrupt.is_asked()))
    }

    fn record_forks(
        &self,
        plan: &WhyPlan,
        report: &WhyReport,
        interrupt: &Interrupt,
    ) -> Result<(), CommandError> {
        let Some(folder) = &self.forks else { return Ok(()) };
        std::fs::create_dir_all(folder).map_err(CommandError::file(folder))?;
        for (place, finding) in report.findings.iter().take(MOST_FORKS).enumerate() {
            if interrupt.is_asked() {
                break;
            }
            let path = folder.join(format!("{}.replay", place + 1));
            plan.record(finding, &path).map_err(CommandError::file(&path))?;
        }
        Ok(())
    }

    fn write_page(
        &self,
        replay: &Replay,
        plan: &WhyPlan,
        report: &WhyReport,
        interrupt: &Interrupt,
    ) -> Result<(), CommandError> {
        let Some(path) = &self.page else { return Ok(()) };
        let forks = report.findings.iter().take(MOST_FORKS).map(|finding| plan.fork(finding)).collect();
        let page = Some(PageWish { forks: PageForks::Given(forks) });
        let exported = export_replay(replay, ExportWishes { page, ..ExportWishes::default() }, interrupt)?;
        match exported.and_then(|exported| exported.page) {
            Some(page) => write_whole(path, page.as_bytes()).map_err(CommandError::file(path)),
            None => Ok(()),
        }
    }
}
