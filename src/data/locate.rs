//! Finds the line and column of a value in RON text from its path, without knowing its type.
//!
//! Types decide what a path means in RON: `Some(..)`, newtypes and variants add brackets that a path may or may not
//! count. So every reading is tried, the strictest first, and the first that follows the whole path wins; if none does,
//! the deepest place reached is the answer, since that is where something is missing.

use std::collections::HashSet;

use super::field::Segment;
use super::scan::{Scanner, TokenKind};

/// The line and column, both counted from 1 and in characters, of the value at `path`, or of the deepest value on the
/// way to it. `None` if the text holds no value at all.
pub fn locate(text: &str, path: &[Segment]) -> Option<(usize, usize)> {
    find(text, path).map(|found| line_and_column(text, found.offset))
}

/// Where a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Found {
    /// The byte at which the value starts.
    pub offset: usize,
    /// Whether the whole path was followed.
    pub exact: bool,
}

/// Like [`locate`], with the place in bytes.
pub(super) fn find(text: &str, path: &[Segment]) -> Option<Found> {
    let root = Scanner::new(text, 0).token_start();
    if root == text.len() {
        return None;
    }
    let start = Reading { offset: root, followed: 0, in_variant: false };
    let mut best = start;
    let mut seen = HashSet::from([start]);
    let mut open = vec![start];
    while let Some(reading) = open.pop() {
        if reading.followed > best.followed {
            best = reading;
        }
        let Some(segment) = path.get(reading.followed) else {
            break;
        };
        for next in reading.steps(text, segment).into_iter().rev() {
            if seen.insert(next) {
                open.push(next);
            }
        }
    }
    Some(Found { offset: best.offset, exact: best.followed == path.len() })
}

/// The bracket that the value of the whole text opens with, if any, and the keys in it, without looking any deeper.
pub(super) fn outermost(text: &str) -> Option<(Option<char>, Vec<&str>)> {
    let root = Scanner::new(text, 0).token_start();
    let value = (root < text.len()).then(|| Value::read(text, root))?;
    let keys = value.entries.into_iter().filter_map(|entry| entry.key);
    Some((value.bracket, keys.map(without_raw_prefix).collect()))
}

/// The line and column, both counted from 1 and in characters, of a byte of the text.
pub(super) fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = &text[..offset];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

/// One way of following the path so far.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Reading {
    /// The byte at which the value starts.
    offset: usize,
    /// How many segments lead here.
    followed: usize,
    /// Whether the last segment was the variant's name, so that the name is not a step any more.
    in_variant: bool,
}

impl Reading {
    /// Where `segment` may lead from here, the most likely first.
    fn steps(self, text: &str, segment: &Segment) -> Vec<Reading> {
        let value = Value::read(text, self.offset);
        let to = |offset| Reading { offset, followed: self.followed + 1, in_variant: false };
        let into_variant = Reading { in_variant: true, ..to(self.offset) };
        let mut steps: Vec<Reading> = value.entry(segment).map(to).into_iter().collect();
        let wrapped = value.wrapped();
        if !self.in_variant {
            match segment {
                Segment::Key(key) if value.name == Some(key) => {
                    steps.extend(wrapped.map(to));
                    steps.push(into_variant);
                }
                Segment::Index(0) if value.bracket == Some('(') => steps.push(into_variant),
                _ => {}
            }
        }
        steps.extend(wrapped.map(|offset| Reading { offset, in_variant: false, ..self }));
        steps
    }
}

/// The outside of a value: its name, if any, and what its brackets hold.
#[derive(Debug)]
struct Value<'a> {
    name: Option<&'a str>,
    bracket: Option<char>,
    entries: Vec<ValueEntry<'a>>,
}

/// One thing in brackets: an element, or a key with its value.
#[derive(Debug)]
struct ValueEntry<'a> {
    key: Option<&'a str>,
    offset: usize,
}

