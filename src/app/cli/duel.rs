//! `touchline duel`: many short fights for a free ball, and the share that each side wins.

use std::io::Write;

use clap::Args;

use super::ending::{CommandError, Ending};
use super::options::{SeedOption, TeamsOptions, number_of};
use super::trials::run_trials;
use crate::data::AssetFolder;
use crate::lab::duel::{DuelChoice, DuelPlan, DuelTeams};

#[derive(Args, Debug)]
pub(super) struct DuelCommand {
    #[command(flatten)]
    teams: TeamsOptions,
    /// How many robots each side has, such as 2v1: the players with the highest numbers.
    #[arg(long, value_name = "NvM", default_value = "1v1")]
    robots: DuelTeams,
    /// How many trials to play; even, since each start is played with the strategies on either side.
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    trials: u32,
    /// After how long a trial is undecided.
    #[arg(long, value_name = "SECONDS", default_value = "20", value_parser = number_of("seconds", 1.0..=600.0))]
    seconds: f64,
    #[command(flatten)]
    seed: SeedOption,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
}

impl DuelCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let choice = DuelChoice {
            file: self.teams.file.clone(),
            home: self.teams.home.clone(),
            away: self.teams.away.clone(),
            teams: self.robots,
            trials: self.trials,
            seed: self.seed.of_match(),
            seconds: self.seconds,
        };
        let plan = DuelPlan::read(assets, &choice)?;
        let report = run_trials((plan.trials(), "trials"), self.json, out, |goes_on| plan.run(goes_on))?;
        Ok(Ending::of_run(report.interrupted))
    }
}
