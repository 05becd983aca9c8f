//! The numbers of the texts of a strategy, beside those of its files.

use std::path::PathBuf;

use crate::data::{NumberToken, numbers, with_number};
use crate::strategy::StrategyTexts;

/// A number of a running strategy.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberRow {
    /// The file that it stands in.
    pub file: PathBuf,
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
pub fn rows(running: &StrategyTexts, filed: &StrategyTexts) -> Vec<NumberRow> {
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
