//! From a scenario file to matches that can be played, one for each seed.

use std::fmt::{self, Display, Formatter};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::check::{Known, KnownTeam, Scenario, ScenarioPlayer, check};
use super::event::Dependency;
use super::file::{Referee, ScenarioFile, SideFile};
use super::script::requests;
use crate::data::{AssetFolder, AssetKind, DataError, Field, Source, is_path, no_such};
use crate::game::{Choice, DEFAULT_MATCH, MatchPlan, Placed, Situation, TeamPlan, checked, file_named};
use crate::ids::Team;
use crate::pitch::{BallKind, Pitch};
use crate::protocol::role_swap::PaperRules;
use crate::strategy::Strategy;
use crate::strategy::teamwork::Protocol;

/// A scenario: its file, and which of the file's variants it is, if there are any.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ScenarioRef {
    /// The file.
    pub path: PathBuf,
    /// The variant of the file.
    pub variant: Option<String>,
}

impl ScenarioRef {
    /// The scenario that people name: a file among the assets or a path, and perhaps a variant behind a colon, as in
    /// `swap_locks_time_out:paper`.
    pub fn named(assets: &AssetFolder, name: &str) -> ScenarioRef {
        let ScenarioRef { path, variant } = ScenarioRef::at(name);
        ScenarioRef { path: assets.file(AssetKind::Scenario, &path.to_string_lossy()), variant }
    }

    /// As [`ScenarioRef::named`], but only a path before the colon.
    pub fn at(path: &str) -> ScenarioRef {
        let (path, variant) = match path.rsplit_once(':').filter(|_| !Path::new(path).exists()) {
            Some((path, variant)) if !is_path(variant) => (path, Some(variant)),
            _ => (path, None),
        };
        ScenarioRef { path: path.into(), variant: variant.map(str::to_owned) }
    }
}

impl<P: Into<PathBuf>> From<P> for ScenarioRef {
    fn from(path: P) -> ScenarioRef {
        ScenarioRef { path: path.into(), variant: None }
    }
}

/// As people name it.
impl Display for ScenarioRef {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        self.variant.as_ref().map_or(Ok(()), |variant| write!(f, ":{variant}"))
    }
}

/// A scenario with everything that its matches need.
#[derive(Clone, Debug)]
pub struct ScenarioPlan {
    /// Where it comes from.
    pub origin: ScenarioRef,
    /// The scenario, checked.
    pub scenario: Scenario,
    /// The match whose pitch, ball and rules it has, by its file's name.
    pub game: String,
    /// Another pitch than that match's, by its file's name.
    pub pitch: Option<String>,
    source: Source,
    /// The match, with the first seed.
    match_plan: MatchPlan,
}

impl ScenarioPlan {
    /// Reads a scenario and all files that it names: of a file with variants the one named or else the first.
    ///
    /// # Errors
    /// The first file that is missing or wrong, with the place of the fault.
    pub fn read(assets: &AssetFolder, scenario: &ScenarioRef) -> Result<ScenarioPlan, DataError> {
        let mut plans = ScenarioPlan::read_some(assets, scenario, 1)?;
        Ok(plans.swap_remove(0))
    }

    /// As [`ScenarioPlan::read`], but for all variants if none is named.
    ///
    /// # Errors
    /// As [`ScenarioPlan::read`].
    pub fn read_all(assets: &AssetFolder, scenario: &ScenarioRef) -> Result<Vec<ScenarioPlan>, DataError> {
        ScenarioPlan::read_some(assets, scenario, usize::MAX)
    }

    fn read_some(
        assets: &AssetFolder,
        scenario: &ScenarioRef,
        most: usize,
    ) -> Result<Vec<ScenarioPlan>, DataError> {
        let source = assets.read(&scenario.path)?;
        let file: ScenarioFile = source.parse()?;
        let is_wanted =
            |name: &Option<&str>| scenario.variant.is_none() || scenario.variant.as_deref() == *name;
        let all = file.scenarios().into_iter().filter(|(name, _)| is_wanted(name)).take(most);
        let plans = all.map(|(name, variant)| {
            let (source, path) = (file.source_of(&source, name), scenario.path.clone());
            ScenarioPlan::of(
                assets,
                ScenarioRef { path, variant: name.map(str::to_owned) },
                &source,
                &variant,
            )
        });
        let plans = plans.collect::<Result<Vec<_>, _>>()?;
        match &scenario.variant {
            Some(name) if plans.is_empty() => {
                let message = no_such("variant", name, file.variants.keys());
                Err(source.error_at(&Field::root().key("variants"), message))
            }
            _ => Ok(plans),
        }
    }

