//! The text of one file: read, parsed into a serde type, and kept so that later errors can point into it.
//!
//! Files may leave out `Some(..)`, the name of a newtype and the second pair of brackets of a variant that holds a
//! struct or a tuple: `Avoid(radius: 0.5)`. The errors of ron are put into the words and the form of [`DataError`].

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use bevy::math::Vec2;
use ron::error::{Error as RonError, SpannedError};
use ron::extensions::Extensions;
use serde::de::DeserializeOwned;

use super::bounds::Bound;
use super::error::DataError;
use super::field::Field;
use super::folder::names_in;
use super::locate::{find, line_and_column, locate};
use super::words::in_words;

/// How Touchline reads RON. What is written with other options, those of `ron::to_string` for one, may not read back.
pub fn ron_options() -> ron::Options {
    ron::Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME)
        .with_default_extension(Extensions::UNWRAP_NEWTYPES)
        .with_default_extension(Extensions::UNWRAP_VARIANT_NEWTYPES)
}

/// A file and its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    pub path: PathBuf,
    pub text: String,
}

impl Source {
    /// A text that is already at hand; `path` only names it.
    pub fn new(path: impl Into<PathBuf>, text: impl Into<String>) -> Source {
        Source { path: path.into(), text: text.into() }
    }

    /// Reads a file, without the byte order mark that some editors write.
    ///
    /// # Errors
    ///
    /// If the file is missing (the error then lists its siblings), cannot be read or is not UTF-8.
    pub fn read(path: impl AsRef<Path>) -> Result<Source, DataError> {
        let path = path.as_ref();
        let bytes = std::fs::read(path).map_err(|error| match error.kind() {
            ErrorKind::NotFound => DataError::new(path, missing(path)),
            _ => DataError::new(path, format!("cannot be read: {error}")),
        })?;
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Source::new(path, text.strip_prefix('\u{feff}').unwrap_or(&text))),
            Err(error) => {
                let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
                let good = String::from_utf8_lossy(good);
                Err(DataError::new(path, "not UTF-8 text from here").at(line_and_column(&good, good.len())))
            }
        }
    }

    /// Parses the whole text as one value.
    ///
    /// # Errors
    ///
    /// If the text is not RON, does not fit the type or goes on after the value.
    pub fn parse<T: DeserializeOwned>(&self) -> Result<T, DataError> {
        let mut ron = ron::Deserializer::from_str_with_options(&self.text, &ron_options())
            .map_err(|error| self.explain(error, Field::root()))?;
        let value = serde_path_to_error::deserialize(&mut ron).map_err(|error| {
            let field = Field::from(error.path());
            self.explain(ron.span_error(error.into_inner()), field)
        })?;
        ron.end().map_err(|error| self.explain(ron.span_error(error), Field::root()))?;
        Ok(value)
    }

    /// An error about a field of the parsed value, at the place of its value or of the deepest value around it.
    pub fn error_at(&self, field: &Field, message: impl Into<String>) -> DataError {
        let error = DataError::new(&self.path, message).about(field.clone());
        match locate(&self.text, field.segments()) {
            Some(place) => error.at(place),
            None => error,
        }
    }

    /// Checks a number of the parsed value.
    ///
    /// # Errors
    ///
    /// If it is out of its bound.
    pub fn within(&self, field: &Field, number: f32, bound: Bound) -> Result<(), DataError> {
        bound.fault(number).map_or(Ok(()), |message| Err(self.error_at(field, message)))
    }

    /// Checks both coordinates of a vector of the parsed value.
    ///
    /// # Errors
    ///
    /// If one is out of its bound.
    pub fn vector_within(&self, field: &Field, vector: Vec2, bound: Bound) -> Result<(), DataError> {
        self.within(&field.index(0), vector.x, bound)?;
        self.within(&field.index(1), vector.y, bound)
    }

    /// Puts an error of ron into our words. Ron knows the token it read last and the one it stands at; for an error
    /// that concerns a whole value its start is looked up instead.
    fn explain(&self, error: SpannedError, field: Field) -> DataError {
        let SpannedError { code, span } = error;
        if code != RonError::UnclosedBlockComment && locate(&self.text, &[]).is_none() {
            return DataError::new(&self.path, "the file is empty");
        }
        let token = (span.start.line, span.start.col);
        let cursor = (span.end.line, span.end.col);
        let value = |field: &Field| {
            find(&self.text, field.segments())
                .filter(|found| found.exact)
                .map_or(cursor, |found| line_and_column(&self.text, found.offset))
        };
        let (place, field) = match &code {
            RonError::NoSuchEnumVariant { found, .. } => (token, field.without_last_key(found)),
            RonError::NoSuchStructField { .. }
            | RonError::ExpectedDifferentStructName { .. }
            | RonError::ExpectedStringEnd => (token, field),
            RonError::DuplicateStructField { field: name, .. } => (token, field.key(*name)),
            RonError::MissingStructField { .. }
            | RonError::InvalidValueForType { .. }
            | RonError::ExpectedDifferentLength { .. }
            | RonError::IntegerOutOfBounds
            | RonError::Message(_) => (value(&field), field),
            _ => (cursor, field),
        };
        DataError::new(&self.path, in_words(code, self.rest_at(cursor))).at(place).about(field)
    }

    /// The text from a line and column, both counted from 1, to the end of the line.
    fn rest_at(&self, (line, column): (usize, usize)) -> &str {
        let line = self.text.split('\n').nth(line.saturating_sub(1)).unwrap_or("");
        line.char_indices().nth(column.saturating_sub(1)).map_or("", |(at, _)| &line[at..])
    }
}

