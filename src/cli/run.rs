//! `touchline run`: a match without a window, as fast as it goes.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use super::MatchOptions;
use crate::data::{AssetFolder, DataError};
use crate::game::{Match, MatchPlan};
use crate::ids::Team;
use crate::radio::{LinkCounters, Traffic};
use crate::record::{BallOverlap, BookingFigures};
use crate::referee::RuleBook;
use crate::tcm::{MessageBudgets, Spent};
use crate::wire::{self, Awaited, CarrierFigures, RemoteFigures, UdpCarrier};

#[derive(Args, Debug, Default)]
pub(super) struct Run {
    #[command(flatten)]
    options: MatchOptions,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
}

/// The result of a match, home first where there are two figures.
#[derive(Debug, Serialize)]
struct Report {
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
    /// What became of the datagrams that crossed a network.
    #[serde(skip_serializing_if = "Option::is_none")]
    network: Option<Network>,
    /// Simulated seconds.
    seconds: f64,
    ticks: u64,
    /// Depends on the machine.
    ticks_per_second: f64,
    /// Equal digests mean equal matches.
    digest: String,
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
        Some(Network { here: carrier.figures, elsewhere: wire::remote_figures(game.world()) })
    }

    fn print(&self) {
        let here = self.here;
        println!(
            "datagrams   {:6} sent and {} received by the robots of this process",
            here.sent, here.received
        );
        println!(
            "            {:6} from computers, {} from nobody we know, {} not sent",
            here.from_computers, here.foreign, here.refused
        );
        for robot in &self.elsewhere {
            println!(
                "{:11} {:6} ticks told, {} answered; {} datagrams sent and {} received",
                robot.robot.to_string(),
                robot.told,
                robot.answered,
                robot.sent,
                robot.received
            );
        }
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
    fn of(team: Team, traffic: &Traffic) -> Messages {
        let links = traffic.links().filter(|(from, ..)| from.team == team);
        let all: LinkCounters = links.map(|(.., counters)| *counters).sum();
        let LinkCounters { sent, delivered, late, bytes, .. } = all;
        Messages { sent, delivered, lost: all.lost_in_all(), late, bytes }
    }
}

impl Run {
    pub(super) fn run(&self, assets: &AssetFolder) -> Result<ExitCode, DataError> {
        let plan = self.options.plan(assets, None)?;
        play_headless(&plan, self.json, self.options.patience())?;
        Ok(ExitCode::SUCCESS)
    }
}

/// Plays a match to its end and prints the result; waits so long for its robots in other processes.
///
/// # Errors
/// If the match needs a network that is not to be had.
pub(super) fn play_headless(plan: &MatchPlan, json: bool, patience: Duration) -> Result<(), DataError> {
    let bar = progress(plan);
    let started = Instant::now();
    let mut game = Match::new(plan);
    wire::open(game.world_mut(), plan)?;
    await_robots(&mut game, patience)?;
    while !game.is_over() {
        if wire::is_in_real_time(plan) {
            wait_until(started + Duration::from_secs_f64(game.clock().now()));
        }
        game.tick();
        if game.clock().tick.is_multiple_of(REPORT_EVERY) {
            let [home, away] = game.state().score;
            bar.set_message(format!("{home}:{away}"));
            bar.set_position(game.record().played as u64);
        }
    }
    wire::finish(game.world_mut());
    bar.finish_and_clear();
    let report = Report::of(&game, plan, started.elapsed().as_secs_f64());
    if json {
        println!("{}", serde_json::to_string_pretty(&report).unwrap_or_else(|error| error.to_string()));
    } else {
        report.print();
    }
    Ok(())
}

/// Waits for robots in other processes, and says so if it takes more than a moment.
fn await_robots(game: &mut Match, patience: Duration) -> Result<(), DataError> {
    let begin = Instant::now();
    let mut is_said = false;
    let mut goes_on = |awaited: &[Awaited]| {
        if !is_said && begin.elapsed() > MOMENT {
            for Awaited { robot, address, .. } in awaited {
                eprintln!("waiting for {robot} at {address}; start it with `{}`", wire::start(*robot));
            }
            is_said = true;
        }
        true
    };
    wire::greet(game.world_mut(), patience, &mut goes_on)?;
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

/// A bar in simulated seconds; shown on a terminal only.
fn progress(plan: &MatchPlan) -> ProgressBar {
    let seconds = plan.rules.half_seconds() * f64::from(RuleBook::HALVES);
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} s of play, {msg}, {eta} left");
    ProgressBar::new(seconds as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

impl Report {
    fn of(game: &Match, plan: &MatchPlan, wall_seconds: f64) -> Report {
        let (record, clock) = (game.record(), game.clock());
        Report {
            name: plan.name.clone(),
            teams: plan.teams.each_ref().map(|team| team.strategy.name.clone()),
            seed: plan.seed,
            score: game.state().score,
            possession: record.possession_shares(),
            crowding: record.crowding.map(|seconds| seconds / record.played.max(f64::EPSILON)),
            agglomeration: record.agglomeration.map(|seconds| seconds / record.played.max(f64::EPSILON)),
            bookings: record.bookings,
            overlap: record.overlap,
            driven: Team::BOTH.map(|team| record.driven_by(team)),
            messages: Team::BOTH.map(|team| Messages::of(team, game.world().resource::<Traffic>())),
            budgets: TeamBudget::of(game),
            network: Network::of(game),
            seconds: clock.now(),
            ticks: clock.tick,
            ticks_per_second: clock.tick as f64 / wall_seconds,
            digest: format!("{:016x}", record.digest),
        }
    }

    fn print(&self) {
        let [home, away] = &self.teams;
        println!("{home} {} : {} {away}", self.score[0], self.score[1]);
        println!("possession  {:4.0} % : {:.0} %", 100.0 * self.possession[0], 100.0 * self.possession[1]);
        println!("crowding    {:4.0} % : {:.0} %", 100.0 * self.crowding[0], 100.0 * self.crowding[1]);
        println!("driven      {:4.0} m : {:.0} m", self.driven[0], self.driven[1]);
        let [home, away] = &self.messages;
        println!("messages    {:6} : {} ({} and {} lost)", home.sent, away.sent, home.lost, away.lost);
        if let Some([home, away]) = &self.budgets {
            println!("budget      {:6} : {} messages left of the league's", home.left, away.left);
            let held_back = [home, away].map(|team| team.spent.over_budget);
            if held_back.iter().any(|messages| *messages > 0) {
                println!("            {:6} : {} not sent, to keep within it", held_back[0], held_back[1]);
            }
        }
        if let Some(network) = &self.network {
            network.print();
        }
        let pace = self.ticks_per_second * self.seconds / self.ticks as f64;
        println!(
            "{:.0} s in {} ticks, {:.0} ticks/s, {pace:.0} times real time",
            self.seconds, self.ticks, self.ticks_per_second
        );
        println!("seed {}, digest {}", self.seed, self.digest);
    }
}
