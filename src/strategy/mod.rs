//! Strategies: what a team's robots know, want and do, as data.
//!
//! A file in `assets/strategies` is parsed into a [`StrategyFile`] and then resolved into the [`Strategy`] that runs: names
//! looked up, numbers checked, nothing half-loaded. See [`language`] for the words of a file.

mod activity;
mod base;
mod display;
mod file;
pub mod language;
mod resolve;
mod role;
pub mod teamwork;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use crate::data::{AssetFolder, DataError, Field, Source};
use crate::geometry::Zone;
use crate::ids::Team;
use crate::pitch::Pitch;
pub use activity::{Activity, Searched, TransitionTaken, played};
use base::Lineage;
pub use file::{KickOff, StrategyFile};
use language::{Feature, Point, Schema};
pub use role::{Role, RoleRef};
use teamwork::{Teamwork, TeamworkFile};

/// A strategy that can be played: every name is an index, every number is sound.
#[derive(Clone, Debug, PartialEq)]
pub struct Strategy {
    pub name: String,
    pub description: String,
    /// Length and width in metres of the pitch that its file was written for.
    pub pitch: Option<Vec2>,
    pub robot_kinds: Vec<String>,
    pub roles: Vec<RoleSpec>,
    /// Index into `roles` for each robot at kick-off, by number.
    pub players: Vec<usize>,
    pub kick_off: KickOff,
    /// Places of all players by number, at which scenarios begin.
    pub line_ups: BTreeMap<String, Vec<Vec2>>,
    pub machines: Vec<Machine>,
    pub assemblages: Vec<Assemblage>,
    pub teamwork: Teamwork,
    /// How many memories its stateful operators need.
    pub slots: usize,
}

/// A role and what it consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct RoleSpec {
    pub name: String,
    pub tag: String,
    pub part: Part,
}

/// A role plays a machine itself or acts as other roles by turns.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    Plays(Play),
    ActsAs(Vec<SubRole>),
}

/// What a role that plays itself consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct Play {
    pub machine: usize,
    /// The zone of control (figure 2).
    pub danger_zone: Zone,
    /// A robot that has looked around for the ball from one of them in vain goes on to the next.
    pub homebases: Vec<Vec2>,
    pub homebase_rule: HomebaseRule,
}

/// Which of its homebases a role takes (section V-B).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum HomebaseRule {
    /// The one that is nearest to the robot.
    #[default]
    Nearest,
    /// The nearest on the other side of the field than the goalie entered its area by.
    AwayFromGoalie,
    /// The one that is farthest from the team mate in a role.
    FarthestFrom(RoleRef),
    /// The nearest that is not also the nearest for the team mate in a role.
    NotNearestOf(RoleRef),
}

/// Another role, and when to act in it.
#[derive(Clone, Debug, PartialEq)]
pub struct SubRole {
    pub when: Feature,
    pub role: usize,
}

/// A finite state machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    pub name: String,
    pub start: usize,
    pub states: Vec<State>,
}

/// An activity.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    pub name: String,
    pub assemblage: Option<usize>,
    pub speed: f32,
    pub reverse: bool,
    pub turn: Turn,
    /// Whether it is an acquire behaviour, in which the ball can be claimed.
    pub acquires: bool,
    /// Whether the robot tries to hold the ball.
    pub hold: bool,
    /// Kicks by name, the first that the robot's kind has.
    pub kicks: Vec<String>,
    pub transitions: Vec<Transition>,
}

/// What a standing robot turns to.
#[derive(Clone, Debug, PartialEq)]
pub enum Turn {
    Stay,
    Face(Point),
    /// rad/s
    Spin(f32),
}

/// A way out of a state.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    pub when: Feature,
    pub go: usize,
    /// The feature as the file has it, for people.
    pub label: String,
}

/// Weighted motor schemas.
#[derive(Clone, Debug, PartialEq)]
pub struct Assemblage {
    pub name: String,
    pub combination: Combination,
    pub terms: Vec<Term>,
}

/// How the vectors of an assemblage become one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Combination {
    WeightedSum,
    WinnerTakeAll,
}

/// A motor schema and its weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    pub weight: f32,
    pub name: String,
    pub schema: Schema,
}

