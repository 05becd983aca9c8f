//! The path of a value inside a file, such as `machines.goalie.states.search.on[0].go`.
//!
//! Fields of structs, keys of maps and names of enum variants are keys; places in lists and tuples are indices.

use std::fmt;

/// One step of a [`Field`].
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Segment {
    /// A struct's field, a map's key or an enum's variant.
    Key(String),
    /// A place in a list or tuple, counted from 0.
    Index(usize),
}

/// A path of [`Segment`]s from the value of the whole file, which is the empty path, inwards.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Field {
    segments: Vec<Segment>,
}

impl Field {
    /// The value of the whole file.
    pub const fn root() -> Field {
        Field { segments: Vec::new() }
    }

    /// The field, map entry or variant `key` of this value.
    #[must_use]
    pub fn key(&self, key: impl Into<String>) -> Field {
        self.with(Segment::Key(key.into()))
    }

    /// The element `index`, counted from 0, of this list or tuple.
    #[must_use]
    pub fn index(&self, index: usize) -> Field {
        self.with(Segment::Index(index))
    }

    /// The value that a path such as `a.b.2` leads to from here: the third in the list `b` of `a`.
    #[must_use]
    pub fn dotted(&self, path: &str) -> Field {
        path.split('.').fold(self.clone(), |field, step| match step.parse() {
            Ok(index) => field.index(index),
            Err(_) => field.key(step),
        })
    }

    /// Whether this is the value of the whole file.
    pub fn is_root(&self) -> bool {
        self.segments.is_empty()
    }

    /// The steps from the outside inwards.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// The value that these steps lead to from here.
    #[must_use]
    pub fn inside(&self, steps: &[Segment]) -> Field {
        Field { segments: [&self.segments, steps].concat() }
    }

    fn with(&self, segment: Segment) -> Field {
        self.inside(&[segment])
    }

    /// This path without its last step if that is the key `key`; ron counts a bad variant name as a step.
    pub(super) fn without_last_key(mut self, key: &str) -> Field {
        if matches!(self.segments.last(), Some(Segment::Key(last)) if last == key) {
            self.segments.pop();
        }
        self
    }
}

impl From<Vec<Segment>> for Field {
    fn from(segments: Vec<Segment>) -> Field {
        Field { segments }
    }
}

/// A step that serde could not name is dropped at the end of the path, where it is a key not yet read, and shown as `?`
/// elsewhere, where it is the key of a map that is neither text nor a number.
impl From<&serde_path_to_error::Path> for Field {
    fn from(path: &serde_path_to_error::Path) -> Field {
        use serde_path_to_error::Segment as Theirs;
        let mut theirs: Vec<&Theirs> = path.iter().collect();
        while matches!(theirs.last(), Some(Theirs::Unknown)) {
            theirs.pop();
        }
        let segments = theirs.into_iter().map(|segment| match segment {
            Theirs::Seq { index } => Segment::Index(*index),
            Theirs::Map { key } | Theirs::Enum { variant: key } => Segment::Key(key.clone()),
            Theirs::Unknown => Segment::Key("?".to_owned()),
        });
        Field { segments: segments.collect() }
    }
}

/// Keys are joined with dots; a key that is not a plain word stands in brackets and quotes.
impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, segment) in self.segments.iter().enumerate() {
            match segment {
                Segment::Index(index) => write!(f, "[{index}]")?,
                Segment::Key(key) if !is_plain(key) => write!(f, "[{key:?}]")?,
                Segment::Key(key) if i == 0 => f.write_str(key)?,
                Segment::Key(key) => write!(f, ".{key}")?,
            }
        }
        Ok(())
    }
}

fn is_plain(key: &str) -> bool {
    !key.is_empty() && key.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '+' | '?'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_joined_with_dots_and_indices_stand_in_brackets() {
        let field = Field::root().key("spots").index(3).key("x").index(0).index(1);
        assert_eq!(field.to_string(), "spots[3].x[0][1]");
    }

    #[test]
    fn a_dotted_path_leads_through_structs_and_lists() {
        let field = Field::root().key("home").dotted("players.2.at.0");
        assert_eq!(field.to_string(), "home.players[2].at[0]");
    }

    #[test]
    fn the_root_shows_as_nothing() {
        assert_eq!(Field::root().to_string(), "");
        assert!(Field::default().is_root());
    }

    #[test]
    fn keys_that_are_no_words_are_quoted() {
        let field = Field::root().key("roles").key("left \"back\"\n").key("a.b").key("x");
        assert_eq!(field.to_string(), r#"roles["left \"back\"\n"]["a.b"].x"#);
    }

    #[test]
    fn building_on_a_field_leaves_it_as_it_was() {
        let state = Field::root().key("state");
        assert_eq!(state.key("on").to_string(), "state.on");
        assert_eq!(state.key("run").to_string(), "state.run");
        assert_eq!(state.segments(), [Segment::Key("state".to_owned())]);
    }

    #[test]
    fn only_the_named_last_key_is_dropped() {
        let field = Field::root().key("a").key("b");
        assert_eq!(field.clone().without_last_key("b").to_string(), "a");
        assert_eq!(field.without_last_key("a").to_string(), "a.b");
    }
}
