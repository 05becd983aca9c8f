//! An experiment as it is written: the serde types of `assets/experiments/*.ron`.

use std::path::{Component, Path};

use serde::{Deserialize, Serialize};

use super::metric::Metric;
use crate::data::{AssetKind, Bound, Fault, Field, Validate, check_count, ensure};
use crate::ids::Team;
use crate::lab::scenario::{Dependency, TimedEvent};
use crate::rng::LARGEST_SEED;

/// A design: matches that differ in factors, each factor at one of its levels. Every combination of levels is a treatment, and
/// each treatment is played with the same seeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExperimentFile {
    /// What is asked, as a sentence.
    pub name: String,
    /// More about it, for people.
    #[serde(default)]
    pub description: String,
    /// What holds for all matches.
    #[serde(default)]
    pub common: Vec<DesignChange>,
    /// What differs; without factors there is one treatment.
    #[serde(default)]
    pub factors: Vec<Factor>,
    /// The seeds of the matches of each treatment.
    pub blocks: SeedBlocks,
    /// Whether each seed is played once more, with the teams on each other's sides.
    #[serde(default = "yes")]
    pub swap_sides: bool,
    /// When to stop before all seeds are played.
    #[serde(default)]
    pub until: Option<UntilRule>,
    /// The figures that a report shows; all are in the tables.
    pub metrics: Vec<Metric>,
    /// What is said of the matter, to be held against the rows.
    #[serde(default)]
    pub claims: Vec<StatedClaim>,
}

/// A sentence that says of two treatments which has more of something, or of one how much it has.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StatedClaim {
    /// The sentence.
    pub says: String,
    /// Whose it is: a paper and its section, or ours.
    pub source: String,
    /// The figure that it is about.
    pub metric: Metric,
    /// The levels of the treatment that it speaks of, one for each factor.
    pub of: Vec<String>,
    /// Those of the treatment that it is compared with; none if it says how much there is.
    #[serde(default)]
    pub than: Vec<String>,
    /// Which way it goes.
    pub is: ClaimedDifference,
}

/// Which way a claim goes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum ClaimedDifference {
    /// The first treatment has less.
    Less,
    /// It has more.
    More,
    /// They differ by less than this, in the unit of the metric.
    Within(f64),
    /// The treatment, which is compared with none, has between so much and so much in the mean, in the unit of the metric.
    Between(f64, f64),
}

impl ClaimedDifference {
    /// Whether two treatments are compared.
    pub fn compares(self) -> bool {
        !matches!(self, ClaimedDifference::Between(..))
    }
}

fn yes() -> bool {
    true
}

/// Something in which matches differ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Factor {
    /// The name of its column.
    pub name: String,
    /// What it can be.
    pub levels: FactorLevels,
}

/// The levels of a factor. The first one is what the others are compared with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum FactorLevels {
    /// Each with a name, and what it changes.
    Named(Vec<NamedLevel>),
    /// Values of one number of a file.
    Values {
        /// Where the file is in the asset folder, such as `radios/good.ron`.
        file: String,
        /// Where the number is in the file, such as `latency.mean`.
        path: String,
        /// What it is.
        values: Vec<f64>,
    },
}

/// A level of a factor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NamedLevel {
    /// Its name in tables.
    pub name: String,
    /// What it changes; nothing, if it is what all matches are.
    #[serde(default)]
    pub changes: Vec<DesignChange>,
}

/// What is changed of a match. Home is the team that is named first, also in matches in which the teams have each other's sides.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "each variant says what its fields are")]
pub enum DesignChange {
    /// The match file; `friendly` if no change names one.
    Match(String),
    /// The strategy of the team that is named first.
    Home(String),
    /// The strategy of the other team.
    Away(String),
    /// The radio.
    Radio(String),
    /// Minutes of a half.
    HalfMinutes(f32),
    /// A number of a file is another; file and path as in [`FactorLevels::Values`].
    Number { file: String, path: String, to: f64 },
    /// The same for one team alone, of a file that it plays by.
    TeamNumber { team: Team, file: String, path: String, to: f64 },
    /// Where matches name a file of the asset folder, such as `pitches/middle_size_2001.ron`, they get what is in another one.
    Instead { of: String, read: String },
    /// A piece of a team's teamwork is switched off, as far as its strategy has it.
    Without(Team, Dependency),
    /// Something happens at a time.
    Event(TimedEvent),
}

/// What is changed of a match, and where the design says so.
pub(in crate::lab) type PlacedChange = (Field, DesignChange);

