//! A tuning as it is written: the serde types of `assets/tunings/*.ron`.

use serde::{Deserialize, Serialize};

use crate::data::{Bound, Fault, Field, Validate, check_count, ensure};
use crate::lab::experiment::{
    ClaimedDifference, DesignChange, Metric, NamedLevel, SeedBlocks, check_changes, check_is_a_teams,
};

/// Which numbers are to be found, by which matches they are judged, and what they may not break.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TuningFile {
    /// What is sought, as a sentence.
    pub name: String,
    /// More about it, for people.
    #[serde(default)]
    pub description: String,
    /// The matches that are played; home is the team that is tuned.
    #[serde(default)]
    pub common: Vec<DesignChange>,
    /// The teams that are tuned, each in a search of its own with equal means: the same numbers, seeds and count of candidates. Without
    /// any, the team of `common` is.
    #[serde(default)]
    pub teams: Vec<NamedLevel>,
    /// The numbers that may change, of the home team alone.
    pub parameters: Vec<TunedParameter>,
    /// Parameters whose values never fall from left to right, by name: relations that a paper states.
    #[serde(default)]
    pub never_falling: Vec<Vec<String>>,
    /// What the best numbers have most or least of.
    pub objective: TuningObjective,
    /// The seeds on which candidates race.
    pub training: SeedBlocks,
    /// The seeds on which the winner is then compared with the numbers of before.
    pub held_out: SeedBlocks,
    /// How many candidates begin each race.
    pub candidates: u32,
    /// How many races there are, each about the best of the one before.
    pub races: u32,
}

/// A number that may change, at one place or with the same value at several.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TunedParameter {
    /// Its name in tables.
    pub name: String,
    /// Where it stands; places that a paper says to be equal are one parameter.
    pub at: Vec<TunedNumber>,
    /// The least that it may be.
    pub low: f64,
    /// The most.
    pub high: f64,
}

/// A place of a number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TunedNumber {
    /// Where the file is in the asset folder, such as `strategies/chaos_b3p.ron`; one that a team plays by.
    pub file: String,
    /// Where the number is in the file, such as `teamwork.ball_booking.timeout`.
    pub path: String,
}

/// What candidates are judged by.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TuningObjective {
    /// A figure of the home team.
    pub metric: Metric,
    /// Whether more of it is better, or less.
    pub better: BetterValue,
}

/// Which values of an objective are better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum BetterValue {
    /// Smaller ones.
    Less,
    /// Larger ones.
    More,
}

impl BetterValue {
    /// What is claimed of values that are better.
    pub(super) fn claim(self) -> ClaimedDifference {
        match self {
            BetterValue::Less => ClaimedDifference::Less,
            BetterValue::More => ClaimedDifference::More,
        }
    }

    /// How much of an objective is sought.
    pub(super) fn words(self) -> &'static str {
        match self {
            BetterValue::Less => "the least",
            BetterValue::More => "the most",
        }
    }
}

/// Candidates of a race and races at most.
const MOST: usize = 1000;
/// Seeds of a kind at most.
const SEEDS: usize = 100_000;

impl Validate for TuningFile {
    fn validate(&self) -> Result<(), Fault> {
        check_count("parameters", "the number of parameters", self.parameters.len(), 1..=MOST)?;
        check_count("candidates", "the number of candidates", self.candidates as usize, 2..=MOST)?;
        check_count("races", "the number of races", self.races as usize, 1..=MOST)?;
        self.training.check("training", SEEDS)?;
        self.held_out.check("held_out", SEEDS)?;
        let apart = self.training.first + u64::from(self.training.number) <= self.held_out.first
            || self.held_out.first + u64::from(self.held_out.number) <= self.training.first;
        ensure(apart, "held_out.first", || "seeds that judge must not be seeds of the training".into())?;
        check_changes(&self.common).map_err(|fault| fault.inside(&Field::root().key("common")))?;
        for (place, team) in self.teams.iter().enumerate() {
            let at = Field::root().key("teams").index(place);
            let is_new = self.teams[..place].iter().all(|other| other.name != team.name);
            ensure(is_new, "name", || "is the name of another team".into())
                .and_then(|()| check_team(team))
                .map_err(|fault| fault.inside(&at))?;
        }
        for (place, parameter) in self.parameters.iter().enumerate() {
            let at = Field::root().key("parameters").index(place);
            let is_new = self.parameters[..place].iter().all(|other| other.name != parameter.name);
            let named = ensure(is_new, "name", || "is the name of another parameter".into());
            named.and_then(|()| parameter.validate()).map_err(|fault| fault.inside(&at))?;
        }
        for (place, names) in self.never_falling.iter().enumerate() {
            let unknown = names.iter().position(|name| self.place_of(name).is_none());
            ensure(unknown.is_none(), &format!("never_falling.{place}"), || {
                "names something that is no parameter".into()
            })?;
        }
        Ok(())
    }
}

