//! What is played in an experiment: every treatment with every seed, on both sides.

use std::path::Path;

use super::effect::{check_effects, read_treatment};
use super::file::{ExperimentFile, PlacedChange, placed};
use super::row::{ExperimentRow, RowKey};
use super::treatment::TreatmentPlan;
use crate::data::{AssetFolder, AssetKind, DataError, Field, Source};

/// An experiment that can be played. Its matches are numbered seed by seed, so that the first rows of a table hold as many
/// matches of one treatment as of another.
#[derive(Clone, Debug)]
pub struct ExperimentPlan {
    /// What was asked.
    pub file: ExperimentFile,
    /// The text of its file.
    pub text: String,
    treatments: Vec<TreatmentPlan>,
    /// The places of each treatment's levels in the factors.
    levels: Vec<Vec<usize>>,
}

impl ExperimentPlan {
    /// Reads an experiment, by its name among the assets or its path, and everything that its matches need.
    ///
    /// # Errors
    /// The first file that is missing or wrong, with the place of the fault.
    pub fn read(assets: &AssetFolder, name: &str) -> Result<ExperimentPlan, DataError> {
        ExperimentPlan::read_file(assets, &assets.file(AssetKind::Experiment, name))
    }

    /// As [`ExperimentPlan::read`], from a path.
    ///
    /// # Errors
    /// As there.
    pub fn read_file(assets: &AssetFolder, path: &Path) -> Result<ExperimentPlan, DataError> {
        ExperimentPlan::of_source(assets, &assets.read(path)?)
    }

    /// As [`ExperimentPlan::read`], from a text.
    ///
    /// # Errors
    /// As there.
    pub fn of_source(assets: &AssetFolder, source: &Source) -> Result<ExperimentPlan, DataError> {
        let file: ExperimentFile = source.parse_sound()?;
        for (place, factor) in file.factors.iter().enumerate() {
            if super::row::is_column(&factor.name) {
                let at = Field::root().key("factors").index(place).key("name");
                return Err(source.error_at(&at, format!("{} is the name of a column already", factor.name)));
            }
        }
        let levels: Vec<Vec<usize>> = (0..file.treatments()).map(|number| file.places(number)).collect();
        let treatments = levels.iter().map(|levels| read_treatment(assets, source, &changes(&file, levels)));
        let treatments = treatments.collect::<Result<Vec<TreatmentPlan>, _>>()?;
        let changes = levels.iter().map(|levels| changes(&file, levels));
        check_effects(assets, source, &changes.zip(&treatments).collect::<Vec<_>>())?;
        Ok(ExperimentPlan { text: source.text.to_string(), file, treatments, levels })
    }

    /// How many matches there are.
    pub fn matches(&self) -> u64 {
        u64::from(self.file.blocks.number) * self.in_block()
    }

    /// How many matches have the same seed.
    pub fn in_block(&self) -> u64 {
        (self.treatments.len() * self.sides()) as u64
    }

    /// How many matches a treatment has with a seed.
    pub fn sides(&self) -> usize {
        1 + usize::from(self.file.swap_sides)
    }

    /// How many treatments there are.
    pub fn treatments(&self) -> usize {
        self.treatments.len()
    }

    /// The names of the levels of a treatment, one for each factor.
    pub fn level_names(&self, treatment: usize) -> Vec<String> {
        let levels = self.file.factors.iter().zip(&self.levels[treatment]);
        levels.map(|(factor, level)| factor.levels.names().swap_remove(*level)).collect()
    }

    /// What the match of a number is, counted from 0.
    pub fn key(&self, row: u64) -> RowKey {
        let (block, place) = (row / self.in_block(), (row % self.in_block()) as usize);
        RowKey {
            row,
            treatment: place / self.sides(),
            seed: self.file.blocks.first + block,
            swapped: place % self.sides() == 1,
        }
    }

    /// The strategies of a treatment, that of the team that is named first first.
    pub fn strategies(&self, treatment: usize) -> &[String; 2] {
        &self.treatments[treatment].strategies
    }

    /// What the files of a treatment's matches hold, as a number.
    pub fn assets_hash(&self, treatment: usize) -> u64 {
        self.treatments[treatment].assets
    }

    /// Plays the match of a number. One that breaks the program is a row that says so.
    pub fn play(&self, row: u64) -> ExperimentRow {
        let key = self.key(row);
        let treatment = &self.treatments[key.treatment];
        ExperimentRow {
            levels: self.level_names(key.treatment),
            strategies: treatment.strategies.clone(),
            assets: treatment.assets,
            result: treatment.play(key.seed, key.swapped),
            key,
        }
    }
}

fn changes(file: &ExperimentFile, levels: &[usize]) -> Vec<PlacedChange> {
    let mut changes = placed(&Field::root().key("common"), &file.common);
    for (place, (factor, level)) in file.factors.iter().zip(levels).enumerate() {
        let at = Field::root().key("factors").index(place).key("levels");
        changes.extend(factor.levels.changes(&at, *level));
    }
    changes
}