    /// A scenario whose variant is laid over the rest of its file already.
    fn of(
        assets: &AssetFolder,
        origin: ScenarioRef,
        source: &Source,
        file: &ScenarioFile,
    ) -> Result<ScenarioPlan, DataError> {
        if origin.variant.is_some() && !file.variants.is_empty() {
            return Err(source.error_at(&Field::root().key("variants"), "a variant has none of its own"));
        }
        let game = file.game.clone().unwrap_or_else(|| DEFAULT_MATCH.into());
        let path = file_named(assets, source, AssetKind::Match, (&Field::root().key("game"), &game))?;
        let usual = MatchPlan::read_file(assets, &path, &Choice::default())?;
        let pitch = match &file.pitch {
            Some(name) => checked(
                assets,
                &file_named(assets, source, AssetKind::Pitch, (&Field::root().key("pitch"), name))?,
            )?,
            None => usual.pitch.clone(),
        };
        let home = source.required(&file.home, &Field::root(), "home")?;
        let team = |side, file| team(assets, source, (side, file), (&pitch, &usual.ball));
        let teams = [
            team("home", &home)?,
            file.away.as_ref().map_or_else(|| team("home", &home), |away| team("away", away))?,
        ];
        let mut known = Known {
            pitch: &pitch,
            ball: &usual.ball,
            teams: teams.each_ref().map(KnownTeam::of),
            radios: assets.names(AssetKind::Radio),
            strategies: assets.names(AssetKind::Strategy),
        };
        if file.away.is_none() {
            known.teams[1] = KnownTeam::default();
        }
        let scenario = check(file, source, &known)?;
        let mut match_plan = MatchPlan {
            name: scenario.name.clone(),
            radio: checked(assets, &assets.file(AssetKind::Radio, &scenario.radio))?,
            teams: teams.clone(),
            seed: scenario.seeds.first().copied().unwrap_or(1),
            situation: Some(situation(&scenario)),
            faults: scenario.faults.clone(),
            pitch: pitch.clone(),
            ..usual.clone()
        };
        for (team, players) in Team::BOTH.into_iter().zip(&scenario.sides) {
            if let Some(players) = players {
                let at = Field::root().key(team.to_string());
                let cast = match_plan.teams[team.index()].cast(cast(players));
                cast.map_err(|message| source.error_at(&at, message))?;
            }
        }
        match_plan.script = requests(assets, &scenario.script, &match_plan)?;
        let (pitch, source) = (file.pitch.clone(), source.clone());
        let plan = ScenarioPlan { origin, scenario, game, pitch, source, match_plan };
        match plan.scenario.depends_on {
            Some(dependency) if !has(&plan.match_plan.team(Team::Home).strategy, dependency) => {
                let at = Field::root().key("depends_on");
                Err(plan.source.error_at(&at, format!("{dependency} is not on in the home team's strategy")))
            }
            _ => Ok(plan),
        }
    }

    /// An error about a field of the file.
    pub fn error_at(&self, field: &Field, message: String) -> DataError {
        self.source.error_at(field, message)
    }

    /// The match with a seed, and with the ball at the first of its places.
    pub fn with_seed(&self, seed: u64) -> MatchPlan {
        MatchPlan { seed, ..self.match_plan.clone() }
    }

    /// The match with a seed and with the ball at a place.
    pub fn with_ball_at(&self, place: Vec2, seed: u64) -> MatchPlan {
        let mut plan = self.with_seed(seed);
        if let Some(situation) = &mut plan.situation {
            situation.ball = place;
        }
        plan
    }

    /// The names of the files of both teams' strategies.
    pub fn strategy_names(&self) -> [String; 2] {
        self.match_plan.teams.each_ref().map(|team| team.names.strategy.clone())
    }

    /// The same scenario without what it is said to depend on, in all teams.
    pub fn without(&self, dependency: Dependency) -> ScenarioPlan {
        let mut plan = self.clone();
        for team in &mut plan.match_plan.teams {
            switch_off(Arc::make_mut(&mut team.strategy), dependency);
        }
        plan
    }
}

/// Whether a strategy has a piece of teamwork.
pub(in crate::lab) fn has(strategy: &Strategy, dependency: Dependency) -> bool {
    let teamwork = &strategy.teamwork;
    match dependency.mechanism() {
        Some(mechanism) => teamwork.has(mechanism),
        None => teamwork.role_swap.as_ref().is_some_and(|swap| swap.protocol == Protocol::Hardened),
    }
}

/// Switches a piece of a strategy's teamwork off.
pub(in crate::lab) fn switch_off(strategy: &mut Strategy, dependency: Dependency) {
    let teamwork = &mut strategy.teamwork;
    match dependency.mechanism() {
        Some(mechanism) => teamwork.mechanisms = teamwork.mechanisms.without(mechanism),
        None => {
            if let Some(swap) = &mut teamwork.role_swap {
                swap.protocol = Protocol::Paper(PaperRules::default());
            }
        }
    }
}

fn team(
    assets: &AssetFolder,
    source: &Source,
    (side, file): (&str, &SideFile),
    (pitch, ball): (&Pitch, &BallKind),
) -> Result<TeamPlan, DataError> {
    let files = file.files(source, &Field::root().key(side))?;
    files.check(assets, source, side, true)?;
    TeamPlan::read(assets, &files, (source, side), (pitch, ball))
}

/// The roles that a scenario gives to the players of a side, by number.
fn cast(players: &[ScenarioPlayer]) -> Vec<(u8, String)> {
    players.iter().filter_map(|player| Some((player.id.number, player.role.clone()?))).collect()
}

fn situation(scenario: &Scenario) -> Situation {
    let placed = |player: &ScenarioPlayer| (player.id, Placed { pose: player.pose, on: player.on });
    Situation {
        refereed: scenario.referee == Referee::Whole,
        robots: scenario.players().map(placed).collect(),
        ball: scenario.first_place(),
        velocity: scenario.velocity,
    }
}
