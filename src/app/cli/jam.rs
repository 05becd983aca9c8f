//! `touchline jam`: the few messages of a scenario or of a recorded match whose loss does the most harm.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;

use super::ending::{CommandError, Ending, print_json};
use super::interrupt::Interrupt;
use super::options::{self, SeedOption, number_of};
use super::progress::progress_bar;
use super::recording;
use crate::app::whole_file;
use crate::comms::radio::Act;
use crate::data::{AssetFolder, DataError};
use crate::game::Match;
use crate::lab::jam::{Harm, JamChoice, JamPlan, JamStart, WorstCase};
use crate::lab::replay::{Recorder, Replay};
use crate::lab::scenario::ScenarioRef;

#[derive(Args, Debug)]
pub(super) struct JamCommand {
    /// A scenario: a name among the assets or a path, and `:VARIANT` behind it. Or a file that `--record` has written.
    #[arg(value_name = "SCENARIO|REPLAY")]
    start: String,
    /// How many packets of home may be lost, late or come twice.
    #[arg(long, value_name = "K", default_value = "2", value_parser = clap::value_parser!(u8).range(0..=20))]
    budget: u8,
    /// What counts as harm: an invariant that home breaks, GoalAgainst, or DoubledRole:SECONDS.
    #[arg(long, default_value = "OneRobotARole")]
    harm: Harm,
    /// Each packet may also be so late, instead of being lost; may be given several times.
    #[arg(long, value_name = "SECONDS", value_parser = number_of("seconds", 0.001..=10.0_f32))]
    delay: Vec<f32>,
    /// Each packet may also come once more so much later; may be given several times.
    #[arg(long, value_name = "SECONDS", value_parser = number_of("seconds", 0.001..=10.0_f32))]
    again: Vec<f32>,
    /// No packet is lost; give a delay or a copy then.
    #[arg(long)]
    no_loss: bool,
    /// Packets that are sent before this time are left alone.
    #[arg(long, value_name = "SECONDS", default_value = "0", value_parser = time)]
    at: f64,
    /// How long it is played from then on; a scenario to its end and a recorded match for 20 s if not given.
    #[arg(long, value_name = "SECONDS", value_parser = time)]
    seconds: Option<f64>,
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
    /// Where the worst radio is written: a scenario with the rules that do the harm, or the match once more with them.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
}

/// A time of a match.
fn time(text: &str) -> Result<f64, String> {
    options::seconds(text).map(|time| time.as_secs_f64())
}

impl JamCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let plan = JamPlan::read(assets, &self.choice(assets)?)?;
        if let Some(path) = &self.out {
            whole_file::check_writable(path).map_err(CommandError::file(path))?;
        }
        let interrupt = Interrupt::listen();
        let bar = progress_bar(0, "{spinner} {msg}");
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
        if let (Some(path), Some(worst)) = (&self.out, plan.worst(&report)) {
            write(path, worst)?;
        }
        Ok(Ending::of_run(interrupt.is_asked()))
    }

    fn choice(&self, assets: &AssetFolder) -> Result<JamChoice, DataError> {
        let path = PathBuf::from(&self.start);
        let start = if Replay::is_at(&path) {
            if self.seed.seed.is_some() {
                return Err(DataError::new("--seed", "a recorded match has its own"));
            }
            JamStart::Replay(path)
        } else {
            JamStart::Scenario(ScenarioRef::named(assets, &self.start))
        };
        let loss = (!self.no_loss).then_some(Act::Drop);
        let delays = self.delay.iter().map(|seconds| Act::Delay(*seconds));
        let copies = self.again.iter().map(|seconds| Act::Duplicate(*seconds));
        let acts: Vec<Act> = loss.into_iter().chain(delays).chain(copies).collect();
        if acts.is_empty() {
            return Err(DataError::new("--no-loss", "leaves nothing to be tried without --delay or --again"));
        }
        Ok(JamChoice {
            start,
            at: self.at,
            seconds: self.seconds,
            seed: self.seed.seed,
            budget: self.budget.into(),
            harm: self.harm,
            acts,
            all_kinds: self.all_kinds,
            without_faults: self.without_faults,
            beam: self.beam as usize,
        })
    }
}

fn write(path: &Path, worst: WorstCase) -> Result<(), CommandError> {
    match worst {
        WorstCase::Scenario(text) => {
            whole_file::write_whole(path, text.as_bytes()).map_err(CommandError::file(path))
        }
        WorstCase::Replay(played, ticks) => {
            let (header, plan) = *played;
            let mut recorder = Recorder::create(path, header).map_err(CommandError::file(path))?;
            let mut game = Match::new(&plan);
            for _ in 0..ticks {
                game.tick();
                recording::note(&mut recorder, &mut game)?;
            }
            recording::finish(recorder)
        }
    }
}