impl<'a> Value<'a> {
    fn read(text: &'a str, offset: usize) -> Value<'a> {
        let mut scanner = Scanner::new(text, offset);
        let mut token = scanner.token();
        let mut name = None;
        if let Some((TokenKind::Word, range)) = token {
            name = Some(without_raw_prefix(&text[range]));
            token = scanner.token().filter(|(kind, _)| *kind == TokenKind::Open('('));
        }
        match token {
            Some((TokenKind::Open(bracket), _)) => {
                Value { name, bracket: Some(bracket), entries: read_entries(text, scanner) }
            }
            _ => Value { name, bracket: None, entries: Vec::new() },
        }
    }

    /// The place of the entry that `segment` names.
    fn entry(&self, segment: &Segment) -> Option<usize> {
        let entry = match segment {
            Segment::Key(key) => self.entries.iter().find(|entry| entry.has_key(key)),
            Segment::Index(index) => match self.entries.first()?.key {
                None => self.entries.get(*index),
                Some(_) => self.entries.iter().find(|entry| entry.has_key(&index.to_string())),
            },
        };
        entry.map(|entry| entry.offset)
    }

    /// The place of the only thing in round brackets, which are then perhaps no more than a wrapper.
    fn wrapped(&self) -> Option<usize> {
        match &self.entries[..] {
            [ValueEntry { key: None, offset }] if self.bracket == Some('(') => Some(*offset),
            _ => None,
        }
    }
}

impl ValueEntry<'_> {
    fn has_key(&self, key: &str) -> bool {
        self.key.is_some_and(|written| {
            if written.starts_with('"') || written.starts_with("r\"") || written.starts_with("r#") {
                without_raw_prefix(written) == key
                    || ron::from_str::<String>(written).is_ok_and(|text| text == key)
            } else {
                written.trim_matches('\'') == key
            }
        })
    }
}

fn without_raw_prefix(name: &str) -> &str {
    name.strip_prefix("r#").unwrap_or(name)
}

