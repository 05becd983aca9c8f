//! The numbers of the texts of a strategy, beside those of its files.

use std::path::PathBuf;
use std::sync::Arc;

use crate::data::{NumberToken, numbers, with_number};
use crate::strategy::StrategyTexts;

/// The numbers that were found last, and in what.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FoundNumbers {
    of: Option<(Arc<StrategyTexts>, Arc<StrategyTexts>)>,
    rows: Arc<[NumberRow]>,
}

impl FoundNumbers {
    /// The numbers of a strategy beside those of its files; the texts are looked through only where they are others than before.
    pub fn of(&mut self, running: &Arc<StrategyTexts>, filed: &Arc<StrategyTexts>) -> Arc<[NumberRow]> {
        let is_known = |(known, other): &(Arc<StrategyTexts>, Arc<StrategyTexts>)| {
            Arc::ptr_eq(known, running) && Arc::ptr_eq(other, filed)
        };
        if !self.of.as_ref().is_some_and(is_known) {
            self.rows = rows(running, filed).into();
            self.of = Some((running.clone(), filed.clone()));
        }
        self.rows.clone()
    }
}

/// A number of a running strategy.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberRow {
    /// The file that it stands in.
    pub file: PathBuf,
    /// Its path, as people read it.
    pub path: String,
    /// As it runs.
    pub number: NumberToken,
    /// What the file says; none if its text is another one altogether.
    pub filed: Option<f64>,
}

impl NumberRow {
    /// Whether the running number is not that of its file.
    pub fn differs(&self) -> bool {
        self.filed.is_some_and(|filed| filed != self.number.value)
    }
}

/// The numbers of a strategy, its own file first, then those that it is based on.
fn rows(running: &StrategyTexts, filed: &StrategyTexts) -> Vec<NumberRow> {
    let own = running.files.get_key_value(&running.path);
    let bases = running.files.iter().filter(|(path, _)| **path != running.path);
    own.into_iter()
        .chain(bases)
        .flat_map(|(file, text)| {
            let theirs = filed.files.get(file).map(|text| numbers(text)).unwrap_or_default();
            let ours = numbers(text);
            let is_same =
                ours.iter().map(|number| &number.field).eq(theirs.iter().map(|number| &number.field));
            ours.into_iter().enumerate().map(move |(place, number)| NumberRow {
                file: file.clone(),
                path: number.field.to_string(),
                filed: theirs.get(place).filter(|_| is_same).map(|number| number.value),
                number,
            })
        })
        .collect()
}

/// The texts with another value of one of their numbers.
pub(super) fn changed(running: &StrategyTexts, row: &NumberRow, value: f64) -> StrategyTexts {
    let mut texts = running.clone();
    if let Some(text) = texts.files.get_mut(&row.file) {
        *text = with_number(text, &row.number, value);
    }
    texts
}
