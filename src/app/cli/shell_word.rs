//! Words of a command that a person can type again.

use std::path::Path;

/// A path as a shell takes it for one word.
pub(super) fn quoted(path: &Path) -> String {
    let word = path.display().to_string();
    let is_plain = |letter: char| letter.is_alphanumeric() || "/._-+:,=@%".contains(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word;
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_with_blanks_or_signs_is_quoted() {
        assert_eq!(quoted(Path::new("results/booking.results")), "results/booking.results");
        assert_eq!(quoted(Path::new("my results")), "'my results'");
        assert_eq!(quoted(Path::new("it's")), r"'it'\''s'");
    }
}
