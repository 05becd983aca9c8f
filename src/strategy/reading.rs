//! Reading a strategy from its file and those that it is based on.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::base::Lineage;
use super::file::StrategyFile;
use super::pieces::Strategy;
use super::resolve;
use super::teamwork::TeamworkFile;
use crate::data::{
    AssetFolder, AssetTexts, DataError, Field, NumberToken, Segment, Source, numbers, with_number,
};
use crate::pitch::Pitch;

/// What came of reading a strategy.
#[derive(Clone, Debug, PartialEq)]
pub struct StrategyReading {
    /// A strategy is loaded whole or not at all: then the error says what is wrong, with file, line, column and field.
    pub strategy: Result<Strategy, DataError>,
    /// What the files say of teamwork.
    teamwork: TeamworkFile,
    /// Its own text.
    source: Source,
    /// Its own file first, then where those that it is based on are or were looked for: if one of these changes, comes or
    /// goes, so may the strategy.
    pub files: Vec<PathBuf>,
    /// The texts of those that are there.
    pub texts: Arc<StrategyTexts>,
}

/// The texts that a strategy was read from: from them it can be read again.
#[derive(Clone, Debug, Default, PartialEq, Hash, Serialize, Deserialize)]
pub struct StrategyTexts {
    /// Its own file.
    pub path: PathBuf,
    /// Its own text and those of the strategies that it is based on.
    pub files: AssetTexts,
}

impl StrategyTexts {
    /// The texts with another weight of a term of an assemblage, where the strategy finds it; none if no number says it.
    pub fn with_weight(&self, assemblage: &str, term: usize, weight: f32) -> Option<StrategyTexts> {
        let is_meant = |number: &NumberToken| {
            let [Segment::Key(list), Segment::Key(name), Segment::Key(_), steps @ ..] =
                number.field.segments()
            else {
                return false;
            };
            let [Segment::Index(0), Segment::Index(place), last] = steps else { return false };
            let is_weight = match last {
                Segment::Index(place) => *place == 0,
                Segment::Key(key) => key == "weight",
            };
            list == "assemblages" && name == assemblage && *place == term && is_weight
        };
        let mut path = Some(&self.path);
        // A base may not be based on what is based on it, so each file comes once.
        for _ in 0..=self.files.len() {
            let (known, text) = path.and_then(|path| self.files.get_key_value(path))?;
            if let Some(number) = numbers(text).into_iter().find(is_meant) {
                let mut changed = self.clone();
                changed.files.insert(known.clone(), with_number(text, &number, f64::from(weight)));
                return Some(changed);
            }
            path = self.base_of(known, text);
        }
        None
    }

    /// The file that another one names as its base.
    fn base_of(&self, path: &Path, text: &str) -> Option<&PathBuf> {
        let file: StrategyFile = Source::new(path, text).parse().ok()?;
        let base = file.based_on?;
        let stem = Path::new(&base).file_stem()?;
        self.files.keys().find(|known| known.as_path() != path && known.file_stem() == Some(stem))
    }
}

/// What a match or a scenario says of a strategy's teamwork in place of the strategy, and where it says so.
#[derive(Clone, Debug, PartialEq)]
pub struct TeamworkChange {
    /// What changes.
    pub teamwork: TeamworkFile,
    /// The text that says so.
    pub source: Source,
    /// Its place in the text.
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
            Err((field, message)) => Err(self.source.error_at(&field, message)),
        });
        self
    }
}

impl Strategy {
    /// Reads and checks a strategy file and those that it is based on. Its positions are stretched to a pitch, and are as
    /// they are written without one.
    pub fn read(assets: &AssetFolder, path: &Path, pitch: Option<&Pitch>) -> StrategyReading {
        match assets.read(path) {
            Ok(source) => Strategy::reading(source, Lineage::of(path, assets), pitch),
            Err(error) => StrategyReading {
                strategy: Err(error),
                teamwork: TeamworkFile::default(),
                source: Source::new(path, ""),
                files: vec![path.to_owned()],
                texts: Arc::default(),
            },
        }
    }

    /// Checks the text of a strategy that was sent from elsewhere as [`Strategy::read`] does its file. It may be based on
    /// strategies among the assets only.
    pub fn read_sent(assets: &AssetFolder, source: Source, pitch: Option<&Pitch>) -> StrategyReading {
        let lineage = Lineage::of_sent(&source.path, assets);
        Strategy::reading(source, lineage, pitch)
    }

    fn reading(source: Source, mut lineage: Lineage, pitch: Option<&Pitch>) -> StrategyReading {
        let (strategy, teamwork) = match Strategy::resolved(&source, &mut lineage, pitch) {
            Ok((strategy, file)) => (Ok(strategy), file.teamwork),
            Err(error) => (Err(error), TeamworkFile::default()),
        };
        let mut texts = StrategyTexts { path: source.path.clone(), files: lineage.texts };
        texts.files.insert(source.path.clone(), source.text.clone());
        StrategyReading { strategy, teamwork, source, files: lineage.files, texts: Arc::new(texts) }
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
}
