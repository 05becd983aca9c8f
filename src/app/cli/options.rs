//! What a person may change of a match on the command line.

use std::fmt::Display;
use std::net::{IpAddr, SocketAddr};
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::Duration;

use clap::{ArgGroup, Args};

use crate::data::{AssetFolder, DataError};
use crate::game::net::chaos::ChaosPlan;
use crate::game::net::{self, NetworkPlan};
use crate::game::{Choice, MatchPlan};
use crate::ids::RobotId;
use crate::rng::{DEFAULT_SEED, LARGEST_SEED};
use crate::world::gamecontroller::control::Version;

/// Which match, and who plays in it.
#[derive(Args, Clone, Debug, Default)]
pub(super) struct TeamsOptions {
    /// The match: a name among the assets or a path.
    #[arg(long = "match", value_name = "MATCH")]
    pub file: Option<String>,
    /// The home team's strategy: a name among the assets or a path; that of the match if not given.
    #[arg(long, value_name = "STRATEGY")]
    pub home: Option<String>,
    /// The away team's strategy.
    #[arg(long, value_name = "STRATEGY")]
    pub away: Option<String>,
}

/// The match, for a process that plays it and for one that plays a robot of it.
#[derive(Args, Clone, Debug, Default)]
pub(super) struct MatchOptions {
    #[command(flatten)]
    teams: TeamsOptions,
    /// Where robots and computers are, as a file; robots have ports of this machine from 7400 on if not given.
    #[arg(long, value_name = "FILE")]
    addresses: Option<PathBuf>,
    /// How many seconds `run` waits for robots in other processes before the match begins, and `robot` for word of its match;
    /// 20 if not given.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    patience: Option<Duration>,
}

/// What only the process that plays the match decides.
#[derive(Args, Clone, Debug, Default)]
#[command(group = ArgGroup::new("league").args(["announce", "league_ports"]).multiple(true))]
pub(super) struct HostOptions {
    /// The radio: a name among the assets or a path, or `udp` for real sockets.
    #[arg(long, value_name = "RADIO")]
    radio: Option<String>,
    /// A robot that is a process of its own, such as `home:1`; may be given several times. Implies `--radio udp`.
    #[arg(long, value_name = "ROBOT")]
    remote: Vec<RobotId>,
    /// Let a referee box referee the match: the address that its packets are sent to, such as 127.0.0.1:3838.
    #[arg(long, value_name = "ADDRESS")]
    gamecontroller: Option<SocketAddr>,
    /// The league's numbers of home and away, such as 6,9: the referee box of this match is followed, and no other, and the
    /// match is announced with them. Without them, those of the match file; if it has none, the first box decides.
    #[arg(long, value_name = "HOME,AWAY", value_parser = team_numbers)]
    team_numbers: Option<[u8; 2]>,
    /// Give up a match without a window if no referee box is heard within this time; refused in the window, which a person can leave.
    #[arg(long, value_name = "SECONDS", value_parser = seconds, requires = "gamecontroller")]
    wait_for_box: Option<Duration>,
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
    /// Let ChaosManager look into robots of this match, set their cameras and drive them: the first of three ports in a row,
    /// such as 127.0.0.1:7500. A match without a window then keeps to real time.
    #[arg(long, value_name = "ADDRESS")]
    chaos: Option<SocketAddr>,
    /// The addresses that ChaosManager may speak from, with commas between; this machine only if not given.
    #[arg(long, value_name = "HOST,HOST", value_delimiter = ',', requires = "chaos")]
    chaos_from: Vec<IpAddr>,
    /// Minutes of a half.
    #[arg(long, value_name = "MINUTES")]
    minutes: Option<f32>,
}

#[derive(Args, Clone, Debug, Default)]
pub(super) struct SeedOption {
    /// Equal seeds give equal matches; 1 if not given, 9007199254740991 at most.
    #[arg(long, value_parser = clap::value_parser!(u64).range(..=LARGEST_SEED))]
    pub seed: Option<u64>,
}

impl SeedOption {
    /// The seed of a match.
    pub fn of_match(&self) -> u64 {
        self.seed.unwrap_or(DEFAULT_SEED)
    }
}

