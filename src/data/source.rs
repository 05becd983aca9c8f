//! The text of one file: read, parsed into a serde type, and kept so that later errors can point into it.
//!
//! Files may leave out `Some(..)`, the name of a newtype and the second pair of brackets of a variant that holds a
//! struct or a tuple: `Avoid(radius: 0.5)`. The errors of ron are put into the words and the form of [`DataError`].

use std::fmt::Display;
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

use bevy::math::Vec2;
use ron::error::{Error as RonError, SpannedError};
use ron::extensions::Extensions;
use serde::de::DeserializeOwned;

use super::bounds::Bound;
use super::error::DataError;
use super::fault::{Fault, Validate};
use super::field::{Field, Segment};
use super::listing::names_in;
use super::locate::{find, line_and_column, locate, outermost};
use super::twice::{given_twice, name};
use super::words::in_words;

/// How Touchline reads RON. What is written with other options, those of `ron::to_string` for one, may not read back.
pub fn ron_options() -> ron::Options {
    ron::Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME)
        .with_default_extension(Extensions::UNWRAP_NEWTYPES)
        .with_default_extension(Extensions::UNWRAP_VARIANT_NEWTYPES)
}

/// What a text is at its outside, whether or not it is sound inside.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TopLevel<'a> {
    /// With the names of its fields.
    Struct(Vec<&'a str>),
    /// With its keys.
    Map(Vec<String>),
    /// A list, a word or a number.
    Other,
}

/// A file and its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// Where the file is.
    pub path: PathBuf,
    /// What is in it.
    pub text: String,
    layer: Option<Layer>,
}

/// A part of a text that is laid over the rest.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Layer {
    at: Field,
    /// Lists of the whole that go on in the part, and how many entries the whole has of each.
    continued: Vec<(&'static str, usize)>,
}

impl Source {
    /// A text that is already at hand; `path` only names it.
    pub fn new(path: impl Into<PathBuf>, text: impl Into<String>) -> Source {
        Source { path: path.into(), text: text.into(), layer: None }
    }

