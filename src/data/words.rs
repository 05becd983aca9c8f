//! The errors of ron in the words of this program.
//!
//! Ron's own sentences are kept where they are clear; those that a file's author meets often are put more plainly, and
//! names that do not exist come with the names that do.

use ron::error::Error as RonError;

use super::error::no_such;

/// Says what ron says in the words of this program; `rest` is what follows the place where ron stopped.
pub(super) fn in_words(error: RonError, rest: &str) -> String {
    match error {
        RonError::NoSuchEnumVariant { expected, found, .. } => no_such("variant", &found, expected),
        RonError::NoSuchStructField { expected, found, .. } => no_such("field", &found, expected),
        RonError::MissingStructField { field, .. } => format!("the field `{field}` is missing"),
        RonError::DuplicateStructField { field, .. } => format!("the field `{field}` is given twice"),
        RonError::ExpectedFloat => "expected a number".to_owned(),
        RonError::ExpectedInteger | RonError::InvalidIntegerDigit { .. } => {
            "expected a whole number".to_owned()
        }
        RonError::ExpectedBoolean => "expected true or false".to_owned(),
        RonError::ExpectedString => "expected a string in quotes".to_owned(),
        RonError::ExpectedStringEnd => "this string is never closed".to_owned(),
        RonError::ExpectedComma if rest.starts_with('.') => "expected a whole number".to_owned(),
        RonError::ExpectedComma if rest.is_empty() => "expected a comma or a closing bracket here".to_owned(),
        RonError::ExpectedComma => "expected a comma or a closing bracket before this".to_owned(),
        RonError::ExpectedIdentifier if rest.starts_with('(') => {
            "expected a name, as one pair of brackets is enough here".to_owned()
        }
        RonError::ExpectedIdentifier | RonError::SuggestRawIdentifier(_) => "expected a name".to_owned(),
        RonError::ExpectedMapColon => "expected a colon".to_owned(),
        RonError::Eof => "the file ends in the middle of a value".to_owned(),
        RonError::TrailingCharacters => "there is text after the end of the value".to_owned(),
        other => {
            let text = other.to_string();
            let mut chars = text.chars();
            chars.next().map_or_else(String::new, |first| first.to_lowercase().chain(chars).collect())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_follows_tells_a_fraction_from_a_missing_comma() {
        assert_eq!(in_words(RonError::ExpectedComma, ".5)"), "expected a whole number");
        assert!(in_words(RonError::ExpectedComma, "b: 1").ends_with("before this"));
        assert!(in_words(RonError::ExpectedComma, "").ends_with("here"));
    }

    #[test]
    fn other_errors_keep_the_words_of_ron_with_a_small_letter() {
        assert_eq!(in_words(RonError::ExpectedArrayEnd, ""), "expected closing `]`");
        assert_eq!(in_words(RonError::Message(String::new()), ""), "");
    }
}