/// What reads a number of such things that lies between these two.
pub(super) fn number_of<N>(
    things: &'static str,
    range: RangeInclusive<N>,
) -> impl Fn(&str) -> Result<N, String> + Clone
where
    N: FromStr + PartialOrd + Display + Clone,
{
    move |text| {
        let number = text.parse().ok().filter(|number| range.contains(number));
        number
            .ok_or_else(|| format!("must be a number of {things}, from {} to {}", range.start(), range.end()))
    }
}

/// Reads a time of up to a day.
pub(super) fn seconds(text: &str) -> Result<Duration, String> {
    number_of("seconds", 0.0..=86_400.0)(text).map(Duration::from_secs_f32)
}

/// Reads two numbers with a comma between.
fn team_numbers(text: &str) -> Result<[u8; 2], String> {
    let number = |text: &str| text.trim().parse::<u8>().ok();
    let numbers = text.split_once(',').and_then(|(home, away)| Some([number(home)?, number(away)?]));
    numbers.ok_or_else(|| "must be the numbers of home and away, 0 to 254, such as 6,9".into())
}

/// Reads the number of a version of the GameController's format.
fn version(text: &str) -> Result<Version, String> {
    let version = text.parse().ok().and_then(Version::from_number);
    version.ok_or_else(|| "must be 18, 19 or 20".into())
}

/// The radio that is none: team messages go by UDP.
const UDP: &str = "udp";

impl MatchOptions {
    /// The match as a process takes part in it that plays one of its robots.
    pub fn choice(&self, seed: &SeedOption) -> Choice {
        Choice {
            file: self.teams.file.clone(),
            home: self.teams.home.clone(),
            away: self.teams.away.clone(),
            addresses: self.addresses.clone(),
            seed: seed.of_match(),
            ..Choice::default()
        }
    }

    pub fn patience(&self) -> Duration {
        self.patience.unwrap_or(net::PATIENCE)
    }

    pub fn plan(&self, assets: &AssetFolder, seed: &SeedOption) -> Result<MatchPlan, DataError> {
        MatchPlan::read(assets, &self.choice(seed))
    }
}

impl HostOptions {
    /// The match as it is played here.
    ///
    /// # Errors
    /// If options contradict each other, or one has no effect.
    pub fn choice(&self, of: &MatchOptions, seed: &SeedOption) -> Result<Choice, DataError> {
        let network = self.network()?;
        if of.patience.is_some() && network.remote.is_empty() {
            return Err(DataError::new("--patience", "has no effect on a match without `--remote`"));
        }
        if of.addresses.is_some() && !network.udp {
            let message = "has no effect on a simulated radio: add `--radio udp` or `--remote`";
            return Err(DataError::new("--addresses", message));
        }
        Ok(Choice {
            radio: self.radio.clone().filter(|radio| radio != UDP),
            network: Box::new(network),
            half_minutes: self.minutes,
            ..of.choice(seed)
        })
    }

    fn network(&self) -> Result<NetworkPlan, DataError> {
        let HostOptions { remote, gamecontroller, announce, .. } = self;
        if let Some(twice) = remote.iter().enumerate().find(|(i, robot)| remote[..*i].contains(robot)) {
            return Err(DataError::new("--remote", format!("{} is given twice", twice.1)));
        }
        if let Some(radio) = self.radio.as_ref().filter(|radio| *radio != UDP && !remote.is_empty()) {
            let message =
                format!("`{radio}` does not reach robots of other processes; `--remote` needs `udp`");
            return Err(DataError::new("--radio", message));
        }
        Ok(NetworkPlan {
            udp: self.radio.as_deref() == Some(UDP) || !remote.is_empty(),
            remote: remote.clone(),
            gamecontroller: *gamecontroller,
            announce: *announce,
            league_ports: self.league_ports,
            version: self.announce_version.unwrap_or_default(),
            team_numbers: self.team_numbers,
            wait_for_box: self.wait_for_box,
            chaos: self.chaos.map(|at| ChaosPlan { at, from: self.chaos_from.clone() }),
        })
    }
}
