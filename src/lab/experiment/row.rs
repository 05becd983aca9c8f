//! One match of an experiment, as a row of a table.

use super::metric::Metric;

/// Which match a row is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowKey {
    /// Its number, from 0.
    pub row: u64,
    /// The number of its treatment, from 0.
    pub treatment: usize,
    /// The seed of its dice.
    pub seed: u64,
    /// Whether the teams had each other's sides.
    pub swapped: bool,
}

/// One match.
#[derive(Clone, Debug, PartialEq)]
pub struct ExperimentRow {
    /// Which it is.
    pub key: RowKey,
    /// The level of each factor.
    pub levels: Vec<String>,
    /// The strategies, that of the team that is named first first.
    pub strategies: [String; 2],
    /// Of the texts of all files that it was read from.
    pub assets: u64,
    /// What it came to, or why it did not come to its end.
    pub result: Result<MatchResult, String>,
}

/// What a match came to.
#[derive(Clone, Debug, PartialEq)]
pub struct MatchResult {
    /// Equal digests mean equal matches.
    pub digest: u64,
    /// s
    pub seconds: f64,
    /// Seconds of play.
    pub played: f64,
    /// By [`Metric::ALL`], of the team that is named first and of its opponent; what a match has no figure of is nothing.
    pub values: [Vec<Option<f64>>; 2],
}

impl MatchResult {
    /// A figure of the team that is named first, if there is one.
    pub fn value(&self, metric: Metric) -> Option<f64> {
        self.values[0][metric as usize]
    }
}

/// The columns before the levels of the factors.
pub(super) const BEFORE: [&str; 4] = ["row", "treatment", "seed", "swapped"];
/// Those after them, before the figures.
pub(super) const AFTER: [&str; 8] =
    ["strategy", "opponent", "version", "assets", "digest", "error", "seconds", "played"];

/// The names of the columns of figures.
pub(super) fn figure_columns() -> impl Iterator<Item = String> {
    let own = Metric::ALL.iter().map(|metric| metric.column().to_owned());
    own.chain(Metric::ALL.iter().map(|metric| format!("opponent_{}", metric.column())))
}

/// Whether every table has a column of this name.
pub(super) fn is_column(name: &str) -> bool {
    BEFORE.contains(&name) || AFTER.contains(&name) || figure_columns().any(|column| column == name)
}

/// The columns of a table of matches that differ in these factors.
pub(super) fn columns<'a>(factors: impl Iterator<Item = &'a str>) -> Vec<String> {
    let words = BEFORE.into_iter().chain(factors).chain(AFTER).map(str::to_owned);
    words.chain(figure_columns()).collect()
}

/// The version of the program that plays, as tables have it.
pub(in crate::lab) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Whether rows of this version may stand beside new ones.
pub(in crate::lab) fn check_version(version: &str) -> Result<(), String> {
    match version {
        VERSION => Ok(()),
        _ => Err(format!("was played by version {version}, and this is {VERSION}")),
    }
}
