//! The command line. One file a subcommand; what goes wrong with a user's input ends in one line and exit code 2.

mod check;
mod play;
mod robot;
mod run;

use std::net::{IpAddr, SocketAddr};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::{ArgGroup, Args, Parser, Subcommand};

use crate::data::{AssetFolder, DataError};
use crate::game::{Choice, MatchPlan};
use crate::gamecontroller::control::Version;
use crate::ids::RobotId;
use crate::wire::{self, WirePlan};

/// Robot soccer between teams of behaviour-based robots. Without a command it opens the window.
#[derive(Debug, Parser)]
#[command(name = "touchline", version)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    /// The folder with strategies, pitches, robots and matches.
    #[arg(long, global = true, value_name = "FOLDER")]
    assets: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Open the window and play; without a display, play headless.
    Play(play::Play),
    /// Play a match headless, as fast as it goes, and print the result.
    Run(run::Run),
    /// Play one robot of a match that is elsewhere: its teamwork and its behaviour, over UDP.
    Robot(robot::Robot),
    /// Read asset files and say what is wrong with them.
    Check(check::Check),
}

/// What a person may change of a match; the same for `play` and `run`.
#[derive(Args, Clone, Debug, Default)]
#[command(group = ArgGroup::new("league").args(["announce", "league_ports"]).multiple(true))]
struct MatchOptions {
    /// The match: a name among the assets or a path.
    #[arg(long = "match", value_name = "MATCH")]
    file: Option<String>,
    /// The home team's strategy: a name among the assets or a path.
    #[arg(long, value_name = "STRATEGY")]
    home: Option<String>,
    /// The away team's strategy.
    #[arg(long, value_name = "STRATEGY")]
    away: Option<String>,
    /// The radio: a name among the assets or a path, or `udp` for real sockets.
    #[arg(long, value_name = "RADIO")]
    radio: Option<String>,
    /// Where robots and computers are, as a file; robots have ports of this machine from 7400 on if not given.
    #[arg(long, value_name = "FILE")]
    addresses: Option<PathBuf>,
    /// A robot that is a process of its own, such as `home:1`; may be given several times. Implies `--radio udp`.
    #[arg(long, value_name = "ROBOT")]
    remote: Vec<RobotId>,
    /// Let a referee box referee the match: the address that its packets are sent to, such as 127.0.0.1:3838.
    #[arg(long, value_name = "ADDRESS")]
    gamecontroller: Option<SocketAddr>,
    /// Announce the match in the GameController's format to this address, such as 192.168.1.255:3838 or [::1]:3838.
    #[arg(long, value_name = "ADDRESS")]
    announce: Option<SocketAddr>,
    /// The version of what is announced, and of the league's limits: 18, 19 or 20; 20 if not given.
    #[arg(long, value_name = "VERSION", value_parser = version, requires = "league")]
    announce_version: Option<Version>,
    /// Send each team message to this host, too, at the league's port 10000 + team number, where referee boxes count them;
    /// robots then keep to the league's budget and length of messages.
    #[arg(long, value_name = "HOST", conflicts_with = "remote")]
    league_ports: Option<IpAddr>,
    /// How many seconds `run` waits for robots in other processes before the match begins, and `robot` for word of its match;
    /// 20 if not given.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    patience: Option<Duration>,
    /// Equal seeds give equal matches; 1 if not given.
    #[arg(long)]
    seed: Option<u64>,
    /// Minutes of a half.
    #[arg(long, value_name = "MINUTES")]
    minutes: Option<f32>,
}

impl MatchOptions {
    fn choice(&self, pilot: Option<RobotId>) -> Choice {
        let by_udp = self.radio.as_deref() == Some(UDP);
        let wires = WirePlan {
            udp: by_udp || !self.remote.is_empty(),
            remote: self.remote.clone(),
            gamecontroller: self.gamecontroller,
            announce: self.announce,
            league_ports: self.league_ports,
            version: self.announce_version.unwrap_or_default(),
        };
        Choice {
            file: self.file.clone(),
            home: self.home.clone(),
            away: self.away.clone(),
            radio: self.radio.clone().filter(|_| !by_udp),
            addresses: self.addresses.clone(),
            wires: Box::new(wires),
            half_minutes: self.minutes,
            seed: self.seed.unwrap_or(1),
            pilot,
        }
    }

    fn patience(&self) -> Duration {
        self.patience.unwrap_or(wire::PATIENCE)
    }

    fn plan(&self, assets: &AssetFolder, pilot: Option<RobotId>) -> Result<MatchPlan, DataError> {
        MatchPlan::read(assets, &self.choice(pilot))
    }
}

/// Reads the number of a version of the GameController's format.
fn version(text: &str) -> Result<Version, String> {
    let version = text.parse().ok().and_then(Version::from_number);
    version.ok_or_else(|| "must be 18, 19 or 20".into())
}

/// Reads a time of up to a day.
fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse::<f32>().ok().filter(|seconds| (0.0..=86_400.0).contains(seconds));
    seconds.map(Duration::from_secs_f32).ok_or_else(|| "must be a number of seconds, from 0 to 86400".into())
}

/// The radio that is none: team messages go by UDP.
const UDP: &str = "udp";

/// Rapier warns of a setting that is meant.
const LOGGED: &str = "info,bevy_rapier2d=error";

/// What is worth a line goes to the standard error stream; the window has its own log.
fn log_to_stderr() {
    use bevy::log::tracing_subscriber::fmt;
    let subscriber = fmt().with_env_filter(LOGGED).with_target(false).without_time();
    // Whoever has set another log before keeps it.
    let _ = subscriber.with_writer(std::io::stderr).try_init();
}

/// Bad input.
const BAD_INPUT: u8 = 2;

/// Runs the program with the arguments of this process.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    if !matches!(cli.command, None | Some(Command::Play(_))) {
        log_to_stderr();
    }
    let done = AssetFolder::find(cli.assets.as_deref()).and_then(|assets| match cli.command {
        None => play::Play::default().run(&assets),
        Some(Command::Play(play)) => play.run(&assets),
        Some(Command::Run(run)) => run.run(&assets),
        Some(Command::Robot(robot)) => robot.run(&assets),
        Some(Command::Check(check)) => check.run(&assets),
    });
    done.unwrap_or_else(|error| {
        eprintln!("{error}");
        ExitCode::from(BAD_INPUT)
    })
}
