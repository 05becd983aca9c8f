//! One side of a match: what its files are, and the team that they come to.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::files::{checked, file_named};
use super::line_up::LineUp;
use crate::data::{AssetFolder, AssetKind, DataError, Field, Source, Validate};
use crate::ids::PlayerNumber;
use crate::pitch::{BallKind, Pitch};
use crate::robot::{RobotKind, Sensing};
use crate::strategy::teamwork::TeamworkFile;
use crate::strategy::{Strategy, StrategyReading, StrategyTexts, TeamworkChange};
use crate::vision::CameraCalibration;

/// One side of a match: names of files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TeamFile {
    /// The strategy's file.
    pub strategy: String,
    /// The file of the robots' kind.
    pub robot: String,
    /// The file of the robots' senses.
    pub sensing: String,
    /// The files of the senses of robots that sense otherwise, by number.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub sensing_of: BTreeMap<PlayerNumber, String>,
    /// What differs from the strategy's own `teamwork`, field by field.
    #[serde(default)]
    pub teamwork: TeamworkFile,
    /// The league's number of the team, 0 to 254. Without numbers the first referee box that is heard decides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub team_number: Option<u8>,
}

impl TeamFile {
    /// Whether the files that a match or scenario names for a side are there; the strategy may be replaced.
    pub(crate) fn check(
        &self,
        assets: &AssetFolder,
        source: &Source,
        side: &str,
        with_strategy: bool,
    ) -> Result<(), DataError> {
        let strategy = (AssetKind::Strategy, "strategy", &self.strategy);
        let others =
            [(AssetKind::Robot, "robot", &self.robot), (AssetKind::Sensing, "sensing", &self.sensing)];
        for (kind, field, name) in others.into_iter().chain(with_strategy.then_some(strategy)) {
            file_named(assets, source, kind, (&Field::root().key(side).key(field), name))?;
        }
        self.sensing_of.iter().try_for_each(|(number, name)| {
            let field = sense_of(side, *number);
            file_named(assets, source, AssetKind::Sensing, (&field, name)).map(drop)
        })
    }
}

/// Where a side's file names what one of its robots senses with.
fn sense_of(side: &str, number: PlayerNumber) -> Field {
    Field::root().key(side).key("sensing_of").key(number.to_string())
}

/// What robots sense with.
#[derive(Clone, Debug, PartialEq)]
pub struct Senses {
    /// How well.
    pub sensing: Arc<Sensing>,
    /// How the camera is calibrated, if they see by pictures.
    pub calibration: Option<Arc<CameraCalibration>>,
}

impl Senses {
    /// Reads a preset, and the calibration that it names, if it names one.
    fn read(assets: &AssetFolder, name: &str) -> Result<Senses, DataError> {
        let source = assets.read(&assets.file(AssetKind::Sensing, name))?;
        let sensing: Sensing = source.parse_sound()?;
        let calibration = match sensing.eyes.calibration() {
            Some(camera) => {
                let file = file_named(
                    assets,
                    &source,
                    AssetKind::Camera,
                    (&Field::root().key("eyes").key("calibration"), camera),
                )?;
                Some(Arc::new(checked(assets, &file)?))
            }
            None => None,
        };
        Ok(Senses { sensing: Arc::new(sensing), calibration })
    }
}

/// One side of a match.
#[derive(Clone, Debug, PartialEq)]
pub struct TeamPlan {
    /// The names of its files.
    pub names: TeamFile,
    /// What the team does.
    pub strategy: Arc<Strategy>,
    /// The files that the strategy rests on, its own first.
    pub strategy_files: Vec<PathBuf>,
    /// The texts of those that are there.
    pub strategy_texts: Arc<StrategyTexts>,
    /// What of the strategy's teamwork the match or the scenario replaces.
    pub teamwork_change: TeamworkChange,
    /// The roles by number that a scenario gives to players at kick-off in place of the strategy's.
    pub roles: Vec<(u8, String)>,
    /// What its robots are built as.
    pub kind: Arc<RobotKind>,
    /// How well its robots sense.
    pub senses: Senses,
    /// Those of robots that sense otherwise, by number.
    pub senses_of: BTreeMap<PlayerNumber, Senses>,
}

