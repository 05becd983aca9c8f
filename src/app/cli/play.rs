//! `touchline play`, and `touchline` alone: a match or a scenario in the window, or headless where there is none.

use std::io::Write;

use clap::Args;

use crate::app::cli::ending::{CommandError, Ending, tell};
use crate::app::cli::interrupt::Interrupt;
use crate::app::cli::options::{HostOptions, MatchOptions, SeedOption};
use crate::app::cli::recording::RecordOption;
use crate::app::cli::run::HeadlessRun;
use crate::app::cli::windows;
use crate::app::logging::log_to_stderr;
use crate::app::match_request::MatchRequest;
use crate::data::{AssetFolder, DataError};
use crate::game::{Choice, MatchPlan};
use crate::ids::RobotId;
use crate::lab::replay::{Recorded, ReplayHeader};
use crate::lab::scenario::{ScenarioPlan, ScenarioRef};
use crate::rng::DEFAULT_SEED;

#[derive(Args, Debug, Default)]
pub(super) struct PlayCommand {
    /// A scenario: a name among the assets or a path, and `:VARIANT` behind it for another of its variants than the
    /// first; played with its first seed unless another is given, and with the ball at the first of its places.
    #[arg(conflicts_with_all = ["TeamsOptions", "addresses", "patience", "HostOptions", "pilot"])]
    scenario: Option<String>,
    #[command(flatten)]
    options: MatchOptions,
    #[command(flatten)]
    host: HostOptions,
    #[command(flatten)]
    seed: SeedOption,
    #[command(flatten)]
    record: RecordOption,
    /// The robot that you drive, such as `away:3`.
    #[arg(long, value_name = "ROBOT")]
    pilot: Option<RobotId>,
    /// Draw as fast as it goes, without waiting for the screen, and say each second how many frames that was.
    #[arg(long)]
    frame_rate: bool,
}

impl PlayCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        if let Some(name) = &self.scenario {
            return self.run_scenario(assets, ScenarioRef::named(assets, name), out);
        }
        let choice = Choice { pilot: self.pilot, ..self.host.choice(&self.options, &self.seed)? };
        let Some(missing) = windows::missing() else {
            waits_for_its_person(&choice)?;
            MatchPlan::read(assets, &choice)?;
            let wanted = self.chooses(&choice).then_some(MatchRequest::Match(choice));
            return Ok(windows::open_match_window(
                assets,
                wanted,
                self.record.record.clone(),
                self.frame_rate,
            ));
        };
        if self.pilot.is_some() {
            return Err(
                DataError::new("--pilot", format!("nobody can drive without a window: {missing}")).into()
            );
        }
        log_to_stderr();
        let interrupt = Interrupt::listen();
        let (header, (plan, _)) = ReplayHeader::of(Recorded::Match(choice), assets)?;
        tell(format_args!("{missing}, so the match is played headless"));
        let (recorder, patience) = (self.record.begin(header)?, self.options.patience());
        HeadlessRun { plan: &plan, patience, interrupt, recorder, heavy: false, strict: false }
            .play(false, out)
    }

    /// Whether anything was chosen, rather than left to the menu.
    fn chooses(&self, choice: &Choice) -> bool {
        let untouched = Choice { seed: DEFAULT_SEED, ..Choice::default() };
        self.seed.seed.is_some() || *choice != untouched
    }

    fn run_scenario(
        &self,
        assets: &AssetFolder,
        scenario: ScenarioRef,
        out: &mut impl Write,
    ) -> Result<Ending, CommandError> {
        let mut plan = ScenarioPlan::read(assets, &scenario)?;
        let seed = self.seed.seed;
        let Some(missing) = windows::missing() else {
            let wanted = MatchRequest::Scenario { scenario, seed };
            return Ok(windows::open_match_window(
                assets,
                Some(wanted),
                self.record.record.clone(),
                self.frame_rate,
            ));
        };
        let mut interrupt = Interrupt::listen();
        if self.record.record.is_some() {
            let message = "a scenario without a window is recorded by `touchline check --record`";
            return Err(DataError::new("--record", message).into());
        }
        tell(format_args!("{missing}, so the scenario is played headless"));
        let seed = seed.or_else(|| plan.scenario.seeds.first().copied()).unwrap_or(DEFAULT_SEED);
        plan.scenario = plan.scenario.with_one_seed(seed);
        let report = plan.run_watched(None, &mut interrupt);
        writeln!(out, "{report}")?;
        Ok(match report.passed() {
            _ if report.interrupted => Ending::Interrupted,
            true => Ending::Done,
            false => Ending::Failed,
        })
    }
}

/// In the window a person sees what is waited for, and ends it.
fn waits_for_its_person(choice: &Choice) -> Result<(), DataError> {
    match choice.network.wait_for_box {
        None => Ok(()),
        Some(_) => Err(DataError::new(
            "--wait-for-box",
            "a match in the window waits for its box until you leave it",
        )),
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct PlayArguments {
        #[command(flatten)]
        play: PlayCommand,
    }

    fn choice(arguments: &[&str]) -> (PlayCommand, Choice) {
        let program = PlayArguments::try_parse_from([&["play"], arguments].concat()).expect("good arguments");
        let PlayCommand { options, host, seed, pilot, .. } = &program.play;
        let choice = Choice { pilot: *pilot, ..host.choice(options, seed).expect("a sound choice") };
        (program.play, choice)
    }

    fn chooses(arguments: &[&str]) -> bool {
        let (play, choice) = choice(arguments);
        play.chooses(&choice)
    }

    #[test]
    fn how_long_a_window_waits_for_a_box_is_for_its_person_to_say() {
        let box_alone = ["--gamecontroller", "127.0.0.1:3838"];
        assert_eq!(waits_for_its_person(&choice(&box_alone).1), Ok(()));
        let limited = [&box_alone[..], &["--wait-for-box", "3"]].concat();
        let refused = waits_for_its_person(&choice(&limited).1).unwrap_err().to_string();
        assert!(refused.starts_with("--wait-for-box: "), "{refused}");
    }

    #[test]
    fn a_command_line_without_choice_leads_to_the_menu_and_any_choice_into_a_match() {
        assert!(!chooses(&[]));
        for choice in [["--seed", "1"], ["--seed", "7"], ["--home", "ball_chasers"], ["--pilot", "away:3"]] {
            assert!(chooses(&choice), "{choice:?}");
        }
    }
}
