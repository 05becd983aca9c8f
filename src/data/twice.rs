//! Finds a name that is given twice in the same brackets of RON text: a field of a struct or a key of a map.
//!
//! A map of serde takes the last of equal keys without a word, so the text is looked through once it has been parsed.

use std::collections::HashMap;

use ron::Value;

use super::field::{Field, Segment};
use super::scan::{Scanner, TokenKind};

/// A name at its second place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Twice {
    /// The byte at which the name starts for the first time.
    pub first: usize,
    /// The byte at which it starts for the second time.
    pub second: usize,
    pub field: Field,
    pub name: String,
}

/// The first name that is given twice in well-formed text.
pub(super) fn given_twice(text: &str) -> Option<Twice> {
    let mut scanner = Scanner::new(text, 0);
    let mut open: Vec<Brackets> = Vec::new();
    let (mut word, mut end) = (None, 0);
    while let Some((kind, range)) = scanner.token() {
        let inside = open.last_mut();
        match (kind, inside) {
            (TokenKind::Open(bracket), _) => {
                let variant = word.take().filter(|_| bracket == '(' && !open.is_empty());
                open.push(Brackets { variant, ..Brackets::new(scanner.token_start()) });
            }
            (TokenKind::Close, _) => {
                open.pop();
            }
            (TokenKind::Comma, Some(inside)) => inside.next(scanner.token_start()),
            (TokenKind::Colon, Some(inside)) if inside.key.is_none() => {
                let name = name(&text[inside.start..end.max(inside.start)]);
                let second = inside.start;
                let first = *inside.names.entry(name.clone()).or_insert(second);
                inside.key = Some(name.clone());
                if first != second {
                    let segments: Vec<Segment> = open.iter().flat_map(Brackets::segments).collect();
                    return Some(Twice { first, second, field: segments.into(), name });
                }
            }
            _ => {}
        }
        word = (kind == TokenKind::Word).then(|| &text[range.clone()]);
        end = range.end;
    }
    None
}

/// Brackets that are open, and where in them the text stands.
struct Brackets<'a> {
    /// The word before them, unless it is that of the whole file.
    variant: Option<&'a str>,
    /// Where each name stands for the first time.
    names: HashMap<String, usize>,
    /// Counts the entries.
    place: usize,
    /// The byte at which the entry starts.
    start: usize,
    /// The entry's key, once it is read.
    key: Option<String>,
}

impl<'a> Brackets<'a> {
    fn new(start: usize) -> Brackets<'a> {
        Brackets { variant: None, names: HashMap::new(), place: 0, start, key: None }
    }

    fn next(&mut self, start: usize) {
        self.place += 1;
        self.start = start;
        self.key = None;
    }

    /// The steps from the brackets to the entry. The first value of a variant is the variant's, and `Some` is none.
    fn segments(&self) -> impl Iterator<Item = Segment> {
        let variant = self.variant.filter(|name| *name != "Some").map(|name| Segment::Key(name.to_owned()));
        let entry = match &self.key {
            Some(key) => Some(Segment::Key(key.clone())),
            None if self.variant.is_some() && self.place == 0 => None,
            None => Some(Segment::Index(self.place)),
        };
        variant.into_iter().chain(entry)
    }
}

/// What a key says, however it is written: `"a"` is `r"a"`, and 7 is 0x7.
pub(super) fn name(written: &str) -> String {
    match ron::from_str(written) {
        Ok(Value::String(text)) => text,
        Ok(Value::Char(sign)) => sign.to_string(),
        Ok(Value::Number(number)) => number.into_f64().to_string(),
        _ => written.strip_prefix("r#").unwrap_or(written).to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The field, and the rest of the line at its second place.
    fn twice(text: &str) -> Option<(String, &str)> {
        given_twice(text).map(|found| {
            assert!(found.first < found.second);
            (found.field.to_string(), text[found.second..].lines().next().unwrap_or_default())
        })
    }

    #[test]
    fn keys_of_maps_and_fields_of_structs_are_compared_within_their_brackets() {
        assert_eq!(twice(r#"Plan(a: (b: 1, c: 2), b: {"a": 1, "b": (a: 1)}, c: [(a: 1), (a: 2)])"#), None);
        assert_eq!(
            twice("(a: {\"x\": 1, // \"x\": 2\n \"y\": \"x: 2\", \"x\": 3})"),
            Some(("a.x".into(), "\"x\": 3})"))
        );
        assert_eq!(twice("(a: 1, b: 2, a : 3)"), Some(("a".into(), "a : 3)")));
    }

    #[test]
    fn the_way_to_a_name_counts_places_and_names_variants() {
        let text = "Plan(all: [Stop, Avoid(by: 1, by: 2)])";
        assert_eq!(twice(text), Some(("all[1].Avoid.by".into(), "by: 2)])")));
        let text = "(all: {7: Some(Ring([(x: 1), (x: 2, x: 3)]))})";
        assert_eq!(twice(text), Some(("all.7.Ring[1].x".into(), "x: 3)]))})")));
        assert_eq!(twice("(a: Go(1, (x: 2, x: 3)))"), Some(("a.Go[1].x".into(), "x: 3)))")));
    }

    #[test]
    fn a_name_is_the_same_however_it_is_written() {
        for (first, second) in [
            ("\"a b\"", "r\"a b\""),
            ("\"ab\"", "\"\\u{61}b\""),
            ("7", "0x7"),
            ("a", "r#a"),
            ("(1, 2)", "(1, 2)"),
        ] {
            let text = format!("{{{first}: 1, {second} : 2}}");
            let found = given_twice(&text).unwrap_or_else(|| panic!("{text}"));
            assert!(text[found.second..].starts_with(second), "{text}");
        }
        assert_eq!(twice(r#"{"a": 1, "A": 2, "a ": 3}"#), None);
    }
}
