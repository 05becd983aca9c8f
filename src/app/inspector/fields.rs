//! The fields of a value, read from its text: any state of a match is told in the layout of Rust's `{:#?}`, whatever types it is
//! made of.

use bevy_egui::egui::{self, RichText};

/// A field of a structure, an entry of a map or an item of a list.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ToldField {
    /// Its name or its key; empty for an item.
    pub name: String,
    /// The value, or the type of one that has parts.
    pub value: String,
    /// What is in it.
    pub parts: Vec<ToldField>,
}

/// Items that take no more room than this are told in one line, in characters.
const ONE_LINE: usize = 48;
/// A field with no more parts than this, and those in them, is open at first.
const SHORT: usize = 24;

impl ToldField {
    /// The value that a text tells of.
    pub fn of(text: &str) -> ToldField {
        let mut open = vec![ToldField::default()];
        for line in text.lines().map(str::trim) {
            let mut rest = line.strip_suffix(',').unwrap_or(line);
            let mut key = None;
            let bracket = rest.chars().next().filter(|first| open.len() > 1 && "})]".contains(*first));
            if let Some(bracket) = bracket {
                let closed = closed(&mut open, bracket);
                rest = &rest[1..];
                match rest.strip_prefix(": ") {
                    Some(value) => (key, rest) = (Some(closed.in_one_line()), value),
                    None => attach(&mut open, closed),
                }
            }
            let (own, value) = named(rest);
            let name = key.unwrap_or_else(|| own.to_owned());
            match value.strip_suffix(['{', '(', '[']) {
                Some(kind) => {
                    let value = kind.trim_end().to_owned();
                    open.push(ToldField { name, value, parts: Vec::new() });
                }
                None if rest.is_empty() => {}
                None => attach(&mut open, ToldField { name, value: value.to_owned(), parts: Vec::new() }),
            }
        }
        while open.len() > 1 {
            let cut_off = closed(&mut open, '}');
            attach(&mut open, cut_off);
        }
        let mut whole = open.pop().unwrap_or_default();
        if whole.parts.len() == 1 { whole.parts.remove(0) } else { whole }
    }

    /// A structure as it stands in a key.
    fn in_one_line(&self) -> String {
        if self.parts.is_empty() {
            return self.value.clone();
        }
        let part = |part: &ToldField| match part.name.as_str() {
            "" => part.in_one_line(),
            name => format!("{name} {}", part.in_one_line()),
        };
        self.parts.iter().map(part).collect::<Vec<_>>().join(", ")
    }

    fn size(&self) -> usize {
        self.parts.iter().map(|part| 1 + part.size()).sum()
    }

    /// Shows what is in it, line by line; what is long is closed at first.
    pub fn show(&self, ui: &mut egui::Ui) {
        if self.parts.is_empty() {
            ui.monospace(&self.value);
        }
        for (place, part) in self.parts.iter().enumerate() {
            ui.push_id(place, |ui| part.show_line(ui));
        }
    }

    fn show_line(&self, ui: &mut egui::Ui) {
        if !self.parts.is_empty() {
            let gap = if self.name.is_empty() { "" } else { "  " };
            let mut title = egui::text::LayoutJob::default();
            for text in [RichText::new(format!("{}{gap}", self.name)), RichText::new(&self.value).weak()] {
                text.append_to(&mut title, ui.style(), egui::FontSelection::Default, egui::Align::Center);
            }
            let header = egui::CollapsingHeader::new(title).id_salt("parts");
            header.default_open(self.size() <= SHORT).show(ui, |ui| self.show(ui));
            return;
        }
        ui.horizontal(|ui| {
            if !self.name.is_empty() {
                ui.weak(&self.name);
            }
            ui.monospace(&self.value);
        });
    }
}

fn attach(open: &mut [ToldField], part: ToldField) {
    if let Some(whole) = open.last_mut() {
        whole.parts.push(part);
    }
}

