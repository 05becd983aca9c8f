//! `touchline run`: a match without a window, as fast as it goes.

use std::io::{self, Write};
use std::time::{Duration, Instant};

use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;

use super::box_report::BoxReport;
use super::ending::{CommandError, Ending, tell};
use super::interrupt::Interrupt;
use super::options::{HostOptions, MatchOptions, SeedOption};
use crate::comms::radio::{LinkCounters, RadioRecord};
use crate::comms::tcm::{MessageBudgets, Spent};
use crate::data::{AssetFolder, in_one_line};
use crate::game::net::{self, Awaited, CarrierFigures, RemoteFigures, UdpCarrier};
use crate::game::record::{BallOverlap, BookingFigures};
use crate::game::{Match, MatchPlan};
use crate::ids::Team;
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

/// The result of a match, home first where there are two figures.
#[derive(Debug, Serialize)]
struct RunReport {
    name: String,
    teams: [String; 2],
    seed: u64,
    score: [u32; 2],
    /// Shares of the time in which either team had the ball.
    possession: [f64; 2],
    /// Share of play with two or more team mates within a metre of the ball.
    crowding: [f64; 2],
    /// Share of play with two or more team mates within half a metre of the ball.
    agglomeration: [f64; 2],
    /// How well each team's ball booking met its requirements.
    bookings: [BookingFigures; 2],
    /// How deep the ball has sunk into robots and walls.
    overlap: BallOverlap,
    /// Metres, all robots of a team together.
    driven: [f64; 2],
    /// What a team's robots said to each other.
    messages: [Messages; 2],
    /// What the teams said as the league counts it, where the match is announced or keeps to the league's limits.
    #[serde(skip_serializing_if = "Option::is_none")]
    budgets: Option<[TeamBudget; 2]>,
    /// Counts of the datagrams that crossed a network.
    #[serde(skip_serializing_if = "Option::is_none")]
    network: Option<Network>,
    /// What was heard of the referee box that refereed it.
    #[serde(skip_serializing_if = "Option::is_none")]
    referee_box: Option<BoxReport>,
    /// Simulated seconds.
    seconds: f64,
    ticks: u64,
    /// Depends on the machine.
    ticks_per_second: f64,
    /// Equal digests mean equal matches.
    digest: String,
    /// Whether it is the result so far of a match that did not come to its end.
    interrupted: bool,
}

/// A team's messages, each datagram once however many robots hear it.
#[derive(Debug, Serialize)]
struct TeamBudget {
    #[serde(flatten)]
    spent: Spent,
    left: u64,
}

impl TeamBudget {
    fn of(game: &Match) -> Option<[TeamBudget; 2]> {
        let budgets = game.world().get_resource::<MessageBudgets>()?;
        Some(Team::BOTH.map(|team| TeamBudget { spent: budgets.spent(team), left: budgets.left(team) }))
    }
}

/// What crossed a network: the datagrams of the robots that this process ran, and how the others answered.
#[derive(Debug, Serialize)]
struct Network {
    here: CarrierFigures,
    elsewhere: Vec<RemoteFigures>,
}

impl Network {
    fn of(game: &Match) -> Option<Network> {
        let carrier = game.world().get_resource::<UdpCarrier>()?;
        Some(Network { here: carrier.figures, elsewhere: net::remote_figures(game.world()) })
    }

    fn print(&self, out: &mut impl Write) -> io::Result<()> {
        let here = self.here;
        writeln!(
            out,
            "datagrams   {:6} sent and {} received by the robots of this process",
            here.sent, here.received
        )?;
        writeln!(
            out,
            "            {:6} from computers, {} from nobody we know, {} not sent",
            here.from_computers, here.foreign, here.refused
        )?;
        for robot in &self.elsewhere {
            writeln!(
                out,
                "{:11} {:6} ticks told, {} answered; {} datagrams sent and {} received",
                robot.robot.to_string(),
                robot.told,
                robot.answered,
                robot.sent,
                robot.received
            )?;
        }
        Ok(())
    }
}

/// The packets of a team: a message to three team mates is three.
#[derive(Debug, Serialize)]
struct Messages {
    sent: u64,
    delivered: u64,
    lost: u64,
    late: u64,
    bytes: u64,
}

impl Messages {
    fn of(team: Team, radio: &RadioRecord) -> Messages {
        let all = radio.sum(|from, _, _| from.team == team);
        let LinkCounters { sent, delivered, late, bytes, .. } = all;
        Messages { sent, delivered, lost: all.lost_in_all(), late, bytes }
    }
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
    Ok(if report.interrupted { Ending::Interrupted } else { Ending::Done })
}