impl TuningFile {
    /// Whether values, one for each parameter, keep the relations that the file states.
    pub fn admits(&self, values: &[f64]) -> bool {
        self.never_falling.iter().all(|names| {
            names.iter().filter_map(|name| self.place_of(name)).map(|place| values[place]).is_sorted()
        })
    }

    fn place_of(&self, name: &str) -> Option<usize> {
        self.parameters.iter().position(|parameter| parameter.name == name)
    }
}

/// A team has a folder of its name.
fn check_team(team: &NamedLevel) -> Result<(), Fault> {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || letter == '_' || letter == '-';
    ensure(!team.name.is_empty() && team.name.chars().all(is_plain), "name", || {
        "must be of letters, digits, _ and -: it becomes a folder's name".into()
    })?;
    check_changes(&team.changes).map_err(|fault| fault.inside(&Field::root().key("changes")))
}

impl Validate for TunedParameter {
    fn validate(&self) -> Result<(), Fault> {
        ensure(!self.name.trim().is_empty(), "name", || "is empty".into())?;
        ensure(!self.at.is_empty(), "at", || "needs a place".into())?;
        for (place, number) in self.at.iter().enumerate() {
            check_is_a_teams("file", &number.file)
                .map_err(|fault| fault.inside(&Field::root().key("at").index(place)))?;
        }
        for (field, end) in [("low", self.low), ("high", self.high)] {
            Bound::ANY.check(field, end as f32)?;
        }
        ensure(self.low < self.high, "high", || format!("must be more than {}", self.low))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Source;

    const SOUND: &str = r#"(
        name: "x",
        teams: [(name: "old"), (name: "new")],
        parameters: [
            (name: "slow", at: [(file: "strategies/a.ron", path: "b")], low: 0, high: 1),
            (name: "fast", at: [(file: "strategies/a.ron", path: "c")], low: 0, high: 1),
        ],
        never_falling: [["slow", "fast"]],
        objective: (metric: GoalDifference, better: More),
        training: (first: 1, number: 10),
        held_out: (first: 100, number: 10),
        candidates: 4,
        races: 2,
    )"#;

    fn read(text: &str) -> Result<TuningFile, String> {
        Source::new("a.ron", text).parse_sound().map_err(|error| error.to_string())
    }

    #[test]
    fn stated_relations_are_kept() {
        let file = read(SOUND).unwrap();
        assert!(file.admits(&[0.2, 0.2]) && file.admits(&[0.2, 0.3]));
        assert!(!file.admits(&[0.3, 0.2]));
    }

    #[test]
    fn what_cannot_be_tuned_is_refused_at_its_place() {
        for (was, is, named) in [
            ("first: 100", "first: 10", "held_out.first"),
            ("candidates: 4", "candidates: 1", "candidates"),
            ("races: 2", "races: 0", "races"),
            ("\"fast\", at", "\"slow\", at", "parameters[1].name"),
            ("[[\"slow\"", "[[\"slowest\"", "never_falling"),
            (
                "low: 0, high: 1),\n            (name: \"fast\"",
                "low: 1, high: 1),\n            (name: \"fast\"",
                "parameters[0].high",
            ),
            ("name: \"new\"", "name: \"old\"", "teams[1].name"),
            ("name: \"new\"", "name: \"../new\"", "teams[1].name"),
            (
                "name: \"new\"",
                "name: \"new\", changes: [HalfMinutes(-1.0)]",
                "teams[1].changes[0].HalfMinutes",
            ),
            ("strategies/a.ron", "radios/a.ron", "parameters[0].at[0].file"),
            ("number: 10),\n        held", "number: 0),\n        held", "training.number"),
        ] {
            let text = SOUND.replacen(was, is, 1);
            assert_ne!(text, SOUND, "{was}");
            let error = read(&text).unwrap_err();
            assert!(error.contains(named), "{error}");
        }
    }
}
