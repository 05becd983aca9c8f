//! `touchline jam`: the few messages of a scenario whose loss does the most harm.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use indicatif::ProgressBar;

use super::ending::{CommandError, Ending, print_json};
use super::interrupt::Interrupt;
use super::options::SeedOption;
use crate::app::whole_file;
use crate::data::AssetFolder;
use crate::lab::jam::{Harm, JamChoice, JamPlan, JamReport};
use crate::lab::scenario::ScenarioRef;

#[derive(Args, Debug)]
pub(super) struct JamCommand {
    /// The scenario: a name among the assets or a path, and `:VARIANT` behind it.
    #[arg(value_name = "SCENARIO")]
    scenario: String,
    /// How many packets of home may be lost or late.
    #[arg(long, value_name = "K", default_value = "2", value_parser = clap::value_parser!(u8).range(0..=20))]
    budget: u8,
    /// What counts as harm: an invariant that home breaks, or GoalAgainst.
    #[arg(long, default_value = "OneRobotARole")]
    harm: Harm,
    /// Packets may also be so late, instead of being lost.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    delay: Option<f32>,
    /// Also positions and other news, and not only the steps of a protocol.
    #[arg(long)]
    all_kinds: bool,
    /// Without the faults that the scenario has itself.
    #[arg(long)]
    without_faults: bool,
    /// How many sets of packets of each size are led on to the next: those that come nearest to harm.
    #[arg(long, value_name = "N", default_value = "500", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    beam: u32,
    #[command(flatten)]
    seed: SeedOption,
    /// Where the worst radio is written: the scenario with the rules that do the harm.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
}

fn seconds(text: &str) -> Result<f32, String> {
    let seconds = text.parse::<f32>().ok().filter(|seconds| (0.001..=10.0).contains(seconds));
    seconds.ok_or_else(|| "must be a number of seconds, from 0.001 to 10".into())
}

impl JamCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let choice = JamChoice {
            scenario: ScenarioRef::named(assets, &self.scenario),
            seed: self.seed.seed,
            budget: self.budget.into(),
            harm: self.harm,
            delay: self.delay,
            all_kinds: self.all_kinds,
            without_faults: self.without_faults,
            beam: self.beam as usize,
        };
        let plan = JamPlan::read(assets, &choice)?;
        if let Some(path) = &self.out {
            whole_file::check_writable(path).map_err(CommandError::file(path))?;
        }
        let interrupt = Interrupt::listen();
        let bar = ProgressBar::new_spinner().with_message("matches");
        let report = plan.run(|played| {
            bar.set_message(format!("{played} matches"));
            bar.tick();
            !interrupt.is_asked()
        });
        bar.finish_and_clear();
        if self.json {
            print_json(&report, out)?;
        } else {
            writeln!(out, "{report}")?;
        }
        self.write(&plan, &report)?;
        Ok(Ending::of_run(interrupt.is_asked()))
    }

    /// The scenario that fails, if there is harm and somebody wants it.
    fn write(&self, plan: &JamPlan, report: &JamReport) -> Result<(), CommandError> {
        let (Some(path), Some(text)) = (&self.out, plan.worst(report)) else { return Ok(()) };
        whole_file::write_whole(path, text.as_bytes()).map_err(CommandError::file(path))
    }
}
