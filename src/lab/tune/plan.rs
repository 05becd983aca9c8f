//! A tuning that can be played: the matches of any values of its parameters, and the files with them in.

use std::collections::BTreeMap;
use std::path::Path;

use super::file::{BetterValue, TunedNumber, TunedParameter, TuningFile};
use super::race::ParameterSpace;
use super::row::TuningRow;
use crate::data::{AssetFolder, AssetKind, DataError, Field, Source, with_number};
use crate::ids::Team;
use crate::lab::all_cores::on_all_cores;
use crate::lab::experiment::{
    DesignChange, PlacedChange, TreatmentPlan, VERSION, check_effects, number_at, placed, read_treatment,
};

/// A tuning of one team that can be played.
#[derive(Clone, Debug)]
pub struct TuningPlan {
    /// What was asked.
    pub file: TuningFile,
    /// The team among those of the file; none if it names none.
    team: Option<usize>,
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

/// Matches that a search asks for: some candidates, and of each match the place of its candidate, the seed, and whether the teams have
/// each other's sides.
#[derive(Clone, Debug)]
pub struct WantedMatches {
    /// Who plays.
    pub candidates: Vec<TuningCandidate>,
    /// Those of their matches that are not known yet.
    pub matches: Vec<(usize, u64, bool)>,
}

impl TuningCandidate {
    /// Of all files that its matches are read from, and of its values, in hexadecimal.
    pub fn assets_hash(&self) -> String {
        format!("{:016x}", self.treatment.assets)
    }
}

impl TuningPlan {
    /// Reads a tuning, by its name among the assets or its path, and everything that its matches need: a plan for each of its teams.
    ///
    /// # Errors
    /// The first file that is missing or wrong, or the first thing that cannot be tuned, with its place.
    pub fn read(assets: &AssetFolder, name: &str) -> Result<Vec<TuningPlan>, DataError> {
        TuningPlan::read_file(assets, &assets.file(AssetKind::Tuning, name))
    }

    /// As [`TuningPlan::read`], from a path.
    ///
    /// # Errors
    /// As there.
    pub fn read_file(assets: &AssetFolder, path: &Path) -> Result<Vec<TuningPlan>, DataError> {
        let source = assets.read(path)?;
        let file: TuningFile = source.parse_sound()?;
        let original = values_of_now(assets, &source, &file)?;
        let teams = match file.teams.len() {
            0 => vec![None],
            count => (0..count).map(Some).collect(),
        };
        let plan = |team| {
            let before = read_treatment(assets, &source, &changes(&file, team, None))?;
            let (file, source, original) = (file.clone(), source.clone(), original.clone());
            let plan = TuningPlan { file, team, source, assets: assets.clone(), original, before };
            plan.team_changes().map(|()| plan)
        };
        let plans = teams.into_iter().map(plan).collect::<Result<Vec<TuningPlan>, _>>()?;
        let changes = plans.iter().map(|plan| (changes(&file, plan.team, None), &plan.before));
        check_effects(assets, &source, &changes.collect::<Vec<_>>())?;
        Ok(plans)
    }

    /// The name of the team, if the file names teams.
    pub fn team(&self) -> Option<&str> {
        self.team.map(|team| self.file.teams[team].name.as_str())
    }