    /// The same text with the part of it that stands at `at` laid over the rest: later errors about a field point into the
    /// part if the field is given there. Of the lists `continued` the whole has so many entries, and the part has the
    /// others.
    #[must_use]
    pub fn overlaid(&self, at: Field, continued: Vec<(&'static str, usize)>) -> Source {
        Source { layer: Some(Layer { at, continued }), ..self.clone() }
    }

    /// Reads a file, without the byte order mark that some editors write.
    ///
    /// # Errors
    ///
    /// If the file is missing (the error then lists its siblings), cannot be read, is far too long or is not UTF-8.
    pub fn read(path: impl AsRef<Path>) -> Result<Source, DataError> {
        let path = path.as_ref();
        let bytes = contents(path).map_err(|error| match error.kind() {
            ErrorKind::NotFound => DataError::new(path, missing(path)),
            ErrorKind::IsADirectory => DataError::new(path, "is a folder, not a file"),
            _ => DataError::new(path, format!("cannot be read: {error}")),
        })?;
        if bytes.len() > MAX_BYTES {
            return Err(DataError::new(path, format!("is longer than {} MB", MAX_BYTES >> 20)));
        }
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
    /// If the text is not RON, does not fit the type, gives a name twice or goes on after the value.
    pub fn parse<T: DeserializeOwned>(&self) -> Result<T, DataError> {
        let mut ron = ron::Deserializer::from_str_with_options(&self.text, &ron_options())
            .map_err(|error| self.explain(error, Field::root()))?;
        let value = serde_path_to_error::deserialize(&mut ron).map_err(|error| {
            let field = Field::from(error.path());
            self.explain(ron.span_error(error.into_inner()), field)
        })?;
        ron.end().map_err(|error| self.explain(ron.span_error(error), Field::root()))?;
        match given_twice(&self.text) {
            None => Ok(value),
            Some(twice) => {
                let (line, _) = line_and_column(&self.text, twice.first);
                let message = format!("`{}` is given twice, first in line {line}", twice.name);
                let place = line_and_column(&self.text, twice.second);
                Err(DataError::new(&self.path, message).at(place).about(twice.field))
            }
        }
    }

    /// Whether the names in a list are distinct.
    ///
    /// # Errors
    ///
    /// The first one that is there before.
    pub fn distinct<T: PartialEq + Display>(&self, list: &Field, names: &[T]) -> Result<(), DataError> {
        match names.iter().enumerate().find(|(place, name)| names[..*place].contains(name)) {
            Some((place, name)) => Err(self.error_at(&list.index(place), format!("`{name}` is given twice"))),
            None => Ok(()),
        }
    }

    /// What the text is at its outside.
    ///
    /// # Errors
    ///
    /// If there is nothing in it.
    pub fn top_level(&self) -> Result<TopLevel<'_>, DataError> {
        match outermost(&self.text) {
            Some((Some('('), fields)) => Ok(TopLevel::Struct(fields)),
            Some((Some('{'), keys)) => Ok(TopLevel::Map(keys.into_iter().map(name).collect())),
            Some(_) => Ok(TopLevel::Other),
            None => Err(DataError::new(&self.path, EMPTY)),
        }
    }

    /// An error about a field of the parsed value, at the place of its value or of the deepest value around it.
    pub fn error_at(&self, field: &Field, message: impl Into<String>) -> DataError {
        let field = &self.written(field);
        let error = DataError::new(&self.path, message).about(field.clone());
        match locate(&self.text, field.segments()) {
            Some(place) => error.at(place),
            None => error,
        }
    }

    /// Where a field is written: in the part that is laid over the rest if it is given there.
    fn written(&self, field: &Field) -> Field {
        let Some(Layer { at, continued }) = &self.layer else { return field.clone() };
        if let [Segment::Key(list), Segment::Index(place), inside @ ..] = field.segments()
            && let Some((_, count)) = continued.iter().find(|(name, _)| name == list)
        {
            let Some(place) = place.checked_sub(*count) else { return field.clone() };
            return at.key(list).index(place).inside(inside);
        }
        let written = at.inside(field.segments());
        let is_given = find(&self.text, written.segments()).is_some_and(|found| found.exact);
        if is_given { written } else { field.clone() }
    }

    /// A value that has to be given as `field` of what stands at `at`.
    ///
    /// # Errors
    ///
    /// If it is not given.
    pub fn required<T: Clone>(&self, value: &Option<T>, at: &Field, field: &str) -> Result<T, DataError> {
        let missing = || self.error_at(at, format!("the field `{field}` is missing"));
        value.clone().ok_or_else(missing)
    }

    /// What a check of the value at `at` came to, as an error that says where in the file the fault is.
    ///
    /// # Errors
    ///
    /// If there is a fault.
    pub fn locate(&self, at: &Field, checked: Result<(), Fault>) -> Result<(), DataError> {
        checked.map_err(|fault| {
            let fault = fault.inside(at);
            self.error_at(&fault.field, fault.message)
        })
    }

    /// Parses the whole text as one value that is sound.
    ///
    /// # Errors
    ///
    /// As [`Source::parse`], or the first fault of the value.
    pub fn parse_sound<T: DeserializeOwned + Validate>(&self) -> Result<T, DataError> {
        let value: T = self.parse()?;
        self.locate(&Field::root(), value.validate())?;
        Ok(value)
    }

    /// Checks a number of the parsed value.
    ///
    /// # Errors
    ///
    /// If it is out of its bound.
    pub fn within(&self, field: &Field, number: f32, bound: Bound) -> Result<(), DataError> {
        self.locate(field, bound.check("", number))
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
            return DataError::new(&self.path, EMPTY);
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

const EMPTY: &str = "the file is empty";

/// No file that people write is nearly as long.
const MAX_BYTES: usize = 4 << 20;

/// What a file holds; no more than a byte too much of one that is too long.
pub fn contents(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
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
mod tests;
