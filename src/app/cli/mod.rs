//! The command line. One file a subcommand; `ending` alone says how commands end.

mod box_report;
mod broken_report;
mod chaos;
mod check;
mod duel;
mod ending;
mod experiment;
mod export;
mod fit_eyes;
mod heavy;
mod interrupt;
mod jam;
mod league;
mod merge;
mod options;
mod picture_file;
mod play;
mod progress;
mod recording;
mod replay;
mod report;
mod robot;
mod run;
mod run_report;
mod shell_word;
mod soak;
mod trials;
mod tune;
mod why;
mod windows;

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::data::AssetFolder;
use ending::{CommandError, EXIT_CODES, Ending};

/// Robot soccer between teams of behaviour-based robots. Without a command it opens the window.
#[derive(Debug, Parser)]
#[command(name = "touchline", version, after_help = EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    command: Option<CliCommand>,
    /// The folder with strategies, pitches, robots and matches.
    #[arg(long, global = true, value_name = "FOLDER")]
    assets: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
enum CliCommand {
    /// Open the window and play; without a display, play headless.
    #[command(after_help = EXIT_CODES)]
    Play(play::PlayCommand),
    /// Play a match headless, as fast as it goes, and print the result.
    #[command(after_help = EXIT_CODES)]
    Run(run::RunCommand),
    /// Play a recorded match again, and compare it with its recording tick by tick.
    #[command(after_help = EXIT_CODES)]
    Replay(replay::ReplayCommand),
    /// Play a stretch of a recorded match again with one thing changed each time, and rank what then comes otherwise.
    #[command(after_help = EXIT_CODES)]
    Why(why::WhyCommand),
    /// Let a few robots of two strategies fight for a free ball, many times, and print the share that each side wins.
    #[command(after_help = EXIT_CODES)]
    Duel(duel::DuelCommand),
    /// Play the matches of an experiment on all cores, and write what was measured as tables.
    #[command(after_help = EXIT_CODES)]
    Experiment(experiment::ExperimentCommand),
    /// Play every strategy against every other on all cores, and print a table with ratings.
    #[command(after_help = EXIT_CODES)]
    League(league::LeagueCommand),
    /// Put the parts of an experiment together that were played on several machines.
    #[command(after_help = EXIT_CODES)]
    Merge(merge::MergeCommand),
    /// Play matches in which everything goes wrong, until something breaks that must not, and find the smallest such match.
    #[command(after_help = EXIT_CODES)]
    Soak(soak::SoakCommand),
    /// Find the few messages of a scenario whose loss does the most harm: the worst radio.
    #[command(after_help = EXIT_CODES)]
    Jam(jam::JamCommand),
    /// Search for the numbers with which a team does best, and compare them with those of before on other seeds.
    #[command(after_help = EXIT_CODES)]
    Tune(tune::TuneCommand),
    /// Write what experiments say as a page with plots or as Markdown.
    #[command(after_help = EXIT_CODES)]
    Report(report::ReportCommand),
    /// Take pictures of random moments with a calibrated camera, and print the numbers of the fast model of eyes that fit them.
    #[command(after_help = EXIT_CODES)]
    FitEyes(fit_eyes::FitEyesCommand),
    /// Write a recorded match as a page for a browser, a log for robotics tools, or pictures.
    #[command(after_help = EXIT_CODES)]
    Export(export::ExportCommand),
    /// Play one robot of a match that is elsewhere: its teamwork and its behaviour, over UDP.
    #[command(after_help = EXIT_CODES)]
    Robot(robot::RobotCommand),
    /// Look into a robot of a match that is elsewhere, set its camera, or send its team a strategy, over UDP.
    #[command(after_help = EXIT_CODES)]
    Chaos(chaos::ChaosCommand),
    /// Read asset files and say what is wrong with them.
    #[command(after_help = EXIT_CODES)]
    Check(check::CheckCommand),
}

/// Runs the program with the arguments of this process.
pub fn main() -> ExitCode {
    match Cli::try_parse() {
        Ok(cli) => cli.perform().unwrap_or_else(|error| error.tell()),
        Err(usage) => ending::tell_usage(&usage),
    }
    .into()
}

impl Cli {
    fn perform(self) -> Result<Ending, CommandError> {
        // The window has its own log.
        let opens_window = match &self.command {
            None | Some(CliCommand::Play(_)) => true,
            Some(CliCommand::Chaos(chaos)) => chaos.opens_window(),
            Some(CliCommand::Replay(replay)) => replay.opens_window(),
            Some(_) => false,
        };
        if !opens_window {
            crate::app::logging::log_to_stderr();
        }
        let assets = AssetFolder::find(self.assets.as_deref())?;
        let mut out = io::stdout();
        let ending = match self.command {
            None => play::PlayCommand::default().run(&assets, &mut out),
            Some(CliCommand::Play(play)) => play.run(&assets, &mut out),
            Some(CliCommand::Run(run)) => run.run(&assets, &mut out),
            Some(CliCommand::Replay(replay)) => replay.run(&assets, &mut out),
            Some(CliCommand::Why(why)) => why.run(&mut out),
            Some(CliCommand::Duel(duel)) => duel.run(&assets, &mut out),
            Some(CliCommand::Experiment(experiment)) => experiment.run(&assets, &mut out),
            Some(CliCommand::League(league)) => league.run(&assets, &mut out),
            Some(CliCommand::Merge(merge)) => merge.run(&assets, &mut out),
            Some(CliCommand::Soak(soak)) => soak.run(&assets, &mut out),
            Some(CliCommand::Jam(jam)) => jam.run(&assets, &mut out),
            Some(CliCommand::Tune(tune)) => tune.run(&assets, &mut out),
            Some(CliCommand::Report(report)) => report.run(&assets, &mut out),
            Some(CliCommand::FitEyes(fit)) => fit.run(&assets, &mut out),
            Some(CliCommand::Export(export)) => export.run(&assets, &mut out),
            Some(CliCommand::Robot(robot)) => robot.run(&assets, &mut out),
            Some(CliCommand::Chaos(chaos)) => chaos.run(&assets, &mut out),
            Some(CliCommand::Check(check)) => check.run(&assets, &mut out),
        }?;
        out.flush()?;
        Ok(ending)
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_options_of_all_commands_agree_with_each_other() {
        Cli::command().debug_assert();
    }
}