/// What came of reading a strategy.
#[derive(Clone, Debug, PartialEq)]
pub struct StrategyReading {
    /// A strategy is loaded whole or not at all: then the error says what is wrong, with file, line, column and field.
    pub strategy: Result<Strategy, DataError>,
    /// What the files say of teamwork.
    teamwork: TeamworkFile,
    /// Its own file first, then where those that it is based on are or were looked for: if one of these changes, comes or
    /// goes, so may the strategy.
    pub files: Vec<PathBuf>,
}

/// What a match or a scenario says of a strategy's teamwork in place of the strategy, and where it says so.
#[derive(Clone, Debug, PartialEq)]
pub struct TeamworkChange {
    pub teamwork: TeamworkFile,
    pub source: Source,
    pub at: Field,
}

impl StrategyReading {
    /// The same with a change of its teamwork, field by field; an error where the change does not fit the strategy.
    pub(crate) fn with_teamwork(mut self, change: &TeamworkChange) -> StrategyReading {
        self.strategy = self.strategy.and_then(|mut strategy| {
            let names = strategy.roles.iter().map(|role| role.name.as_str()).collect();
            let roles = resolve::Roles { names, source: &change.source };
            self.teamwork = change.teamwork.clone().over(self.teamwork.clone());
            strategy.teamwork = roles.teamwork(&self.teamwork, &change.at)?;
            Ok(strategy)
        });
        self
    }

    /// The same, unless a sound strategy does not do for its use: then an error at the field that says why.
    pub(crate) fn require(
        mut self,
        check: impl FnOnce(&mut Strategy) -> Result<(), (Field, String)>,
    ) -> StrategyReading {
        self.strategy = self.strategy.and_then(|mut strategy| match check(&mut strategy) {
            Ok(()) => Ok(strategy),
            Err((field, message)) => Err(Source::read(&self.files[0])?.error_at(&field, message)),
        });
        self
    }
}

impl Strategy {
    /// Reads and checks a strategy file and those that it is based on. Its positions are stretched to a pitch, and are as
    /// they are written without one.
    pub fn read(assets: &AssetFolder, path: &Path, pitch: Option<&Pitch>) -> StrategyReading {
        let mut lineage = Lineage::of(path, assets);
        let read = Source::read(path).and_then(|source| Strategy::resolved(&source, &mut lineage, pitch));
        let (strategy, teamwork) = match read {
            Ok((strategy, file)) => (Ok(strategy), file.teamwork),
            Err(error) => (Err(error), TeamworkFile::default()),
        };
        StrategyReading { strategy, teamwork, files: lineage.files }
    }

    /// Checks the text of a strategy file that is already at hand, as [`Strategy::read`] does.
    ///
    /// # Errors
    /// Says what is wrong with the file's path, line, column and field.
    pub fn parse(
        assets: &AssetFolder,
        source: &Source,
        pitch: Option<&Pitch>,
    ) -> Result<Strategy, DataError> {
        let read = Strategy::resolved(source, &mut Lineage::of(&source.path, assets), pitch);
        read.map(|(strategy, _)| strategy)
    }

    fn resolved(
        source: &Source,
        lineage: &mut Lineage,
        pitch: Option<&Pitch>,
    ) -> Result<(Strategy, StrategyFile), DataError> {
        let file = lineage.complete(source.parse()?, source)?;
        let strategy = resolve::resolve(&file, source, pitch.map(|pitch| 2.0 * pitch.half_size()))?;
        Ok((strategy, file))
    }

    /// Whether robots that play `before` can play on with this strategy.
    ///
    /// # Errors
    /// Says why they cannot, in words for people.
    pub fn can_follow(&self, before: &Strategy) -> Result<(), String> {
        let (had, has) = (before.players.len(), self.players.len());
        if had != has {
            return Err(format!("it has {has} players, and {had} are on the pitch; restart to change that"));
        }
        Ok(())
    }

    pub fn state(&self, machine: usize, state: usize) -> &State {
        &self.machines[machine].states[state]
    }
}

/// The strategies of a match, home first. They change only in the Script stage.
#[derive(Resource, Clone, Debug)]
pub struct Strategies(pub [Arc<Strategy>; 2]);

impl Strategies {
    pub fn of(&self, team: Team) -> &Strategy {
        &self.0[team.index()]
    }
}
