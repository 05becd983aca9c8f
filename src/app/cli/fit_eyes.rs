//! `touchline fit-eyes`: the numbers of the fast model of a camera beside those that its pictures give.

use std::io::Write;

use clap::Args;

use super::ending::{CommandError, Ending};
use super::options::SeedOption;
use super::trials::run_trials;
use crate::data::AssetFolder;
use crate::lab::eyes::{EyesChoice, EyesPlan};

#[derive(Args, Debug)]
pub(super) struct FitEyesCommand {
    /// The match whose pitch, ball, light and robots are seen, and whose home team's eyes are compared: a name among the assets or a
    /// path.
    #[arg(long = "match", value_name = "MATCH")]
    file: Option<String>,
    /// The calibrated camera that takes the pictures: a name among the assets or a path.
    #[arg(long, value_name = "CAMERA")]
    camera: String,
    /// How many pictures of random moments to draw.
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    views: u32,
    #[command(flatten)]
    seed: SeedOption,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
}

impl FitEyesCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let choice = EyesChoice {
            file: self.file.clone(),
            camera: self.camera.clone(),
            views: self.views,
            seed: self.seed.of_match(),
        };
        let plan = EyesPlan::read(assets, &choice)?;
        let report = run_trials((plan.views(), "pictures"), self.json, out, |goes_on| plan.run(goes_on))?;
        Ok(Ending::of_run(report.interrupted))
    }
}
