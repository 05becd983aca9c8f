//! `touchline soak`: matches in which everything goes wrong, until something breaks that must not.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;

use super::ending::{CommandError, Ending};
use super::experiment::quietly;
use super::interrupt::Interrupt;
use super::options::{SeedOption, number_of};
use super::progress::progress_bar;
use crate::app::whole_file;
use crate::data::AssetFolder;
use crate::lab::soak::{SoakChoice, SoakFinding, SoakPlan, SoakTally};

#[derive(Args, Debug)]
pub(super) struct SoakCommand {
    /// The strategies that play; all shipped ones that do not swap roles by the paper's protocol if none is named.
    #[arg(value_name = "STRATEGY")]
    strategies: Vec<String>,
    /// How much is played, in simulated hours of all matches together.
    #[arg(long, value_name = "H", default_value = "10", value_parser = number_of("hours", 0.001..=100_000.0))]
    hours: f64,
    /// How many matches are played at a time; as many as there are cores if not given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    #[command(flatten)]
    seed: SeedOption,
    /// Where the smallest match that breaks something is written, as a scenario that fails.
    #[arg(long, value_name = "FILE", default_value = "soak.ron")]
    out: PathBuf,
}

impl SoakCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let (strategies, seed) = (self.strategies.clone(), self.seed.of_match());
        let plan = SoakPlan::read(assets, &SoakChoice { strategies, seed, hours: self.hours })?;
        whole_file::check_writable(&self.out).map_err(CommandError::file(&self.out))?;
        if let Some(jobs) = self.jobs {
            // Fails only where the pool has begun, which is too late to matter.
            let _ = rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global();
        }
        let interrupt = Interrupt::listen();
        let bar = progress_bar(plan.matches(), "{bar:40} {pos}/{len} matches, {msg}, {eta} left");
        let (tally, finding) = quietly(|| {
            plan.run(|SoakTally { matches, hours }| {
                bar.set_position(matches);
                bar.set_message(format!("{hours:.1} h"));
                !interrupt.is_asked()
            })
        })?;
        bar.finish_and_clear();
        let SoakTally { matches, hours } = tally;
        writeln!(out, "{matches} matches, {hours:.2} h of play")?;
        match finding {
            Some(finding) => self.tell(&finding, out),
            None => {
                writeln!(out, "nothing broke that must not")?;
                Ok(Ending::of_run(interrupt.is_asked()))
            }
        }
    }

    fn tell(&self, finding: &SoakFinding, out: &mut impl Write) -> Result<Ending, CommandError> {
        let SoakFinding { seed, failure, smallest, tried } = finding;
        whole_file::write_whole(&self.out, finding.text().as_bytes())
            .map_err(CommandError::file(&self.out))?;
        writeln!(out, "seed {seed}, tick {} ({:.1} s): {}", failure.tick, failure.seconds, failure.reason)?;
        writeln!(out, "  expected: {}", failure.expectation)?;
        let named: String = self.strategies.iter().map(|name| format!(" {name}")).collect();
        writeln!(out, "  again: touchline soak{named} --seed {seed} --hours 0.001")?;
        let (file, events) = (self.out.display(), smallest.script.len());
        writeln!(out, "  {file}: the smallest such match of {tried} that were tried, with {events} events")?;
        writeln!(out, "  touchline check {file}; touchline play {file}")?;
        Ok(Ending::Failed)
    }
}