/// Takes the last of the open fields, now that its bracket is closed. A wrapping of one structure is told with its type, short items
/// in one line, and of a long list how many they are.
fn closed(open: &mut Vec<ToldField>, bracket: char) -> ToldField {
    let mut field = open.pop().unwrap_or_default();
    let is_plain = field.parts.iter().all(|part| part.name.is_empty() && part.parts.is_empty());
    let room: usize = field.parts.iter().map(|part| part.value.chars().count() + 2).sum();
    match bracket {
        ')' | ']' if is_plain && room <= ONE_LINE => {
            let items: Vec<&str> = field.parts.iter().map(|part| part.value.as_str()).collect();
            let begins = if bracket == ')' { '(' } else { '[' };
            field.value = format!("{}{begins}{}{bracket}", field.value, items.join(", "));
            field.parts.clear();
        }
        ')' if field.parts.len() == 1 => {
            let inner = field.parts.remove(0);
            field.value = format!("{}({})", field.value, inner.value);
            field.parts = inner.parts;
        }
        _ if field.value.is_empty() => field.value = format!("{} in it", field.parts.len()),
        _ => {}
    }
    field
}

/// The name in front of a value, empty if there is none, and the value. A key that is a text may hold colons.
fn named(text: &str) -> (&str, &str) {
    let behind_key =
        text.strip_prefix('"').map_or(0, |rest| rest.find("\": ").map_or(text.len(), |at| at + 2));
    match text[behind_key..].find(": ") {
        Some(at) => (&text[..behind_key + at], &text[behind_key + at + 2..]),
        None => ("", text),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
    struct Who {
        team: &'static str,
        number: u8,
    }

    #[derive(Debug)]
    #[expect(dead_code, reason = "they are read from the text")]
    struct Told {
        lock: Option<Who>,
        nobody: Option<Who>,
        at: (f32, f32),
        words: Vec<String>,
        ranks: BTreeMap<Who, u8>,
        notes: BTreeMap<&'static str, Option<u8>>,
        unit: (),
    }

    fn told() -> ToldField {
        let who = Who { team: "home", number: 3 };
        let told = Told {
            lock: Some(who.clone()),
            nobody: None,
            at: (1.5, -0.25),
            words: (0..9).map(|number| format!("word {number}: {{")).collect(),
            ranks: BTreeMap::from([(who, 7)]),
            notes: BTreeMap::from([("a: b", Some(1)), ("c", None)]),
            unit: (),
        };
        ToldField::of(&format!("{told:#?}"))
    }

    fn leaf(name: &str, value: &str) -> ToldField {
        ToldField { name: name.into(), value: value.into(), parts: Vec::new() }
    }

    #[test]
    fn a_structure_is_told_field_by_field_whatever_it_is_made_of() {
        let told = told();
        assert_eq!((told.name.as_str(), told.value.as_str()), ("", "Told"));
        let names: Vec<&str> = told.parts.iter().map(|part| part.name.as_str()).collect();
        assert_eq!(names, ["lock", "nobody", "at", "words", "ranks", "notes", "unit"]);
        let [lock, nobody, at, words, ranks, notes, unit] = told.parts.try_into().expect("it has seven");
        assert_eq!(lock.value, "Some(Who)");
        assert_eq!(lock.parts, [leaf("team", "\"home\""), leaf("number", "3")]);
        assert_eq!(nobody, leaf("nobody", "None"));
        assert_eq!(at, leaf("at", "(1.5, -0.25)"));
        assert_eq!((words.value.as_str(), words.parts.len()), ("9 in it", 9));
        assert_eq!(words.parts[0], leaf("", "\"word 0: {\""));
        assert_eq!(ranks.parts, [leaf("team \"home\", number 3", "7")]);
        assert_eq!(notes.parts, [leaf("\"a: b\"", "Some(1)"), leaf("\"c\"", "None")]);
        assert_eq!(unit, leaf("unit", "()"));
    }

    #[test]
    fn a_text_of_another_layout_is_told_line_by_line_and_one_that_is_cut_off_as_far_as_it_goes() {
        let lines = ToldField::of("body 0: at [1, 2]\nbody 1: at [3, 4]\n");
        assert_eq!(lines.parts, [leaf("body 0", "at [1, 2]"), leaf("body 1", "at [3, 4]")]);
        assert_eq!(ToldField::of(""), ToldField::default());
        assert_eq!(ToldField::of("Alone"), leaf("", "Alone"));
        let cut_off = ToldField { name: String::new(), value: "Whole".into(), parts: vec![leaf("a", "1")] };
        assert_eq!(ToldField::of("Whole {\n    a: 1,\n"), cut_off);
        assert_eq!(ToldField::of("}\n)").parts, [leaf("", "}"), leaf("", ")")]);
    }
}
