//! What went wrong with a file, in one line: where it is, which field it concerns and what the trouble is.
//!
//! The line has the form that compilers use, so that editors and terminals can jump to it.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::field::Field;

/// A file, or a folder of files, that cannot be used as it stands.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}", one_line(.path, (*.line, *.column), .field, .message))]
pub struct DataError {
    /// The file or folder.
    pub path: PathBuf,
    /// Counted from 1; `None` if the whole file is concerned.
    pub line: Option<usize>,
    /// Counted from 1, in characters; `None` if the whole file is concerned.
    pub column: Option<usize>,
    /// The value concerned; empty for the whole file or when the text could not be followed.
    pub field: Field,
    /// What the trouble is, in words, without the place.
    pub message: String,
}

impl DataError {
    /// An error about the whole of a file or folder.
    pub fn new(path: impl Into<PathBuf>, message: impl Into<String>) -> DataError {
        DataError {
            path: path.into(),
            line: None,
            column: None,
            field: Field::root(),
            message: message.into(),
        }
    }

    /// The same error at a line and a column, both counted from 1.
    pub fn at(mut self, (line, column): (usize, usize)) -> DataError {
        self.line = Some(line);
        self.column = Some(column);
        self
    }

    /// The same error about one field.
    pub fn about(mut self, field: Field) -> DataError {
        self.field = field;
        self
    }
}

/// "there is no state `trak`; known: search, track": the message for a name that refers to nothing.
pub fn no_such<S: AsRef<str>>(what: &str, name: &str, known: impl IntoIterator<Item = S>) -> String {
    let mut message = format!("there is no {what} `{name}`");
    for (i, known) in known.into_iter().enumerate() {
        message.push_str(if i == 0 { "; known: " } else { ", " });
        message.push_str(known.as_ref());
    }
    message
}

fn one_line(path: &Path, place: (Option<usize>, Option<usize>), field: &Field, message: &str) -> String {
    let mut text = path.display().to_string();
    for number in [place.0, place.1].into_iter().flatten() {
        text.push_str(&format!(":{number}"));
    }
    if !field.is_root() {
        text.push_str(&format!(": {field}"));
    }
    text.push_str(": ");
    text.push_str(message);
    in_one_line(&text)
}

/// Names come from files and may hold anything; control characters and line separators become spaces.
pub fn in_one_line(text: &str) -> String {
    text.replace(|c: char| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}'), " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_names_file_line_column_field_and_trouble_in_one_line() {
        let field = Field::root()
            .key("machines")
            .key("goalie")
            .key("states")
            .key("search")
            .key("on")
            .index(0)
            .key("go");
        let message = no_such("state", "trak", ["search", "track"]);
        let error = DataError::new("assets/strategies/x.ron", message).at((12, 9)).about(field);
        assert_eq!(
            error.to_string(),
            "assets/strategies/x.ron:12:9: machines.goalie.states.search.on[0].go: \
             there is no state `trak`; known: search, track"
        );
    }

    #[test]
    fn an_error_about_a_whole_file_has_neither_place_nor_field() {
        assert_eq!(DataError::new("x.ron", "no such file").to_string(), "x.ron: no such file");
    }

    #[test]
    fn line_breaks_in_names_do_not_break_the_line() {
        let error = DataError::new("a\nb.ron", no_such("role", "x\r\ny", ["\u{2028}"])).at((1, 1));
        let error = error.about(Field::root().key("p\nq"));
        assert_eq!(error.to_string().lines().count(), 1);
        assert!(!error.to_string().contains('\u{2028}'));
    }

    #[test]
    fn with_nothing_known_only_the_unknown_name_is_reported() {
        assert_eq!(no_such::<&str>("role", "x", []), "there is no role `x`");
    }
}