/// The entries up to the bracket that closes them; the scanner stands behind the opening one.
fn read_entries<'a>(text: &'a str, mut scanner: Scanner<'a>) -> Vec<ValueEntry<'a>> {
    let mut entries = Vec::new();
    loop {
        let start = scanner.token_start();
        let mut entry = ValueEntry { key: None, offset: start };
        let mut end = start;
        let mut depth = 0_usize;
        let last = loop {
            match scanner.token() {
                None => break true,
                Some((TokenKind::Close, _)) if depth == 0 => break true,
                Some((TokenKind::Comma, _)) if depth == 0 => break false,
                Some((TokenKind::Colon, _)) if depth == 0 && entry.key.is_none() => {
                    entry = ValueEntry { key: Some(&text[start..end]), offset: scanner.token_start() };
                }
                Some((kind, range)) => {
                    match kind {
                        TokenKind::Open(_) => depth += 1,
                        TokenKind::Close => depth -= 1,
                        _ => {}
                    }
                    end = range.end;
                }
            }
        };
        if end > start || !last {
            entries.push(entry);
        }
        if last {
            return entries;
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// A path from words and numbers: "goal on 0" is goal.on[0].
    fn path(words: &str) -> Vec<Segment> {
        words
            .split_whitespace()
            .map(|word| word.parse().map_or_else(|_| Segment::Key(word.to_owned()), Segment::Index))
            .collect()
    }

    /// The rest of the line at the value found, with a `!` in front if only a part of the path was followed.
    fn at<'a>(text: &'a str, words: &str) -> (&'a str, bool) {
        let found = find(text, &path(words)).expect("a value");
        (text[found.offset..].lines().next().unwrap_or(""), found.exact)
    }

    const STRATEGY: &str = r##"#![enable(implicit_some)]
// A strategy: ( [ { " '
Strategy(
    name: "Hammer, (heads)", /* nested /* ) */ " */
    note: r#"a "quoted" ) bracket"#,
    mark: ')',
    machines: {
        "goalie": (states: {"search": (on: [(seen, "track"), (lost, "search")])}),
        half-back /* : */ : Some((start: Move(speed: 1.5))), "left \"wing\"": [[1, 2], [3, 4]],
    },
    schemas: [Avoid((radius: 0.5)), Go(1.0, 2.0), Stop, Ring([7, 8]), Wrap(Inner(gain: 3.0))],
    teams: {Home: 1, 7: 2, 'x': 3},
)"##;

    #[test]
    fn fields_of_structs_and_entries_of_maps_are_found() {
        assert_eq!(at(STRATEGY, "name"), ("\"Hammer, (heads)\", /* nested /* ) */ \" */", true));
        assert_eq!(at(STRATEGY, "mark"), ("')',", true));
        let (rest, exact) = at(STRATEGY, "machines goalie states search on 1 0");
        assert!(rest.starts_with("lost") && exact);
        let wing = [Segment::Key("machines".into()), Segment::Key("left \"wing\"".into()), Segment::Index(1)];
        assert!(STRATEGY[find(STRATEGY, &wing).unwrap().offset..].starts_with("[3, 4]"));
    }

    #[test]
    fn keys_that_are_no_strings_are_matched_as_written() {
        assert!(at(STRATEGY, "teams Home").0.starts_with("1,"));
        assert!(at(STRATEGY, "teams 7").0.starts_with("2,"));
        assert!(at(STRATEGY, "teams x").0.starts_with("3}"));
        assert!(at("(r#type: 1, b: 2)", "type").0.starts_with("1,"));
    }

    #[test]
    fn wrappers_may_be_named_counted_or_left_out() {
        for words in [
            "schemas 0 Avoid radius",
            "schemas 0 0 radius",
            "schemas 0 radius",
            "Strategy schemas 0 Avoid 0 radius",
        ] {
            assert_eq!(
                at(STRATEGY, words),
                ("0.5)), Go(1.0, 2.0), Stop, Ring([7, 8]), Wrap(Inner(gain: 3.0))],", true)
            );
        }
        for words in ["start speed", "Some start Move speed", "0 start 0 speed"] {
            assert!(at(STRATEGY, &format!("machines half-back {words}")).0.starts_with("1.5"));
        }
        assert!(at(STRATEGY, "schemas 1 Go 1").0.starts_with("2.0"));
        assert!(at(STRATEGY, "schemas 2 Stop").0.starts_with("Stop"));
        assert!(at(STRATEGY, "schemas 4 gain").0.starts_with("3.0"));
    }

    #[test]
    fn an_index_behind_a_variant_of_one_value_counts_in_that_value() {
        for words in ["schemas 3 Ring 1", "schemas 3 1", "schemas 3 Ring 0 1"] {
            assert!(at(STRATEGY, words).0.starts_with("8]"), "{words}");
        }
    }

    #[test]
    fn a_path_that_leads_nowhere_ends_at_the_deepest_value_found() {
        let (rest, exact) = at(STRATEGY, "machines goalie states trak on");
        assert!(rest.starts_with("{\"search\"") && !exact);
        assert_eq!(locate(STRATEGY, &path("nothing 3")), Some((3, 1)));
        assert_eq!(locate(STRATEGY, &path("teams Away x")), Some((12, 12)));
    }

    #[test]
    fn columns_count_characters() {
        assert_eq!(locate("(a: \"größer\", b: 1)", &path("b")), Some((1, 18)));
        assert_eq!(locate("(\r\n\ta: 1)", &path("a")), Some((2, 5)));
    }

    #[test]
    fn text_without_a_value_has_no_place() {
        assert_eq!(locate("", &path("a")), None);
        assert_eq!(locate(" // only a comment", &[]), None);
        assert_eq!(locate("#![enable(implicit_some)]\n", &[]), None);
    }

    #[test]
    fn deep_brackets_neither_overflow_the_stack_nor_multiply_the_search() {
        let text = format!("{}1{}", "(".repeat(300), ")".repeat(300));
        let mut words = vec![Segment::Index(0); 40];
        words.push(Segment::Key("x".to_owned()));
        assert!(!find(&text, &words).unwrap().exact);
        assert!(locate(&"[".repeat(200_000), &path("0 0 0")).is_some());
    }

    fn any_path() -> impl Strategy<Value = Vec<Segment>> {
        let segment = prop_oneof![
            "[a-c]{1,2}|\\PC*".prop_map(Segment::Key),
            prop_oneof![0_usize..4, any::<usize>()].prop_map(Segment::Index)
        ];
        prop::collection::vec(segment, 0..6)
    }

    proptest! {
        #[test]
        fn any_path_in_any_text_has_a_place_within_it(text in any::<String>(), path in any_path()) {
            let lines = text.matches('\n').count() + 1;
            prop_assert!(locate(&text, &path).is_none_or(|(line, column)| line <= lines && column >= 1));
        }

        #[test]
        fn any_path_in_text_that_looks_like_ron_has_a_place(
            text in "([\\[\\](){},:\"'\\\\#!r/* \nab0-2é]|r#\"|\"#|#!\\[|/\\*|\\*/|//|b'|br|Some\\(){0,60}",
            path in any_path(),
        ) {
            let found = find(&text, &path);
            prop_assert!(found.is_none_or(|found| text.is_char_boundary(found.offset)));
        }
    }
}
