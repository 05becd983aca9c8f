//! A tuning that can be played: the matches of any values of its parameters, and the files with them in.

use std::collections::BTreeSet;
use std::path::Path;

use super::file::{BetterValue, TunedNumber, TuningFile};
use super::race::ParameterSpace;
use super::row::TuningRow;
use crate::data::{AssetFolder, AssetKind, DataError, Field, Source, with_number};
use crate::lab::all_cores::on_all_cores;
use crate::lab::experiment::{DesignChange, PlacedChange, TreatmentPlan, VERSION, number_at, placed};

/// A tuning that can be played.
#[derive(Clone, Debug)]
pub struct TuningPlan {
    /// What was asked.
    pub file: TuningFile,
    source: Source,
    assets: AssetFolder,
    original: Vec<f64>,
    before: TreatmentPlan,
}

/// Values that can be played.
#[derive(Clone, Debug)]
pub struct TuningCandidate {
    /// Its number; that of the values of before is 0.
    pub number: usize,
    treatment: TreatmentPlan,
}

impl TuningCandidate {
    /// Of all files that its matches are read from, and of its values, in hexadecimal.
    pub fn assets_hash(&self) -> String {
        format!("{:016x}", self.treatment.assets)
    }
}

impl TuningPlan {
    /// Reads a tuning, by its name among the assets or its path, and everything that its matches need.
    ///
    /// # Errors
    /// The first file that is missing or wrong, or the first thing that cannot be tuned, with its place.
    pub fn read(assets: &AssetFolder, name: &str) -> Result<TuningPlan, DataError> {
        TuningPlan::read_file(assets, &assets.file(AssetKind::Tuning, name))
    }

    /// As [`TuningPlan::read`], from a path.
    ///
    /// # Errors
    /// As there.
    pub fn read_file(assets: &AssetFolder, path: &Path) -> Result<TuningPlan, DataError> {
        let source = assets.read(path)?;
        let file: TuningFile = source.parse_sound()?;
        let before = TreatmentPlan::read(assets, &source, &changes(&file, None))?;
        let mut original = Vec::new();
        for (place, parameter) in file.parameters.iter().enumerate() {
            let at = Field::root().key("parameters").index(place);
            let mut values = Vec::new();
            for (place, number) in parameter.at.iter().enumerate() {
                let at = at.key("at").index(place);
                values.push(
                    value(assets, number)
                        .map_err(|(field, message)| source.error_at(&at.key(field), message))?,
                );
            }
            let is_one = values.iter().all(|value| *value == values[0]);
            if !is_one || !(parameter.low..=parameter.high).contains(&values[0]) {
                let message = match is_one {
                    true => format!(
                        "is {} now, which is not from {} to {}",
                        values[0], parameter.low, parameter.high
                    ),
                    false => format!("has several values now: {values:?}"),
                };
                return Err(source.error_at(&at, message));
            }
            original.push(values[0]);
        }
        if !file.admits(&original) {
            return Err(
                source.error_at(&Field::root().key("never_falling"), "does not hold of the values of now")
            );
        }
        let plan = TuningPlan { file, source, assets: assets.clone(), original, before };
        plan.opponent_stays()?;
        Ok(plan)
    }

    /// The text of its file.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// Where candidates are sought.
    pub fn space(&self) -> ParameterSpace {
        let ranges = self.file.parameters.iter().map(|parameter| (parameter.low, parameter.high));
        ParameterSpace { original: self.original.clone(), ranges: ranges.collect() }
    }

    /// Values, one for each parameter, as they are played.
    ///
    /// # Errors
    /// If the files do not allow them.
    pub fn candidate(&self, number: usize, values: &[f64]) -> Result<TuningCandidate, DataError> {
        let treatment = match number {
            0 => self.before.clone(),
            _ => TreatmentPlan::read(&self.assets, &self.source, &changes(&self.file, Some(values)))?,
        };
        Ok(TuningCandidate { number, treatment })
    }

    /// Whether values keep all relations and bounds.
    pub fn admits(&self, values: &[f64]) -> bool {
        self.file.admits(values) && self.candidate(usize::MAX, values).is_ok()
    }

