//! Reading the files that need no more than themselves, and finding those that another file names.

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

use crate::comms::tcm::Directory;
use crate::comms::tcm::Peer;
use crate::data::{AssetFolder, AssetKind, DataError, Field, Source, TopLevel, Validate, no_such};

/// Reads the table of addresses.
pub(crate) fn read_addresses(assets: &AssetFolder, path: &Path) -> Result<Directory, DataError> {
    let source = assets.read(path)?;
    let directory: Directory = source.parse()?;
    match directory.fault() {
        Some((entity, message)) => Err(source.error_at(&entry_of(&source, entity), message)),
        None => Ok(directory),
    }
}

/// The entry of an entity, however its name is written; the last one of several.
fn entry_of(source: &Source, entity: String) -> Field {
    let wanted = entity.parse::<Peer>();
    let written = match source.top_level() {
        Ok(TopLevel::Map(keys)) => keys.into_iter().rev().find(|key| key.parse::<Peer>() == wanted),
        _ => None,
    };
    Field::root().key(written.unwrap_or(entity))
}

/// The file of a kind that another file names in a field.
///
/// # Errors
/// If there is no such file.
pub(crate) fn file_named(
    assets: &AssetFolder,
    source: &Source,
    kind: AssetKind,
    (field, name): (&Field, &str),
) -> Result<PathBuf, DataError> {
    let path = assets.file(kind, name);
    if assets.has_file(&path) {
        return Ok(path);
    }
    Err(source.error_at(field, no_such(&kind.to_string(), name, assets.names(kind))))
}

/// Reads a file whose type checks its own numbers.
pub(crate) fn checked<T: DeserializeOwned + Validate>(
    assets: &AssetFolder,
    path: &Path,
) -> Result<T, DataError> {
    assets.read(path)?.parse_sound()
}
