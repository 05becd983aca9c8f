//! One match of a tuning, as a row of a table, and all that were played so far.

use std::collections::BTreeMap;
use std::path::Path;

use csv::{ReaderBuilder, WriterBuilder};
use serde::{Deserialize, Serialize};

use crate::data::DataError;
use crate::lab::experiment::check_version;
use crate::lab::statistics::mean;

/// One match.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TuningRow {
    /// The number of the candidate.
    pub candidate: usize,
    /// The seed of its dice.
    pub seed: u64,
    /// Whether the teams had each other's sides.
    pub swapped: bool,
    /// The version of the program.
    pub version: String,
    /// A hash of all files that it was read from, and of the candidate's values, in hexadecimal.
    pub assets: String,
    /// Equal digests mean equal matches; in hexadecimal, and empty if it broke off.
    pub digest: String,
    /// Why it broke off.
    pub error: String,
    /// What the objective measures; none if it broke off.
    pub value: Option<f64>,
}

/// The matches that are known, by candidate, seed and side.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KnownMatches(BTreeMap<(usize, u64, bool), TuningRow>);

impl KnownMatches {
    /// Reads a table. A last line that was not written to its end does not count.
    ///
    /// # Errors
    /// If the text is no table of a tuning, or was written by another version of the program.
    pub fn read(path: &Path, text: &str) -> Result<KnownMatches, DataError> {
        let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
        let mut known = KnownMatches::default();
        for (place, row) in ReaderBuilder::new().from_reader(whole.as_bytes()).deserialize().enumerate() {
            let fault =
                |message: String| DataError { line: Some(place + 2), ..DataError::new(path, message) };
            let row: TuningRow = row.map_err(|error| fault(error.to_string()))?;
            check_version(&row.version).map_err(fault)?;
            known.add(row);
        }
        Ok(known)
    }

    /// As a table.
    ///
    /// # Errors
    /// If a row cannot be written.
    pub fn table(&self) -> csv::Result<Vec<u8>> {
        let mut table = WriterBuilder::new().from_writer(Vec::new());
        self.0.values().try_for_each(|row| table.serialize(row))?;
        table.into_inner().map_err(|error| error.into_error().into())
    }

    /// Adds a match.
    pub fn add(&mut self, row: TuningRow) {
        self.0.insert((row.candidate, row.seed, row.swapped), row);
    }

    /// A match, if it is known.
    pub fn get(&self, candidate: usize, seed: u64, swapped: bool) -> Option<&TuningRow> {
        self.0.get(&(candidate, seed, swapped))
    }

    /// The value of a candidate with a seed, if both matches are known and whole: their mean.
    pub fn value(&self, candidate: usize, seed: u64) -> Option<f64> {
        let sides = [false, true].map(|swapped| self.get(candidate, seed, swapped)?.value);
        mean(&[sides[0]?, sides[1]?])
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(candidate: usize, value: Option<f64>) -> TuningRow {
        TuningRow {
            candidate,
            seed: 7,
            swapped: true,
            version: env!("CARGO_PKG_VERSION").into(),
            assets: "0a".into(),
            digest: "0b".into(),
            error: String::new(),
            value,
        }
    }

    #[test]
    fn a_table_reads_back_as_it_was_written_but_for_a_line_that_was_cut_off() {
        let mut known = KnownMatches::default();
        known.add(row(0, Some(0.25)));
        known.add(TuningRow { digest: String::new(), error: "broke, off".into(), ..row(1, None) });
        let text = String::from_utf8(known.table().unwrap()).unwrap();
        assert_eq!(KnownMatches::read(Path::new("a.csv"), &text), Ok(known.clone()));
        let cut = KnownMatches::read(Path::new("a.csv"), &text[..text.len() - 4]).unwrap();
        assert_eq!((cut.len(), cut.get(0, 7, true)), (1, known.get(0, 7, true)));
        let other = KnownMatches::read(Path::new("a.csv"), &text.replace(env!("CARGO_PKG_VERSION"), "0.0.0"));
        assert!(other.unwrap_err().to_string().starts_with("a.csv:2"));
    }
}
