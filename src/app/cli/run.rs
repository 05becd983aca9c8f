//! `touchline run`: a match without a window, as fast as it goes.

use std::io::Write;
use std::time::{Duration, Instant};

use clap::Args;

use super::ending::{CommandError, Ending, print_json, tell};
use super::heavy;
use super::interrupt::Interrupt;
use super::options::{HostOptions, MatchOptions, SeedOption};
use super::progress::progress_bar;
use super::recording::{self, RecordOption};
use super::run_report::RunReport;
use crate::data::AssetFolder;
use crate::game::net::{self, Awaited};
use crate::game::record::Invariants;
use crate::game::{Match, MatchPlan};
use crate::lab::replay::{Recorded, Recorder, ReplayHeader};
use crate::world::referee::RuleBook;

#[derive(Args, Debug, Default)]
pub(super) struct RunCommand {
    #[command(flatten)]
    options: MatchOptions,
    #[command(flatten)]
    host: HostOptions,
    #[command(flatten)]
    seed: SeedOption,
    #[command(flatten)]
    record: RecordOption,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
    /// Play each tick twice, from a copy of the whole match, and end at the first thing that comes out differently. Many times
    /// slower; not for matches that cross sockets.
    #[arg(long)]
    heavy: bool,
    /// End with the exit code 3 if an invariant was broken that holds whatever the radio does.
    #[arg(long)]
    strict: bool,
}

impl RunCommand {
    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        let choice = self.host.choice(&self.options, &self.seed)?;
        if self.heavy {
            heavy::check(&choice.network)?;
        }
        let (header, (plan, _)) = ReplayHeader::of(Recorded::Match(choice), assets)?;
        let run = HeadlessRun {
            plan: &plan,
            patience: self.options.patience(),
            interrupt: Interrupt::listen(),
            recorder: self.record.begin(header)?,
            heavy: self.heavy,
            strict: self.strict,
        };
        run.play(self.json, out)
    }
}

/// A match that is to be played to its end, or until it is interrupted.
pub(super) struct HeadlessRun<'a> {
    pub plan: &'a MatchPlan,
    /// How long it waits for its robots in other processes.
    pub patience: Duration,
    pub interrupt: Interrupt,
    pub recorder: Option<Recorder>,
    /// Whether each tick is played twice.
    pub heavy: bool,
    /// Whether a broken invariant is a failure.
    pub strict: bool,
}

impl HeadlessRun<'_> {
    /// Plays it and prints the result.
    ///
    /// # Errors
    /// If the match needs a network that is not to be had, or the result cannot be printed.
    pub fn play(mut self, json: bool, out: &mut impl Write) -> Result<Ending, CommandError> {
        let started = Instant::now();
        let mut game = Match::new(self.plan);
        net::open(game.world_mut(), self.plan)?;
        await_robots(&mut game, self.patience, &self.interrupt)?;
        let played = self.play_on(&mut game, started);
        net::finish(game.world_mut());
        self.recorder.take().map_or(Ok(()), recording::finish)?;
        played?;
        let report = RunReport::of(&game, self.plan, started.elapsed().as_secs_f64());
        if json {
            print_json(&report, out)?;
        } else {
            report.print(out)?;
        }
        Ok(ending(self.strict, report.interrupted, game.world().resource::<Invariants>()))
    }

    fn play_on(&mut self, game: &mut Match, started: Instant) -> Result<(), CommandError> {
        let seconds = self.plan.rules.half_seconds() * f64::from(RuleBook::HALVES);
        let bar = progress_bar(seconds as u64, "{bar:40} {pos}/{len} s of play, {msg}, {eta} left");
        while !game.is_over() && !self.interrupt.is_asked() {
            if self.plan.network.is_in_real_time() {
                wait_until(started + Duration::from_secs_f64(game.clock().now()));
            }
            if self.heavy {
                heavy::tick_twice(game)?;
            } else {
                game.tick();
            }
            self.recorder.as_mut().map_or(Ok(()), |recorder| recording::note(recorder, game))?;
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
}

/// How a match ends that was played.
fn ending(strict: bool, interrupted: bool, invariants: &Invariants) -> Ending {
    match strict && invariants.is_unsafe() {
        true => Ending::Unsafe,
        false => Ending::of_run(interrupted),
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::record::{BreachCount, Invariant};

    #[test]
    fn only_a_strict_run_fails_and_only_by_what_holds_whatever_the_radio_does() {
        let code = |strict, broken: &[Invariant]| {
            let mut invariants = Invariants::default();
            let broken = broken.iter().map(|invariant| ((*invariant, None), BreachCount::default()));
            invariants.broken.extend(broken);
            ending(strict, true, &invariants) as u8
        };
        assert_eq!(code(true, &[Invariant::OneRobotARole, Invariant::LockIsGivenBack]), 3);
        assert_eq!(code(false, &[Invariant::LockIsGivenBack]), 130);
        assert_eq!(code(true, &[Invariant::OneRobotARole]), 130);
    }
}
