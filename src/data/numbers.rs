//! The numbers of a RON text with their paths and places, and texts in which one of them is another: everything around it, comments
//! and layout too, stays as it is to the byte.

use std::ops::Range;

use super::field::{Field, Segment};
use super::scan::{Scanner, TokenKind};

/// A number of a text.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberToken {
    /// Its path: keys, places in lists, and names of variants.
    pub field: Field,
    /// Its bytes.
    pub span: Range<usize>,
    /// What it says.
    pub value: f64,
    /// Whether it is written without a point.
    pub is_whole: bool,
}

/// All numbers of a text, in order.
pub fn numbers(text: &str) -> Vec<NumberToken> {
    let mut scanner = Scanner::new(text, 0);
    let tokens: Vec<(TokenKind, Range<usize>)> = std::iter::from_fn(|| scanner.token()).collect();
    let mut walk = Walk::default();
    let mut found = Vec::new();
    for (place, (kind, span)) in tokens.iter().enumerate() {
        let next = tokens.get(place + 1).map(|(kind, _)| *kind);
        let word = &text[span.clone()];
        match kind {
            TokenKind::Open(_) => walk.open(),
            TokenKind::Close => walk.close(),
            TokenKind::Comma => walk.comma(),
            TokenKind::Colon => {}
            TokenKind::Word | TokenKind::Quoted if next == Some(TokenKind::Colon) => {
                walk.key = Some(unquoted(word))
            }
            TokenKind::Word if matches!(next, Some(TokenKind::Open('('))) => {
                walk.variant = Some(word.to_owned())
            }
            TokenKind::Word => found.extend(number(word).map(|(value, is_whole)| NumberToken {
                field: walk.field(),
                span: span.clone(),
                value,
                is_whole,
            })),
            TokenKind::Quoted => {}
        }
    }
    found
}

/// The text with another value of a number of it.
pub fn with_number(text: &str, number: &NumberToken, value: f64) -> String {
    let written = if number.is_whole && value.fract() == 0.0 { format!("{value:.0}") } else { plain(value) };
    [&text[..number.span.start], &written, &text[number.span.end..]].concat()
}

/// As people write it: with a point, and no more digits than an `f32` has.
fn plain(value: f64) -> String {
    format!("{:?}", value as f32)
}

fn number(word: &str) -> Option<(f64, bool)> {
    let is_number = word.trim_start_matches(['-', '+', '.']).starts_with(|c: char| c.is_ascii_digit());
    let value = word.replace('_', "").parse().ok().filter(|_| is_number)?;
    Some((value, !word.contains(['.', 'e', 'E'])))
}

fn unquoted(key: &str) -> String {
    key.trim_matches('"').to_owned()
}

/// Where in the text a walk from its beginning stands.
#[derive(Default)]
struct Walk {
    path: Vec<OpenBracket>,
    key: Option<String>,
    variant: Option<String>,
    index: usize,
}

/// A pair of brackets that is open, and what stood before it.
struct OpenBracket {
    steps: Vec<Segment>,
    index: usize,
}

impl Walk {
    /// What leads to the value that comes next, from the innermost open bracket.
    fn steps(&self) -> Vec<Segment> {
        let place = match &self.key {
            Some(key) => Segment::Key(key.clone()),
            None => Segment::Index(self.index),
        };
        let place = Some(place).filter(|_| !self.path.is_empty());
        place.into_iter().chain(self.variant.clone().map(Segment::Key)).collect()
    }

    fn open(&mut self) {
        let level = OpenBracket { steps: self.steps(), index: self.index };
        self.path.push(level);
        (self.key, self.variant, self.index) = (None, None, 0);
    }

    fn close(&mut self) {
        self.index = self.path.pop().map_or(0, |level| level.index);
        (self.key, self.variant) = (None, None);
    }

    fn comma(&mut self) {
        self.index += 1;
        (self.key, self.variant) = (None, None);
    }

    fn field(&self) -> Field {
        let mut segments: Vec<Segment> = self.path.iter().flat_map(|level| level.steps.clone()).collect();
        segments.extend(self.steps());
        Field::from(segments)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::data::{AssetFolder, AssetKind, locate};

    const TEXT: &str = r#"(
        // 5 is no number here, and neither is "6".
        name: "7", weights: [1, 2.5 /* 9 */, -3e-1],
        schemas: { "to ball": Go(speed: 0.85, at: (1.0, -2)), other: Stay },
        maybe: Some(4), x2: 1_000,
    )"#;

    #[test]
    fn numbers_are_told_with_their_paths() {
        let told: Vec<(String, f64)> =
            numbers(TEXT).into_iter().map(|number| (number.field.to_string(), number.value)).collect();
        let expected = [
            ("weights[0]", 1.0),
            ("weights[1]", 2.5),
            ("weights[2]", -0.3),
            ("schemas[\"to ball\"].Go.speed", 0.85),
            ("schemas[\"to ball\"].Go.at[0]", 1.0),
            ("schemas[\"to ball\"].Go.at[1]", -2.0),
            ("maybe.Some[0]", 4.0),
            ("x2", 1000.0),
        ];
        assert_eq!(told, expected.map(|(field, value)| (field.to_owned(), value)));
    }

    #[test]
    fn a_number_is_another_and_all_around_it_stays() {
        let all = numbers(TEXT);
        let changed = with_number(TEXT, &all[3], 0.9);
        assert_eq!(changed, TEXT.replace("0.85", "0.9"));
        assert_eq!(with_number(TEXT, &all[0], 12.0), TEXT.replace("[1,", "[12,"));
        assert_eq!(with_number(TEXT, &all[0], 1.5), TEXT.replace("[1,", "[1.5,"));
        assert_eq!(with_number(TEXT, &all[4], 3.0), TEXT.replace("(1.0,", "(3.0,"));
    }

    #[test]
    fn the_paths_of_shipped_strategies_lead_to_their_numbers() {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        for path in assets.files(AssetKind::Strategy).unwrap() {
            let text = assets.read(&path).unwrap().text;
            let all = numbers(&text);
            assert!(!all.is_empty() || text.contains("based_on"), "{}", path.display());
            for number in all {
                let (line, column) = locate(&text, number.field.segments()).unwrap();
                let before = &text[..number.span.start];
                let (at, start) =
                    (before.matches('\n').count() + 1, before.rfind('\n').map_or(0, |at| at + 1));
                let there = (at, before[start..].chars().count() + 1);
                assert_eq!((line, column), there, "{}: {}", path.display(), number.field);
            }
        }
    }

    proptest! {
        #[test]
        fn any_text_is_walked_and_a_number_that_is_set_is_read_back(text in "[()\\[\\]{}a-c:,0-9. \"/*\n-]{0,60}", value in -1e3f32..1e3) {
            for number in numbers(&text) {
                let changed = with_number(&text, &number, f64::from(value));
                let again = numbers(&changed).into_iter().find(|again| again.span.start == number.span.start);
                prop_assert_eq!(again.map(|again| again.value as f32), Some(value));
            }
        }
    }
}
