//! `touchline replay`: a recorded match once more, compared with its recording tick by tick.

use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;

use super::ending::{CommandError, Ending, print_json, tell};
use super::interrupt::Interrupt;
use super::progress::progress_bar;
use super::run_report::RunReport;
use super::windows;
use crate::app::match_request::MatchRequest;
use crate::data::{AssetFolder, DataError};
use crate::game::Match;
use crate::lab::replay::{Comparison, Parting, Replay};

#[derive(Args, Debug)]
pub(super) struct ReplayCommand {
    /// A file that `--record` has written.
    file: PathBuf,
    /// Open it in the window rather than play and compare it.
    #[arg(long, conflicts_with = "json")]
    window: bool,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
}

impl ReplayCommand {
    pub(super) fn opens_window(&self) -> bool {
        self.window
    }

    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let replay = Replay::read(&self.file)?;
        let (plan, _) = replay.plans()?;
        if self.window {
            if let Some(missing) = windows::missing() {
                return Err(DataError::new("--window", missing).into());
            }
            return Ok(windows::open_match_window(
                assets,
                Some(MatchRequest::Replay(self.file.clone())),
                None,
                false,
            ));
        }
        let (started, interrupt) = (Instant::now(), Interrupt::listen());
        let mut game = Match::new(&plan);
        let compared = compare(&replay, &mut game, &interrupt);
        if let Err(parting) = compared {
            tell(format_args!("{}: {parting}", self.file.display()));
            return Ok(Ending::Failed);
        }
        let report = RunReport::of(&game, &plan, started.elapsed().as_secs_f64());
        if self.json {
            print_json(&report, out)?;
        } else {
            report.print(out)?;
            let (ticks, all) = (game.clock().tick, replay.ticks());
            let cut_off = if replay.is_whole { "" } else { "; the recording was cut off there" };
            writeln!(out, "{ticks} of {all} ticks are as they were recorded{cut_off}")?;
        }
        Ok(Ending::of_run(interrupt.is_asked()))
    }
}

/// Plays what was recorded, up to where it parts.
fn compare(replay: &Replay, game: &mut Match, interrupt: &Interrupt) -> Result<(), Parting> {
    let bar = progress_bar(replay.ticks(), "{bar:40} tick {pos} of {len}, {eta} left");
    let mut comparison = Comparison::with(replay);
    for tick in 0..replay.ticks() {
        if interrupt.is_asked() {
            break;
        }
        game.tick();
        comparison.check(game.world_mut())?;
        if tick.is_multiple_of(600) {
            bar.set_position(tick);
        }
    }
    bar.finish_and_clear();
    Ok(())
}
