//! What is played: the match file, what the command line or the menu changes of it, and the plan with every file read.

use std::ffi::OsStr;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::files::{checked, file_named, read_addresses};
use super::situation::Situation;
use super::team::{TeamFile, TeamPlan, fit, give_roles, read_strategy};
use crate::comms::radio::{FaultRule, Radio};
use crate::comms::tcm::{Directory, HOST, TcmSettings};
use crate::data::{AssetFolder, AssetKind, DataError, Fault, Field, Source, Validate, no_such};
use crate::game::net::{NetworkPlan, team_numbers_fault};
use crate::game::requests::Request;
use crate::ids::{RobotId, Team};
use crate::pitch::{BallKind, Pitch};
use crate::strategy::teamwork::TeamworkFile;
use crate::strategy::{Strategy, StrategyReading, StrategyTexts};
use crate::world::referee::RuleBook;
use crate::world::sense::Lighting;

/// A match as it is written in `assets/matches/*.ron`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MatchFile {
    /// Its name for people.
    pub name: String,
    /// The pitch's file.
    pub pitch: String,
    /// The ball.
    pub ball: BallKind,
    /// The rules.
    pub rules: RuleBook,
    /// The light of the hall, for robots that see by pictures.
    #[serde(default)]
    pub light: Lighting,
    /// The radio's file.
    #[serde(default = "default_radio")]
    pub radio: String,
    /// Settings of the team communication module.
    #[serde(default)]
    pub tcm: TcmSettings,
    /// The home team.
    pub home: TeamFile,
    /// The away team.
    pub away: TeamFile,
}

impl Validate for MatchFile {
    fn validate(&self) -> Result<(), Fault> {
        self.ball.validate_as("ball")?;
        self.rules.validate_as("rules")?;
        self.light.validate_as("light")?;
        self.tcm.validate_as("tcm")
    }
}

fn default_radio() -> String {
    DEFAULT_RADIO.into()
}

/// What a person changes of a match file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// The match file; `friendly` if not given.
    pub file: Option<String>,
    /// The home team's strategy.
    pub home: Option<String>,
    /// The away team's strategy.
    pub away: Option<String>,
    /// The radio.
    pub radio: Option<String>,
    /// Minutes of a half.
    pub half_minutes: Option<f32>,
    /// The seed of all dice.
    pub seed: u64,
    /// The robot that a person drives.
    pub pilot: Option<RobotId>,
    /// A file that says where robots and computers are.
    pub addresses: Option<PathBuf>,
    /// What crosses a network; boxed, since it is large and mostly empty.
    pub network: Box<NetworkPlan>,
}

/// A match that can be played: every file is read and sound.
#[derive(Clone, Debug, PartialEq)]
pub struct MatchPlan {
    /// Its name for people.
    pub name: String,
    /// Where the files are that others name.
    pub assets: AssetFolder,
    /// The pitch.
    pub pitch: Pitch,
    /// The ball.
    pub ball: BallKind,
    /// The rules.
    pub rules: RuleBook,
    /// The light of the hall, which matters to robots that see by pictures.
    pub light: Lighting,
    /// The radio.
    pub radio: Radio,
    /// Settings of the team communication module.
    pub tcm: TcmSettings,
    /// Where the robots and computers are that the TCM speaks to.
    pub addresses: Option<Directory>,
    /// What crosses a network.
    pub network: NetworkPlan,
    /// Home first.
    pub teams: [TeamPlan; 2],
    /// The seed of all dice.
    pub seed: u64,
    /// The robot that a person drives.
    pub pilot: Option<RobotId>,
    /// Where the match begins, if not at a kick-off; then only the robots of the situation take part.
    pub situation: Option<Situation>,
    /// Rules by which the radio fails.
    pub faults: Vec<FaultRule>,
    /// What happens when, by tick.
    pub script: Vec<(u64, Request)>,
}

/// The match that is played unless another is named.
pub const DEFAULT_MATCH: &str = "friendly";
/// The port of the first robot, unless a match says where its robots are.
pub const FIRST_PORT: u16 = 7400;
/// The port of the match itself, counted from that of the first robot.
const HOST_PORT: u16 = 98;
/// The radio that a match has unless it names another.
pub const DEFAULT_RADIO: &str = "good";