fn missing(path: &Path) -> String {
    let siblings = match (path.parent(), path.extension().and_then(|it| it.to_str())) {
        (Some(folder), Some(extension)) if folder.as_os_str().is_empty() => {
            names_in(Path::new("."), extension)
        }
        (Some(folder), Some(extension)) => names_in(folder, extension),
        _ => Vec::new(),
    };
    if siblings.is_empty() {
        "no such file".to_owned()
    } else {
        format!("no such file; there are: {}", siblings.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::fs;

    use proptest::prelude::*;
    use serde::Deserialize;

    use super::*;

    #[derive(Debug, Deserialize, PartialEq)]
    struct Metres(f32);

    #[derive(Debug, Deserialize, PartialEq)]
    #[serde(deny_unknown_fields)]
    struct Ring {
        radius: Metres,
        gain: Option<f32>,
        count: Option<u32>,
    }

    #[derive(Debug, Deserialize, PartialEq)]
    enum Schema {
        Avoid(Ring),
        Go(f32, f32),
        At((f32, f32)),
        Turn { by: f32 },
        Stop,
        All(Vec<Schema>),
    }

    #[derive(Debug, Deserialize, PartialEq)]
    #[serde(deny_unknown_fields)]
    struct Plan {
        name: String,
        #[serde(default)]
        schemas: BTreeMap<String, Schema>,
        #[serde(default)]
        spots: Vec<(f32, f32)>,
        #[serde(default)]
        numbers: BTreeMap<u32, Ring>,
    }

    fn parse(text: &str) -> Result<Plan, DataError> {
        Source::new("x.ron", text).parse()
    }

    /// What is wrong with a plan that holds these fields on its second line.
    fn trouble(fields: &str) -> String {
        parse(&format!("(name: \"é\",\n{fields})")).unwrap_err().to_string()
    }

    #[test]
    fn some_newtypes_and_the_inner_brackets_of_variants_are_left_out() {
        let text = r#"Plan(name: "a", schemas: {
            "a": Avoid(radius: 0.5, gain: 2), "b": At(1, 2), "c": All([Stop, Go(1.0, 2.0), Turn(by: 3)]),
        })"#;
        let ring = Ring { radius: Metres(0.5), gain: Some(2.0), count: None };
        let all = Schema::All(vec![Schema::Stop, Schema::Go(1.0, 2.0), Schema::Turn { by: 3.0 }]);
        let schemas = [("a", Schema::Avoid(ring)), ("b", Schema::At((1.0, 2.0))), ("c", all)];
        assert!(parse(text).unwrap().schemas.into_values().eq(schemas.map(|(_, schema)| schema)));
    }

    #[test]
    fn an_unknown_field_is_reported_where_it_stands() {
        let error = trouble("/* ( */ nme : 3");
        assert_eq!(error, "x.ron:2:9: nme: there is no field `nme`; known: name, schemas, spots, numbers");
    }

    #[test]
    fn a_missing_field_is_reported_at_the_struct_that_lacks_it() {
        assert_eq!(parse(" ()").unwrap_err().to_string(), "x.ron:1:2: the field `name` is missing");
        let error = trouble(r#"schemas: {"a b": Avoid(gain: 1)}"#);
        assert_eq!(error, r#"x.ron:2:18: schemas["a b"].Avoid: the field `radius` is missing"#);
        assert_eq!(trouble("numbers: {7: ()}"), "x.ron:2:14: numbers.7: the field `radius` is missing");
    }

    #[test]
    fn a_field_given_twice_is_reported_at_the_second() {
        assert_eq!(trouble(r#"name: "b""#), "x.ron:2:1: name: the field `name` is given twice");
    }

    #[test]
    fn a_wrong_type_is_reported_at_the_value() {
        for (fields, expected) in [
            ("spots: [(1, 2), (3, nine)]", "2:21: spots[1][1]: expected a number"),
            (
                "spots: [(1, 2), (3)]",
                "2:17: spots[1]: expected a tuple of size 2 but found one element instead",
            ),
            (
                "schemas: {\"a\": All([Stop, Turn(by: true)])}",
                "2:36: schemas.a.All[1].Turn.by: expected a number",
            ),
            ("numbers: {7: (radius: 1, count: -1)}", "2:33: numbers.7.count: integer is out of bounds"),
            ("numbers: {7: (radius: 1, count: 1.5)}", "2:34: numbers.7: expected a whole number"),
            ("schemas: {\"a\": 3}", "2:16: schemas.a: expected a name"),
            ("schemas: {a: Stop}", "2:11: schemas: expected a string in quotes"),
        ] {
            assert_eq!(trouble(fields), format!("x.ron:{expected}"));
        }
    }

    #[test]
    fn an_unknown_variant_is_reported_with_those_that_exist() {
        let error = trouble(r#"schemas: {"a": Avid (radius: 1)}"#);
        let message = "there is no variant `Avid`; known: Avoid, Go, At, Turn, Stop, All";
        assert_eq!(error, format!("x.ron:2:16: schemas.a: {message}"));
    }

    #[test]
    fn text_that_is_not_ron_is_reported_where_it_stops_making_sense() {
        for (text, expected) in [
            ("(name: \"é\"\n  spots: [])", "x.ron:2:3: expected a comma or a closing bracket before this"),
            ("(name: \"é\"", "x.ron:1:11: expected a comma or a closing bracket here"),
            ("(name: \"é", "x.ron:1:8: name: this string is never closed"),
            ("(name: \"é\",) x", "x.ron:1:14: there is text after the end of the value"),
            ("(name = 3)", "x.ron:1:7: expected a colon"),
            ("", "x.ron: the file is empty"),
            ("// only a comment\n", "x.ron: the file is empty"),
            ("/* open", "x.ron:1:8: unclosed block comment"),
        ] {
            assert_eq!(parse(text).unwrap_err().to_string(), expected);
        }
    }

    #[test]
    fn superfluous_brackets_in_a_variant_are_explained() {
        let error = trouble(r#"schemas: {"a": Avoid((radius: 1))}"#);
        let message = "expected a name, as one pair of brackets is enough here";
        assert_eq!(error, format!("x.ron:2:22: schemas.a.Avoid: {message}"));
    }

    #[test]
    fn errors_found_after_parsing_point_at_the_value() {
        let source = Source::new("x.ron", "(\n  // ]\n  spots: [(1, 2), (3, NaN)],\n)");
        let field = Field::root().key("spots").index(1).index(1);
        let error = source.within(&field, f32::NAN, Bound::PLACE).unwrap_err();
        assert_eq!(error.to_string(), "x.ron:3:23: spots[1][1]: must be a number, not NaN");
        let spot = Field::root().key("spots").index(1);
        let error = source.vector_within(&spot, Vec2::new(3.0, f32::NAN), Bound::PLACE).unwrap_err();
        assert_eq!(error.field, field);
        assert_eq!(source.within(&field, 1.5, Bound::PLACE), Ok(()));
        let lost = source.error_at(&Field::root().key("walls"), "there are no walls");
        assert_eq!(lost.to_string(), "x.ron:1:1: walls: there are no walls");
    }

    #[test]
    fn files_are_read_without_byte_order_mark() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ron");
        fs::write(&path, "\u{feff}(name: \"a\")").unwrap();
        assert_eq!(Source::read(&path).unwrap(), Source::new(&path, "(name: \"a\")"));
    }

    #[test]
    fn files_that_cannot_be_read_are_errors_that_say_why() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("b.ron");
        let message = |path: &Path| Source::read(path).unwrap_err().message;
        assert_eq!(message(&path), "no such file");
        assert_eq!(message(&folder.path().join("none/b.ron")), "no such file");
        for name in ["c.ron", "a.ron", "d.txt"] {
            fs::write(folder.path().join(name), b"(\n \xc3\xa9\xff)").unwrap();
        }
        assert_eq!(message(&path), "no such file; there are: a, c");
        assert!(message(folder.path()).starts_with("cannot be read: "));
        let error = Source::read(folder.path().join("a.ron")).unwrap_err();
        assert!(error.to_string().ends_with("a.ron:2:3: not UTF-8 text from here"));
        assert_eq!(message(Path::new("")), "no such file");
    }

    #[test]
    fn values_nested_too_deeply_are_an_error() {
        let deep = format!("(name: \"\", schemas: {{\"\": {}", "All([".repeat(10_000));
        assert!(parse(&deep).unwrap_err().message.contains("recursion limit"));
    }

    proptest! {
        #[test]
        fn parsing_any_text_is_a_value_or_an_error_of_one_line(
            text in "\\PC*|(\\(name: \"a\",\n)?([\\[\\](){},:\"'\\\\#!r/* \nab0-2é.-]|schemas: |All|Go|spots|numbers){0,40}",
        ) {
            if let Err(error) = parse(&text) {
                prop_assert_eq!(error.to_string().lines().count(), 1);
            }
        }
    }
}
