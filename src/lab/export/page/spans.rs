//! What holds for a time: from the tick in which it is first seen until it is no longer.

/// Something that holds, or has held.
#[derive(Clone, Debug)]
pub struct SpanWriter<T> {
    open: Option<(u64, T)>,
    closed: Vec<(u64, u64, T)>,
}

impl<T> Default for SpanWriter<T> {
    fn default() -> SpanWriter<T> {
        SpanWriter { open: None, closed: Vec::new() }
    }
}

impl<T: PartialEq> SpanWriter<T> {
    /// What holds in a tick.
    pub fn note(&mut self, tick: u64, what: Option<T>) {
        if self.open.as_ref().map(|(_, what)| what) == what.as_ref() {
            return;
        }
        if let Some((from, before)) = self.open.take() {
            self.closed.push((from, tick, before));
        }
        self.open = what.map(|what| (tick, what));
    }

    /// All spans; one that is not over ends in this tick.
    pub fn finish(mut self, tick: u64) -> Vec<(u64, u64, T)> {
        self.note(tick, None);
        self.closed
    }
}

/// Words by number, each once.
#[derive(Clone, Debug, Default)]
pub struct WordList {
    numbers: std::collections::BTreeMap<String, usize>,
}

impl WordList {
    /// The number of a word.
    pub fn number(&mut self, word: &str) -> usize {
        if let Some(number) = self.numbers.get(word) {
            return *number;
        }
        let number = self.numbers.len();
        self.numbers.insert(word.to_owned(), number);
        number
    }

    /// All words in the order of their numbers.
    pub fn finish(self) -> Vec<String> {
        let mut words: Vec<(usize, String)> =
            self.numbers.into_iter().map(|(word, number)| (number, word)).collect();
        words.sort_unstable();
        words.into_iter().map(|(_, word)| word).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_ends_where_something_else_begins() {
        let mut spans = SpanWriter::default();
        for (tick, what) in [None, Some('a'), Some('a'), Some('b'), None, Some('b')].into_iter().enumerate() {
            spans.note(tick as u64, what);
        }
        assert_eq!(spans.finish(9), [(1, 3, 'a'), (3, 4, 'b'), (5, 9, 'b')]);
    }

    #[test]
    fn a_word_keeps_its_number() {
        let mut words = WordList::default();
        let numbers = ["b", "a", "b", ""].map(|word| words.number(word));
        assert_eq!(numbers, [0, 1, 0, 2]);
        assert_eq!(words.finish(), ["b", "a", ""]);
    }
}
