//! Splits RON text into tokens by structure only: brackets, commas, colons and everything else.
//!
//! Comments, strings, raw strings, characters and `#![..]` attributes are skipped as wholes, so brackets and quotes
//! inside them do not count. Any text is accepted, well-formed or not, and nothing here recurses.

use std::ops::Range;

/// What a token is; the text is taken from its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TokenKind {
    Open(char),
    Close,
    Comma,
    Colon,
    /// An identifier, a number or a sign that means nothing here.
    Word,
    /// A string or a character, plain or raw.
    Quoted,
}

/// A place in a text from which tokens are read.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scanner<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Scanner<'a> {
    /// Starts at the byte `at`, which must be a boundary between characters.
    pub(super) fn new(text: &'a str, at: usize) -> Scanner<'a> {
        Scanner { text, at }
    }

    /// The byte at which the next token starts, or the end of the text.
    pub(super) fn token_start(&mut self) -> usize {
        self.skip_blanks();
        self.at
    }

    /// Reads the next token, or `None` at the end of the text.
    pub(super) fn token(&mut self) -> Option<(TokenKind, Range<usize>)> {
        self.skip_blanks();
        let start = self.at;
        let kind = match self.rest().chars().next()? {
            c @ ('(' | '[' | '{') => self.take(1, TokenKind::Open(c)),
            ')' | ']' | '}' => self.take(1, TokenKind::Close),
            ',' => self.take(1, TokenKind::Comma),
            ':' => self.take(1, TokenKind::Colon),
            '"' => self.string(1),
            '\'' => self.character(1),
            c => self.word(c),
        };
        Some((kind, start..self.at))
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn take(&mut self, bytes: usize, kind: TokenKind) -> TokenKind {
        self.at += bytes;
        kind
    }

    /// Moves behind the first `end` at or after `from` bytes ahead, or to the end of the text.
    fn skip_past(&mut self, from: usize, end: &str) {
        let rest = self.rest();
        self.at += rest[from..].find(end).map_or(rest.len(), |found| from + found + end.len());
    }

    fn skip_blanks(&mut self) {
        loop {
            let rest = self.rest();
            let text =
                rest.trim_start_matches(|c: char| c.is_whitespace() || matches!(c, '\u{200e}' | '\u{200f}'));
            self.at += rest.len() - text.len();
            if text.starts_with("//") {
                self.skip_past(2, "\n");
            } else if text.starts_with("/*") {
                self.skip_block_comment();
            } else if text.starts_with("#![") {
                self.at += 3;
                self.skip_to_close();
            } else {
                return;
            }
        }
    }

    fn skip_block_comment(&mut self) {
        let mut depth = 0_usize;
        while let Some(found) = self.rest().find(['/', '*']) {
            self.at += found;
            if self.rest().starts_with("/*") {
                depth += 1;
                self.at += 2;
            } else if self.rest().starts_with("*/") {
                depth -= 1;
                self.at += 2;
                if depth == 0 {
                    return;
                }
            } else {
                self.at += 1;
            }
        }
        self.at = self.text.len();
    }

    /// Skips an attribute up to its closing bracket. An attribute within an attribute is read as words, not recursed
    /// into.
    fn skip_to_close(&mut self) {
        let mut depth = 1_usize;
        while let Some(c) = self.rest().chars().next() {
            match c {
                '[' | '(' | '{' => depth += 1,
                ']' | ')' | '}' => depth -= 1,
                '"' => {
                    self.string(1);
                    continue;
                }
                _ => {}
            }
            self.at += c.len_utf8();
            if depth == 0 {
                return;
            }
        }
    }

    /// Skips a string whose opening quote ends `open` bytes ahead.
    fn string(&mut self, open: usize) -> TokenKind {
        self.at += open;
        while let Some(found) = self.rest().find(['"', '\\']) {
            self.at += found;
            let escape = self.rest().starts_with('\\');
            self.at += 1;
            if !escape {
                return TokenKind::Quoted;
            }
            self.at += self.rest().chars().next().map_or(0, char::len_utf8);
        }
        self.at = self.text.len();
        TokenKind::Quoted
    }

    /// Skips a character whose opening quote ends `open` bytes ahead; a lone quote is a word of its own.
    fn character(&mut self, open: usize) -> TokenKind {
        let inside = &self.rest()[open..];
        let mut chars = inside.char_indices();
        let first = chars.next();
        let close = match first {
            Some((_, '\\')) => {
                chars.next();
                chars.take_while(|&(_, c)| c != '\n').find(|&(_, c)| c == '\'')
            }
            Some(_) => chars.next().filter(|&(_, c)| c == '\''),
            None => None,
        };
        match close {
            Some((at, _)) => self.take(open + at + 1, TokenKind::Quoted),
            None => self.take(open, TokenKind::Word),
        }
    }

    /// Reads an identifier or number, or what follows the prefixes `r`, `b` and `br`; any other sign alone.
    fn word(&mut self, first: char) -> TokenKind {
        let rest = self.rest();
        let in_word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '+' | '-');
        let length = rest.find(|c| !in_word(c)).unwrap_or(rest.len());
        let (word, after) = rest.split_at(length);
        if word.is_empty() {
            return self.take(first.len_utf8(), TokenKind::Word);
        }
        if word == "b" && after.starts_with('"') {
            return self.string(2);
        }
        if word == "b" && after.starts_with('\'') {
            return self.character(2);
        }
        if word == "r" || word == "br" {
            let hashes = after.len() - after.trim_start_matches('#').len();
            if after[hashes..].starts_with('"') {
                self.skip_past(length + hashes + 1, &format!("\"{}", "#".repeat(hashes)));
                return TokenKind::Quoted;
            }
            if hashes == 1 {
                let name = &after[1..];
                let name_length = name.find(|c| !in_word(c)).unwrap_or(name.len());
                return self.take(length + 1 + name_length, TokenKind::Word);
            }
        }
        self.take(length, TokenKind::Word)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Vec<&str> {
        let mut scanner = Scanner::new(text, 0);
        std::iter::from_fn(|| scanner.token().map(|(_, range)| &text[range])).collect()
    }

    #[test]
    fn brackets_commas_and_colons_are_tokens_of_their_own() {
        assert_eq!(
            tokens("Goalie(x:-1.5e3,[a])"),
            ["Goalie", "(", "x", ":", "-1.5e3", ",", "[", "a", "]", ")"]
        );
    }

    #[test]
    fn comments_and_attributes_are_skipped() {
        assert_eq!(
            tokens("#![enable(implicit_some)]\n// ) \" [\n a /* ( /* ' */ \" */ b // end"),
            ["a", "b"]
        );
        assert_eq!(tokens("#![schema = \"a]b\"] x"), ["x"]);
    }

    #[test]
    fn strings_are_single_tokens_whatever_they_hold() {
        assert_eq!(tokens(r#""a\"(" "//" b"\\" x"#), [r#""a\"(""#, r#""//""#, r#"b"\\""#, "x"]);
        assert_eq!(
            tokens("r\"\\\" r#\"a\"(\"# br##\"\"#\"## r#raw.name"),
            ["r\"\\\"", "r#\"a\"(\"#", "br##\"\"#\"##", "r#raw.name"]
        );
    }

    #[test]
    fn characters_are_single_tokens_and_a_lone_quote_is_a_word() {
        assert_eq!(tokens("'(' '\\'' '\\u{41}' b'\"' ' x"), ["'('", "'\\''", "'\\u{41}'", "b'\"'", "'", "x"]);
    }

    #[test]
    fn what_is_never_closed_reaches_to_the_end() {
        assert_eq!(tokens("a \"b, c)"), ["a", "\"b, c)"]);
        assert_eq!(tokens("a /* b /* */ c"), ["a"]);
        assert_eq!(tokens("a r##\"b\"#"), ["a", "r##\"b\"#"]);
        assert_eq!(tokens("#![enable( a"), Vec::<&str>::new());
    }
}