    /// Where its file is.
    pub fn path(&self) -> &Path {
        &self.source.path
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
            _ => TreatmentPlan::read(
                &self.assets,
                &self.source,
                &changes(&self.file, self.team, Some(values)),
            )?,
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

    /// Plays matches on all cores, and hands over each that is over; until it is told to stop.
    ///
    /// # Errors
    /// The first one of what takes the rows.
    pub fn play<E>(
        &self,
        wanted: WantedMatches,
        take: impl FnMut(TuningRow) -> Result<bool, E>,
    ) -> Result<(), E> {
        let WantedMatches { candidates, matches } = wanted;
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

    /// What the team plays by with these values: its strategy and what that is based on, and whatever else is tuned, by their names in
    /// the asset folder. Where a value is another one, everything else in the file stays as it is, under a line of comment.
    ///
    /// # Errors
    /// If a file cannot be read.
    pub fn files(&self, values: &[f64], comment: &str) -> Result<Vec<(String, String)>, DataError> {
        let parameters = self.file.parameters.iter().zip(values);
        let places: Vec<(&TunedNumber, f64)> = parameters
            .flat_map(|(parameter, value)| parameter.at.iter().map(move |number| (number, *value)))
            .collect();
        let mut texts = self.strategy_texts();
        for (TunedNumber { file, .. }, _) in &places {
            if !texts.contains_key(file) && !Path::new(file).starts_with(AssetKind::Strategy.folder()) {
                texts
                    .insert(file.clone(), self.assets.read(&self.assets.root().join(file))?.text.to_string());
            }
        }
        let tuned = |(name, text): (String, String)| {
            let mut tuned = text.clone();
            for (TunedNumber { path, .. }, value) in places.iter().filter(|(number, _)| number.file == name) {
                let number = number_at(&tuned, path).map_err(|message| DataError::new(&name, message))?;
                tuned = with_number(&tuned, &number, *value);
            }
            let tuned = if tuned == text { text } else { format!("{comment}{tuned}") };
            Ok((name, tuned))
        };
        texts.into_iter().map(tuned).collect()
    }

    /// The files that the team's strategy rests on, by their names in the asset folder.
    fn strategy_texts(&self) -> BTreeMap<String, String> {
        let texts = &self.before.home().strategy_texts.files;
        let name = |path: &Path| match path.strip_prefix(self.assets.root()) {
            Ok(inside) => inside.to_string_lossy().into_owned(),
            Err(_) => {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                format!("{}/{name}", AssetKind::Strategy.folder())
            }
        };
        texts.iter().map(|(path, text)| (name(path), text.to_string())).collect()
    }

    /// Numbers that the team does not play by would be tuned for nothing.
    fn team_changes(&self) -> Result<(), DataError> {
        let moved = self.file.parameters.iter().zip(&self.original);
        let moved: Vec<f64> = moved
            .map(|(parameter, now)| if *now == parameter.low { parameter.high } else { parameter.low })
            .collect();
        // What the files do not allow is told when it is drawn: it may do with other values beside it.
        let Ok(candidate) = self.candidate(usize::MAX, &moved) else { return Ok(()) };
        if candidate.treatment.home() != self.before.home() {
            return Ok(());
        }
        let at = match self.team {
            Some(team) => Field::root().key("teams").index(team),
            None => Field::root().key("parameters"),
        };
        Err(self.source.error_at(&at, "the team plays by none of these numbers"))
    }
}

/// What the parameters of a file are now.
fn values_of_now(assets: &AssetFolder, source: &Source, file: &TuningFile) -> Result<Vec<f64>, DataError> {
    let mut original = Vec::new();
    for (place, parameter) in file.parameters.iter().enumerate() {
        let at = Field::root().key("parameters").index(place);
        let mut values = Vec::new();
        for (place, number) in parameter.at.iter().enumerate() {
            let at = at.key("at").index(place);
            let value = value(assets, number);
            values.push(value.map_err(|(field, message)| source.error_at(&at.key(field), message))?);
        }
        let TunedParameter { low, high, .. } = parameter;
        let message = if values.iter().any(|value| *value != values[0]) {
            format!("has several values now: {values:?}")
        } else if !(low..=high).contains(&&values[0]) {
            format!("is {} now, which is not from {low} to {high}", values[0])
        } else {
            original.push(values[0]);
            continue;
        };
        return Err(source.error_at(&at, message));
    }
    match file.admits(&original) {
        true => Ok(original),
        false => {
            Err(source.error_at(&Field::root().key("never_falling"), "does not hold of the values of now"))
        }
    }
}

/// What a number is now; or what is wrong with which field.
fn value(assets: &AssetFolder, number: &TunedNumber) -> Result<f64, (&'static str, String)> {
    let text =
        assets.read(&assets.root().join(&number.file)).map_err(|error| ("file", error.to_string()))?.text;
    number_at(&text, &number.path).map(|number| number.value).map_err(|message| ("path", message))
}

fn changes(file: &TuningFile, team: Option<usize>, values: Option<&[f64]>) -> Vec<PlacedChange> {
    let mut changes = placed(&Field::root().key("common"), &file.common);
    if let Some(team) = team {
        let at = Field::root().key("teams").index(team).key("changes");
        changes.extend(placed(&at, &file.teams[team].changes));
    }
    for (place, (parameter, to)) in file.parameters.iter().zip(values.unwrap_or_default()).enumerate() {
        let at = Field::root().key("parameters").index(place).key("at");
        changes.extend(parameter.at.iter().enumerate().map(|(place, TunedNumber { file, path })| {
            let (file, path) = (file.clone(), path.clone());
            (at.index(place), DesignChange::TeamNumber { team: Team::Home, file, path, to: *to })
        }));
    }
    changes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tuned_strategy_has_those_that_it_is_based_on_beside_it_with_the_tuned_numbers() {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let plans = TuningPlan::read(&assets, "hammerheads").unwrap();
        let plan = plans.iter().find(|plan| plan.team() == Some("2000")).unwrap();
        let mut values = plan.space().original;
        values[0] = 0.4375;
        let files = plan.files(&values, "// Fitted.\n").unwrap();
        let [(own, own_text), (base, base_text)] = &files[..] else { panic!("{files:?}") };
        assert_eq!(
            [own.as_str(), base],
            ["strategies/hammerheads_2000.ron", "strategies/hammerheads_2001.ron"]
        );
        let shipped = |name: &str| assets.read(&assets.root().join(name)).unwrap().text;
        assert_eq!(own_text.as_str(), &*shipped(own));
        let tuned = shipped(base).replace("standoff: 0.55", "standoff: 0.4375");
        assert_eq!(*base_text, format!("// Fitted.\n{tuned}"));
    }
}