/// Changes that a file lists at a place.
pub(in crate::lab) fn placed(at: &Field, changes: &[DesignChange]) -> Vec<PlacedChange> {
    changes.iter().enumerate().map(|(place, change)| (at.index(place), change.clone())).collect()
}

/// The seeds of an experiment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SeedBlocks {
    /// The first seed; the others follow it.
    pub first: u64,
    /// How many.
    pub number: u32,
}

impl SeedBlocks {
    /// All of them, in order.
    pub fn seeds(self) -> impl Iterator<Item = u64> {
        (self.first..).take(self.number as usize)
    }

    /// Whether there is one and no more than so many, and none is too large.
    pub(in crate::lab) fn check(self, field: &str, most: usize) -> Result<(), Fault> {
        check_count(&format!("{field}.number"), "the number of seeds", self.number as usize, 1..=most)?;
        let last = self.first.checked_add(self.number.into());
        ensure(last.is_some_and(|last| last <= LARGEST_SEED), &format!("{field}.first"), || {
            format!("seeds must be {LARGEST_SEED} at most")
        })
    }
}

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the variant says what its fields are")]
pub enum UntilRule {
    /// When the interval of a metric's mean is as narrow as this in each treatment, at this confidence.
    Width { metric: Metric, confidence: f64, width: f64 },
}

/// Treatments at most.
const TREATMENTS: usize = 1000;
/// Seeds at most.
const BLOCKS: usize = 1_000_000;

impl ExperimentFile {
    /// The number of the treatment with these levels, one for each factor; the last factor changes fastest.
    pub fn treatment(&self, levels: &[String]) -> Option<usize> {
        if levels.len() != self.factors.len() {
            return None;
        }
        let place =
            |(factor, level): (&Factor, _)| factor.levels.names().iter().position(|name| name == level);
        let places: Option<Vec<usize>> = self.factors.iter().zip(levels).map(place).collect();
        Some(self.treatment_at(&places?))
    }

    /// The number of the treatment with the levels at these places, one for each factor.
    pub fn treatment_at(&self, places: &[usize]) -> usize {
        let factors = self.factors.iter().zip(places);
        factors.fold(0, |number, (factor, place)| number * factor.levels.len() + place)
    }

    /// The places of a treatment's levels, one for each factor.
    pub fn places(&self, treatment: usize) -> Vec<usize> {
        let mut rest = treatment;
        let mut places = vec![0; self.factors.len()];
        for (place, factor) in places.iter_mut().zip(&self.factors).rev() {
            *place = rest % factor.levels.len();
            rest /= factor.levels.len();
        }
        places
    }

    /// How many treatments there are.
    pub fn treatments(&self) -> usize {
        self.factors.iter().map(|factor| factor.levels.len()).fold(1, usize::saturating_mul)
    }
}

impl FactorLevels {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            FactorLevels::Named(levels) => levels.len(),
            FactorLevels::Values { values, .. } => values.len(),
        }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The names of all levels, in order.
    pub fn names(&self) -> Vec<String> {
        match self {
            FactorLevels::Named(levels) => levels.iter().map(|level| level.name.clone()).collect(),
            FactorLevels::Values { values, .. } => values.iter().map(f64::to_string).collect(),
        }
    }

    /// What a level changes, by its place, and where in the file that stands; the levels themselves are at `at`.
    pub fn changes(&self, at: &Field, level: usize) -> Vec<PlacedChange> {
        match self {
            FactorLevels::Named(levels) => {
                placed(&at.key("Named").index(level).key("changes"), &levels[level].changes)
            }
            FactorLevels::Values { file, path, values } => {
                let (file, path, to) = (file.clone(), path.clone(), values[level]);
                vec![(at.key("Values"), DesignChange::Number { file, path, to })]
            }
        }
    }
}