impl TeamPlan {
    /// Reads what a file names for a side.
    pub(crate) fn read(
        assets: &AssetFolder,
        names: &TeamFile,
        (source, side): (&Source, &str),
        (pitch, ball): (&Pitch, &BallKind),
    ) -> Result<TeamPlan, DataError> {
        let kind: RobotKind = checked(assets, &assets.file(AssetKind::Robot, &names.robot))?;
        let at = Field::root().key(side).key("teamwork");
        let change = TeamworkChange { teamwork: names.teamwork.clone(), source: source.clone(), at };
        let reading = read_strategy(assets, names, &change, &kind, (pitch, ball));
        let strategy = reading.strategy?;
        if let Some(number) =
            names.sensing_of.keys().find(|number| usize::from(**number) >= strategy.players.len())
        {
            return Err(source.error_at(
                &sense_of(side, *number),
                format!("the team has {} players, from 0 on", strategy.players.len()),
            ));
        }
        let others = names.sensing_of.iter().map(|(number, name)| Ok((*number, Senses::read(assets, name)?)));
        Ok(TeamPlan {
            senses: Senses::read(assets, &names.sensing)?,
            senses_of: others.collect::<Result<_, DataError>>()?,
            strategy: Arc::new(strategy),
            strategy_files: reading.files,
            strategy_texts: reading.texts,
            teamwork_change: change,
            kind: Arc::new(kind),
            names: names.clone(),
            roles: Vec::new(),
        })
    }

    /// What a robot senses with.
    pub fn senses(&self, number: PlayerNumber) -> &Senses {
        self.senses_of.get(&number).unwrap_or(&self.senses)
    }

    /// Gives players other roles at kick-off than the strategy does, by number.
    ///
    /// # Errors
    /// If the strategy does not have such a role or player.
    pub(crate) fn cast(&mut self, roles: Vec<(u8, String)>) -> Result<(), String> {
        give_roles(Arc::make_mut(&mut self.strategy), &roles)?;
        self.roles = roles;
        Ok(())
    }
}

/// Reads a team's strategy, which must be one for its robots and for the pitch.
pub(super) fn read_strategy(
    assets: &AssetFolder,
    names: &TeamFile,
    change: &TeamworkChange,
    kind: &RobotKind,
    (pitch, ball): (&Pitch, &BallKind),
) -> StrategyReading {
    let path = assets.file(AssetKind::Strategy, &names.strategy);
    fit(Strategy::read(assets, &path, Some(pitch)), names, change, kind, (pitch, ball))
}

/// A team's strategy from what was read of it: it must be one for its robots and for the pitch.
pub(super) fn fit(
    reading: StrategyReading,
    names: &TeamFile,
    change: &TeamworkChange,
    kind: &RobotKind,
    (pitch, ball): (&Pitch, &BallKind),
) -> StrategyReading {
    reading
        .with_teamwork(change)
        .require(|strategy| {
            if strategy.robot_kinds.contains(&names.robot) {
                return Ok(());
            }
            let message = format!("cannot be played by a `{}`: add it here if it can", names.robot);
            Err((Field::root().key("robot_kinds"), message))
        })
        .require(|strategy| lines_up(strategy, &LineUp::new(kind, Some(ball), pitch)))
}

/// Reads a strategy that no match has chosen. Robots of each of its kinds must find room in its places for a kick-off, on the
/// pitch among the assets that it was written for, or on the one whose size is nearest to that.
///
/// # Errors
/// The first fault, with its place.
pub(crate) fn read_strategy_alone(assets: &AssetFolder, path: &Path) -> Result<Strategy, DataError> {
    let strategy = Strategy::read(assets, path, None).strategy?;
    let pitches = sound::<Pitch>(assets, AssetKind::Pitch, assets.names(AssetKind::Pitch));
    let missed = |pitch: &Pitch| {
        let size = 2.0 * pitch.half_size();
        strategy.pitch.map_or(-size.length(), |drawn| drawn.distance(size))
    };
    let Some(pitch) = pitches.min_by(|a, b| missed(a).total_cmp(&missed(b))) else { return Ok(strategy) };
    let kinds = sound::<RobotKind>(assets, AssetKind::Robot, strategy.robot_kinds);
    let reading = Strategy::read(assets, path, Some(&pitch));
    let checked = kinds.fold(reading, |reading, kind| {
        reading.require(|strategy| lines_up(strategy, &LineUp::new(&kind, None, &pitch)))
    });
    checked.strategy
}

/// Those of some assets that are there and sound; what is wrong with another one is not this file's fault.
fn sound<T: DeserializeOwned + Validate>(
    assets: &AssetFolder,
    kind: AssetKind,
    names: Vec<String>,
) -> impl Iterator<Item = T> {
    names.into_iter().filter_map(move |name| checked(assets, &assets.file(kind, &name)).ok())
}

fn lines_up(strategy: &Strategy, line_up: &LineUp) -> Result<(), (Field, String)> {
    line_up.fault(&strategy.kick_off).map_or(Ok(()), Err)
}

pub(super) fn give_roles(strategy: &mut Strategy, roles: &[(u8, String)]) -> Result<(), String> {
    for (number, wanted) in roles {
        let role = strategy.roles.iter().position(|role| role.name == *wanted);
        let place = strategy.players.get_mut(usize::from(*number));
        let (role, place) = role.zip(place).ok_or_else(|| {
            format!("there is no role `{wanted}`, which the scenario gives to player {number}")
        })?;
        *place = role;
    }
    Ok(())
}