fn play_on(
    game: &mut Match,
    plan: &MatchPlan,
    started: Instant,
    interrupt: &Interrupt,
) -> Result<(), CommandError> {
    let bar = progress(plan);
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

/// A bar in simulated seconds; shown only on a terminal that can go back in a line.
fn progress(plan: &MatchPlan) -> ProgressBar {
    let seconds = plan.rules.half_seconds() * f64::from(RuleBook::HALVES);
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} s of play, {msg}, {eta} left");
    let is_dumb = std::env::var_os("TERM").is_some_and(|terminal| terminal == "dumb");
    let target = if is_dumb { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let bar = ProgressBar::with_draw_target(Some(seconds as u64), target);
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

impl RunReport {
    fn of(game: &Match, plan: &MatchPlan, wall_seconds: f64) -> RunReport {
        let (record, clock) = (game.record(), game.clock());
        RunReport {
            name: plan.name.clone(),
            teams: plan.teams.each_ref().map(|team| team.strategy.name.clone()),
            seed: plan.seed,
            score: game.state().score,
            possession: record.possession_shares(),
            crowding: record.crowding.map(|seconds| share(seconds, record.played)),
            agglomeration: record.agglomeration.map(|seconds| share(seconds, record.played)),
            bookings: record.bookings,
            overlap: record.overlap,
            driven: Team::BOTH.map(|team| record.driven_by(team)),
            messages: Team::BOTH.map(|team| Messages::of(team, game.world().resource::<RadioRecord>())),
            budgets: TeamBudget::of(game),
            network: Network::of(game),
            referee_box: BoxReport::of(game),
            seconds: clock.now(),
            ticks: clock.tick,
            ticks_per_second: share(clock.tick as f64, wall_seconds),
            digest: format!("{:016x}", record.digest),
            interrupted: !game.is_over(),
        }
    }

    fn print(&self, out: &mut impl Write) -> io::Result<()> {
        if self.interrupted {
            writeln!(out, "interrupted after {:.0} s; the result so far:", self.seconds)?;
        }
        let [home, away] = self.teams.each_ref().map(|name| in_one_line(name));
        writeln!(out, "{home} {} : {} {away}", self.score[0], self.score[1])?;
        let percent = |[home, away]: [f64; 2]| format!("{:4.0} % : {:.0} %", 100.0 * home, 100.0 * away);
        writeln!(out, "possession  {}", percent(self.possession))?;
        writeln!(out, "crowding    {}", percent(self.crowding))?;
        writeln!(out, "driven      {:4.0} m : {:.0} m", self.driven[0], self.driven[1])?;
        let [home, away] = &self.messages;
        writeln!(out, "messages    {:6} : {} ({} and {} lost)", home.sent, away.sent, home.lost, away.lost)?;
        if let Some([home, away]) = &self.budgets {
            writeln!(out, "budget      {:6} : {} messages left of the league's", home.left, away.left)?;
            let held_back = [home, away].map(|team| team.spent.over_budget);
            if held_back.iter().any(|messages| *messages > 0) {
                writeln!(
                    out,
                    "            {:6} : {} not sent, to keep within it",
                    held_back[0], held_back[1]
                )?;
            }
        }
        if let Some(network) = &self.network {
            network.print(out)?;
        }
        if let Some(referee_box) = &self.referee_box {
            referee_box.print(out)?;
        }
        let pace = share(self.ticks_per_second * self.seconds, self.ticks as f64);
        writeln!(
            out,
            "{:.0} s in {} ticks, {:.0} ticks/s, {pace:.0} times real time",
            self.seconds, self.ticks, self.ticks_per_second
        )?;
        writeln!(out, "seed {}, digest {}", self.seed, self.digest)
    }
}

/// A part of a whole; nothing of nothing is 0, since JSON has no other number for it.
fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;

    fn numbers(value: &Value) -> Vec<f64> {
        match value {
            Value::Number(number) => number.as_f64().into_iter().collect(),
            Value::Null => vec![f64::NAN],
            Value::Array(items) => items.iter().flat_map(numbers).collect(),
            Value::Object(fields) => fields.values().flat_map(numbers).collect(),
            Value::Bool(_) | Value::String(_) => Vec::new(),
        }
    }

    #[test]
    fn the_result_of_a_match_that_never_began_has_a_number_in_each_place() {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let plan = MatchPlan::read(&assets, &crate::game::Choice::default()).expect("the default match");
        let report = RunReport::of(&Match::new(&plan), &plan, 0.0);
        assert!(report.interrupted);
        let numbers = numbers(&serde_json::to_value(&report).expect("the report is JSON"));
        assert!(numbers.len() > 20 && numbers.iter().all(|number| number.is_finite()), "{numbers:?}");
        let mut text = Vec::new();
        report.print(&mut text).expect("memory takes everything");
        let text = String::from_utf8_lossy(&text);
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    }
}