impl Validate for ExperimentFile {
    fn validate(&self) -> Result<(), Fault> {
        ensure(!self.metrics.is_empty(), "metrics", || "needs at least one".into())?;
        self.blocks.check("blocks", BLOCKS)?;
        self.until.validate_as("until")?;
        check_changes(&self.common).map_err(|fault| fault.inside(&Field::root().key("common")))?;
        let mut names: Vec<&str> = Vec::new();
        for (place, factor) in self.factors.iter().enumerate() {
            let at = Field::root().key("factors").index(place);
            factor.validate().map_err(|fault| fault.inside(&at))?;
            ensure(!names.contains(&factor.name.as_str()), "name", || "is the name of another factor".into())
                .map_err(|fault| fault.inside(&at))?;
            names.push(&factor.name);
        }
        check_count("factors", "the number of treatments", self.treatments(), 1..=TREATMENTS)?;
        for (place, claim) in self.claims.iter().enumerate() {
            let at = format!("claims.{place}");
            match claim.is {
                ClaimedDifference::Between(low, high) => {
                    check_range(&format!("{at}.is.Between"), low, high)?;
                    ensure(claim.than.is_empty(), &format!("{at}.than"), || {
                        "is not there in a claim of how much there is".into()
                    })?;
                }
                ClaimedDifference::Within(margin) => check_width(&format!("{at}.is.Within"), margin)?,
                ClaimedDifference::Less | ClaimedDifference::More => {}
            }
            let than = claim.is.compares().then_some(("than", &claim.than));
            for (field, levels) in [("of", &claim.of)].into_iter().chain(than) {
                let at = format!("{at}.{field}");
                ensure(self.treatment(levels).is_some(), &at, || {
                    "must be a level of each factor, in their order".into()
                })?;
            }
        }
        Ok(())
    }
}

impl Validate for UntilRule {
    fn validate(&self) -> Result<(), Fault> {
        let UntilRule::Width { confidence, width, .. } = self;
        ensure((0.5..1.0).contains(confidence), "Width.confidence", || {
            format!("must be from 0.5 to less than 1, not {confidence}")
        })?;
        check_width("Width.width", *width)
    }
}

/// Checks a width or a margin, in the unit of a metric.
fn check_width(field: &str, width: f64) -> Result<(), Fault> {
    ensure(width > 0.0, field, || format!("must be positive, not {width:?}"))?;
    Bound::ANY.check(field, width as f32)
}

fn check_range(field: &str, low: f64, high: f64) -> Result<(), Fault> {
    Bound::ANY.check(&format!("{field}.0"), low as f32)?;
    Bound::ANY.check(&format!("{field}.1"), high as f32)?;
    ensure(low < high, field, || format!("must begin below its end, not ({low:?}, {high:?})"))
}

impl Validate for Factor {
    fn validate(&self) -> Result<(), Fault> {
        ensure(!self.name.trim().is_empty(), "name", || "is empty".into())?;
        ensure(!self.levels.is_empty(), "levels", || "needs at least one".into())?;
        let names = self.levels.names();
        for (place, name) in names.iter().enumerate() {
            let at = Field::root().key("levels").index(place);
            let is_new = !names[..place].contains(name);
            ensure(is_new, "", || format!("{name} is there twice")).map_err(|fault| fault.inside(&at))?;
        }
        match &self.levels {
            FactorLevels::Named(levels) => {
                for (place, level) in levels.iter().enumerate() {
                    let at = Field::root().key("levels").key("Named").index(place).key("changes");
                    check_changes(&level.changes).map_err(|fault| fault.inside(&at))?;
                }
                Ok(())
            }
            FactorLevels::Values { values, .. } => {
                values.iter().enumerate().try_for_each(|(place, value)| {
                    Bound::ANY.check(&format!("levels.Values.values.{place}"), *value as f32)
                })
            }
        }
    }
}

/// Checks changes that a file lists, as far as they can be without other files.
pub(in crate::lab) fn check_changes(changes: &[DesignChange]) -> Result<(), Fault> {
    for (place, change) in changes.iter().enumerate() {
        let checked = match change {
            DesignChange::HalfMinutes(minutes) => Bound::MINUTES.check("HalfMinutes", *minutes),
            DesignChange::Number { to, .. } => Bound::ANY.check("Number.to", *to as f32),
            DesignChange::TeamNumber { file, to, .. } => Bound::ANY
                .check("TeamNumber.to", *to as f32)
                .and_then(|()| check_is_a_teams("TeamNumber.file", file)),
            _ => Ok(()),
        };
        checked.map_err(|fault| fault.inside(&Field::root().index(place)))?;
    }
    Ok(())
}

/// What files of the asset folder a team plays by; all others are the match's.
const OF_A_TEAM: [AssetKind; 4] =
    [AssetKind::Strategy, AssetKind::Robot, AssetKind::Sensing, AssetKind::Camera];

/// Checks that a file is one that a team plays by.
pub(in crate::lab) fn check_is_a_teams(field: &str, file: &str) -> Result<(), Fault> {
    let folders = OF_A_TEAM.map(AssetKind::folder);
    let is_plain = Path::new(file).components().all(|part| matches!(part, Component::Normal(_)));
    ensure(is_plain && folders.iter().any(|folder| Path::new(file).starts_with(folder)), field, || {
        format!("must be a file that a team plays by, in {}", folders.join(", "))
    })
}