impl MatchPlan {
    /// Reads a team's strategy from its files as they are now, just as it was read for the match, for robots that play what
    /// it was before.
    pub fn reread(&self, team: Team, assets: &AssetFolder) -> StrategyReading {
        let TeamPlan { names, teamwork_change, kind, .. } = self.team(team);
        self.follow(team, read_strategy(assets, names, teamwork_change, kind, (&self.pitch, &self.ball)))
    }

    /// Reads a strategy by its name, for robots that play another one; what the match changes of its own strategy's teamwork means
    /// nothing for another.
    pub fn read_other(&self, team: Team, assets: &AssetFolder, name: &str) -> StrategyReading {
        let TeamPlan { names, teamwork_change, kind, .. } = self.team(team);
        let mut teamwork_change = teamwork_change.clone();
        if names.strategy != name {
            teamwork_change.teamwork = TeamworkFile::default();
        }
        let names = TeamFile { strategy: name.into(), ..names.clone() };
        let on = (&self.pitch, &self.ball);
        self.follow(team, read_strategy(assets, &names, &teamwork_change, kind, on))
    }

    /// Checks the text of a strategy that was sent under a name, as [`MatchPlan::reread`] does its file.
    ///
    pub fn read_sent(&self, team: Team, name: &str, text: String) -> StrategyReading {
        let TeamPlan { names, teamwork_change, kind, .. } = self.team(team);
        let source = Source::new(Path::new(name).file_name().unwrap_or(OsStr::new("strategy")), text);
        let reading = Strategy::read_sent(&self.assets, source, Some(&self.pitch));
        self.follow(team, fit(reading, names, teamwork_change, kind, (&self.pitch, &self.ball)))
    }

    /// Reads a strategy again from the texts that it was read from, whatever is in the files now.
    pub fn read_kept(&self, team: Team, texts: &StrategyTexts) -> StrategyReading {
        let TeamPlan { names, teamwork_change, kind, .. } = self.team(team);
        let assets = AssetFolder::kept(self.assets.root(), texts.files.clone());
        let reading = Strategy::read(&assets, &texts.path, Some(&self.pitch));
        self.follow(team, fit(reading, names, teamwork_change, kind, (&self.pitch, &self.ball)))
    }

    /// A strategy for robots that play what the team played at first.
    fn follow(&self, team: Team, reading: StrategyReading) -> StrategyReading {
        let TeamPlan { strategy: before, roles, .. } = self.team(team);
        let at = |field: &str| Field::root().key(field);
        reading
            .require(|strategy| strategy.can_follow(before).map_err(|reason| (at("players"), reason)))
            .require(|strategy| give_roles(strategy, roles).map_err(|reason| (at("roles"), reason)))
    }

    /// Reads everything that a match needs.
    ///
    /// # Errors
    /// The first file that is missing or wrong, with the place of the fault.
    pub fn read(assets: &AssetFolder, choice: &Choice) -> Result<MatchPlan, DataError> {
        let name = choice.file.as_deref().unwrap_or(DEFAULT_MATCH);
        MatchPlan::read_file(assets, &assets.file(AssetKind::Match, name), choice)
    }

