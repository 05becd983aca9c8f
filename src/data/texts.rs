//! The texts of files that were read, so that what was read from them can be read again when they are gone or changed.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Files and what is in them.
pub type AssetTexts = BTreeMap<PathBuf, String>;

/// Notes which files are read, and what was in them. Copies note in the same list.
#[derive(Clone, Debug, Default)]
pub struct ReadTexts(Arc<Mutex<AssetTexts>>);

impl ReadTexts {
    /// What was read so far.
    pub fn texts(&self) -> AssetTexts {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub(super) fn note(&self, path: &Path, text: &str) {
        let mut texts = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        texts.insert(path.to_owned(), text.to_owned());
    }
}

/// Whether somebody takes notes says nothing of the files.
impl PartialEq for ReadTexts {
    fn eq(&self, _: &ReadTexts) -> bool {
        true
    }
}

impl Eq for ReadTexts {}