    /// What is better of two values of the objective has the higher score.
    pub fn score(&self, value: f64) -> f64 {
        match self.file.objective.better {
            BetterValue::More => value,
            BetterValue::Less => -value,
        }
    }

    /// Plays matches of candidates on all cores, each a candidate by its place, a seed and a side, and hands over each that is over;
    /// until it is told to stop.
    ///
    /// # Errors
    /// The first one of what takes the rows.
    pub fn play<E>(
        &self,
        candidates: &[TuningCandidate],
        matches: Vec<(usize, u64, bool)>,
        take: impl FnMut(TuningRow) -> Result<bool, E>,
    ) -> Result<(), E> {
        let play = |(place, seed, swapped): (usize, u64, bool)| self.row(&candidates[place], seed, swapped);
        on_all_cores(matches.into_iter(), || (), |(), of| play(of), take)
    }

    fn row(&self, candidate: &TuningCandidate, seed: u64, swapped: bool) -> TuningRow {
        let played = candidate.treatment.play(seed, swapped);
        TuningRow {
            candidate: candidate.number,
            seed,
            swapped,
            version: VERSION.into(),
            assets: candidate.assets_hash(),
            digest: played
                .as_ref()
                .map_or_else(|_| String::new(), |played| format!("{:016x}", played.digest)),
            value: played.as_ref().ok().and_then(|played| played.value(self.file.objective.metric)),
            error: played.err().unwrap_or_default(),
        }
    }

    /// The files with these values in, comments and all, by their names in the asset folder.
    ///
    /// # Errors
    /// If a file cannot be read.
    pub fn files(&self, values: &[f64]) -> Result<Vec<(String, String)>, DataError> {
        let places = || {
            self.file
                .parameters
                .iter()
                .zip(values)
                .flat_map(|(parameter, value)| parameter.at.iter().map(move |number| (number, *value)))
        };
        let names: BTreeSet<&str> = places().map(|(number, _)| number.file.as_str()).collect();
        let written = |name: &str| {
            let mut text = self.assets.read(&self.assets.root().join(name))?.text.to_string();
            for (TunedNumber { path, .. }, value) in places().filter(|(number, _)| number.file == name) {
                let number = number_at(&text, path).map_err(|message| DataError::new(name, message))?;
                text = with_number(&text, &number, value);
            }
            Ok((name.to_owned(), text))
        };
        names.into_iter().map(written).collect()
    }

    /// Other values would otherwise be worth nothing: both teams would have them.
    fn opponent_stays(&self) -> Result<(), DataError> {
        for (place, parameter) in self.file.parameters.iter().enumerate() {
            let mut values = self.original.clone();
            values[place] = if values[place] == parameter.low { parameter.high } else { parameter.low };
            // What the files do not allow is told when it is drawn: it may do with other values beside it.
            let Ok(candidate) = self.candidate(usize::MAX, &values) else { continue };
            if candidate.treatment.opponent() != self.before.opponent() {
                let at = Field::root().key("parameters").index(place);
                return Err(self.source.error_at(&at, "changes the opponent's strategy, too"));
            }
        }
        Ok(())
    }
}

/// What a number is now; or what is wrong with which field.
fn value(assets: &AssetFolder, number: &TunedNumber) -> Result<f64, (&'static str, String)> {
    let text =
        assets.read(&assets.root().join(&number.file)).map_err(|error| ("file", error.to_string()))?.text;
    number_at(&text, &number.path).map(|number| number.value).map_err(|message| ("path", message))
}

fn changes(file: &TuningFile, values: Option<&[f64]>) -> Vec<PlacedChange> {
    let mut changes = placed(&Field::root().key("common"), &file.common);
    for (place, (parameter, to)) in file.parameters.iter().zip(values.unwrap_or_default()).enumerate() {
        let at = Field::root().key("parameters").index(place).key("at");
        changes.extend(parameter.at.iter().enumerate().map(|(place, TunedNumber { file, path })| {
            (at.index(place), DesignChange::Number { file: file.clone(), path: path.clone(), to: *to })
        }));
    }
    changes
}
