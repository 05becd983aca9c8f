//! Numbers that were changed while a match ran, saved in their files.

use std::path::Path;

use crate::app::whole_file::write_whole;
use crate::data::{Source, in_one_line, numbers, with_number};
use crate::strategy::StrategyTexts;

/// Writes the numbers that differ into the files that they stand in, and says which files were written. All else of a file
/// stays as it is now, comments and layout too.
///
/// # Errors
/// If a file has meanwhile become another one, or it cannot be read or written; in one line. Files before it are written.
pub fn save(running: &StrategyTexts, filed: &StrategyTexts) -> Result<Vec<String>, String> {
    let mut written = Vec::new();
    for (path, text) in &running.files {
        if filed.files.get(path) == Some(text) {
            continue;
        }
        let now = Source::read(path).map_err(|error| error.to_string())?;
        let saved = merged(&now.text, text).ok_or_else(|| {
            in_one_line(&format!(
                "{}: has other numbers now than when the match began; nothing is saved",
                path.display()
            ))
        })?;
        write_whole(path, saved.as_bytes())
            .map_err(|error| in_one_line(&format!("{}: cannot be written: {error}", path.display())))?;
        written.push(name(path));
    }
    Ok(written)
}

/// A text with the numbers of another, if both have the same ones by their paths.
fn merged(text: &str, other: &str) -> Option<String> {
    let (ours, theirs) = (numbers(text), numbers(other));
    if !ours.iter().map(|number| &number.field).eq(theirs.iter().map(|number| &number.field)) {
        return None;
    }
    let mut merged = text.to_owned();
    // From the end, so that places before it stay.
    for (number, new) in ours.iter().zip(&theirs).rev().filter(|(number, new)| number.value != new.value) {
        merged = with_number(&merged, number, new.value);
    }
    Some(merged)
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
