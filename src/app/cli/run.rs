//! `touchline run`: a match without a window, as fast as it goes.

use std::io::Write;
use std::time::{Duration, Instant};

use clap::Args;

use super::ending::{CommandError, Ending, tell};
use super::interrupt::Interrupt;
use super::options::{HostOptions, MatchOptions, SeedOption};
use super::progress::progress_bar;
use super::run_report::RunReport;
use crate::data::AssetFolder;
use crate::game::net::{self, Awaited};
use crate::game::{Match, MatchPlan};
use crate::world::referee::RuleBook;

#[derive(Args, Debug, Default)]
pub(super) struct RunCommand {
    #[command(flatten)]
    options: MatchOptions,
    #[command(flatten)]
    host: HostOptions,
    #[command(flatten)]
    seed: SeedOption,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
}

impl RunCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let choice = self.host.choice(&self.options, &self.seed)?;
        let plan = MatchPlan::read(assets, &choice)?;
        play_headless(&plan, self.json, self.options.patience(), &Interrupt::listen(), out)
    }
}

/// Plays a match to its end, or until it is interrupted, and prints the result; waits so long for its robots in other
/// processes.
///
/// # Errors
/// If the match needs a network that is not to be had, or the result cannot be printed.
pub(super) fn play_headless(
    plan: &MatchPlan,
    json: bool,
    patience: Duration,
    interrupt: &Interrupt,
    out: &mut impl Write,
) -> Result<Ending, CommandError> {
    let started = Instant::now();
    let mut game = Match::new(plan);
    net::open(game.world_mut(), plan)?;
    await_robots(&mut game, patience, interrupt)?;
    play_on(&mut game, plan, started, interrupt)?;
    net::finish(game.world_mut());
    let report = RunReport::of(&game, plan, started.elapsed().as_secs_f64());
    if json {
        super::ending::print_json(&report, out)?;
    } else {
        report.print(out)?;
    }
    Ok(Ending::of_run(report.interrupted))
}

fn play_on(
    game: &mut Match,
    plan: &MatchPlan,
    started: Instant,
    interrupt: &Interrupt,
) -> Result<(), CommandError> {
    let seconds = plan.rules.half_seconds() * f64::from(RuleBook::HALVES);
    let bar = progress_bar(seconds as u64, "{bar:40} {pos}/{len} s of play, {msg}, {eta} left");
    while !game.is_over() && !interrupt.is_asked() {
        if plan.network.is_in_real_time() {
            wait_until(started + Duration::from_secs_f64(game.clock().now()));
        }
        game.tick();
        net::check_patience(game.world())?;
        if game.clock().tick.is_multiple_of(REPORT_EVERY) {
            let [home, away] = game.state().score;
            bar.set_message(format!("{home}:{away}"));
            bar.set_position(game.record().played as u64);
        }
    }
    bar.finish_and_clear();
    Ok(())
}

/// Waits for robots in other processes, and says so if it takes more than a moment.
fn await_robots(game: &mut Match, patience: Duration, interrupt: &Interrupt) -> Result<(), CommandError> {
    let begin = Instant::now();
    let mut is_said = false;
    let mut goes_on = |awaited: &[Awaited]| {
        if !is_said && begin.elapsed() > MOMENT {
            for Awaited { robot, address, .. } in awaited {
                tell(format_args!(
                    "waiting for {robot} at {address}; start it with `{}`",
                    net::start(*robot)
                ));
            }
            is_said = true;
        }
        !interrupt.is_asked()
    };
    net::greet(game.world_mut(), patience, &mut goes_on)?;
    Ok(())
}

/// Robots that were started before their match answer within this time.
const MOMENT: Duration = Duration::from_millis(400);

/// Sleeps until then; not at all, if it is past.
fn wait_until(then: Instant) {
    std::thread::sleep(then.saturating_duration_since(Instant::now()));
}

/// Ticks between two updates of the progress bar.
const REPORT_EVERY: u64 = 600;