    /// Reads a match from its file, whatever match is chosen, and everything that it needs.
    ///
    /// # Errors
    /// As [`MatchPlan::read`].
    pub fn read_file(assets: &AssetFolder, path: &Path, choice: &Choice) -> Result<MatchPlan, DataError> {
        let source = assets.read(path)?;
        let mut file: MatchFile = source.parse_sound()?;
        if choice.network.league_ports.is_some() {
            file.tcm.datagram = file.tcm.datagram.min(choice.network.version.longest_message());
        }
        if let Some(minutes) = choice.half_minutes {
            file.rules.half_minutes = minutes;
            file.rules.validate().map_err(|fault| DataError::new("--minutes", fault.message))?;
        }
        let pitch =
            file_named(assets, &source, AssetKind::Pitch, (&Field::root().key("pitch"), &file.pitch))?;
        let pitch = checked(assets, &pitch)?;
        if choice.radio.is_none() {
            file_named(assets, &source, AssetKind::Radio, (&Field::root().key("radio"), &file.radio))?;
        }
        file.home.check(assets, &source, "home", choice.home.is_none())?;
        file.away.check(assets, &source, "away", choice.away.is_none())?;
        let radio = choice.radio.as_ref().unwrap_or(&file.radio);
        let radio = checked(assets, &assets.file(AssetKind::Radio, radio))?;
        for (team, chosen) in [(&mut file.home, &choice.home), (&mut file.away, &choice.away)] {
            if let Some(strategy) = chosen {
                // What a match changes of its own strategy's teamwork means nothing for another.
                (team.strategy, team.teamwork) = (strategy.clone(), TeamworkFile::default());
            }
        }
        let teams = [
            TeamPlan::read(assets, &file.home, (&source, "home"), (&pitch, &file.ball))?,
            TeamPlan::read(assets, &file.away, (&source, "away"), (&pitch, &file.ball))?,
        ];
        let addresses = choice.addresses.as_deref().map(|path| read_addresses(assets, path)).transpose()?;
        let mut network = NetworkPlan::clone(&choice.network);
        if network.team_numbers.is_none() {
            network.team_numbers = team_numbers(&source, &file)?;
        }
        if let Some((option, message)) = network.fault() {
            return Err(DataError::new(option, message));
        }
        let plan = MatchPlan {
            name: file.name,
            assets: assets.clone(),
            pitch,
            ball: file.ball,
            rules: file.rules,
            light: file.light,
            radio,
            tcm: file.tcm,
            addresses,
            network,
            teams,
            seed: choice.seed,
            pilot: choice.pilot,
            situation: None,
            faults: Vec::new(),
            script: Vec::new(),
        };
        plan.check_robot("--pilot", plan.pilot)?;
        for robot in &plan.network.remote {
            plan.check_robot("--remote", Some(*robot))?;
        }
        Ok(plan)
    }

    /// One side of the match.
    pub fn team(&self, team: Team) -> &TeamPlan {
        &self.teams[team.index()]
    }

    /// All robots of the match, in order.
    pub fn robots(&self) -> impl Iterator<Item = RobotId> + '_ {
        Team::BOTH
            .into_iter()
            .flat_map(|team| {
                let players = self.team(team).strategy.players.len();
                (0..players).map(move |number| RobotId::new(team, number as u8))
            })
            .filter(|id| self.situation.as_ref().is_none_or(|situation| situation.robots.contains_key(id)))
    }

    /// Who can be spoken to: the match's robots and a computer, at ports of this machine if they are given none.
    pub fn directory(&self) -> Directory {
        self.addresses.clone().unwrap_or_else(|| {
            let players = self.teams.each_ref().map(|team| team.strategy.players.len() as u8);
            // Sixteen robots at most find ports.
            let robots = Directory::loopback(FIRST_PORT, &players).unwrap_or_default();
            let host = SocketAddr::from((Ipv4Addr::LOCALHOST, FIRST_PORT + HOST_PORT));
            robots.entries().chain([(HOST, host)]).collect()
        })
    }

    /// Whether the match has the robot that an option names.
    ///
    /// # Errors
    /// If it has not.
    pub fn check_robot(&self, option: &str, robot: Option<RobotId>) -> Result<(), DataError> {
        match robot {
            Some(wanted) if !self.robots().any(|robot| robot == wanted) => {
                let known = self.robots().map(|robot| robot.to_string());
                Err(DataError::new(option, no_such("robot", &wanted.to_string(), known)))
            }
            _ => Ok(()),
        }
    }
}

/// The league's numbers of home and away, if the match file gives them.
fn team_numbers(source: &Source, file: &MatchFile) -> Result<Option<[u8; 2]>, DataError> {
    let fault =
        |side: &str, message: String| source.error_at(&Field::root().key(side).key("team_number"), message);
    match [file.home.team_number, file.away.team_number] {
        [None, None] => Ok(None),
        [Some(home), Some(away)] => match team_numbers_fault([home, away]) {
            Some(message) => Err(fault("away", message)),
            None => Ok(Some([home, away])),
        },
        [home, _] => {
            let (with, without) = if home.is_some() { ("home", "away") } else { ("away", "home") };
            Err(fault(with, format!("give {without} a team_number, too")))
        }
    }
}
