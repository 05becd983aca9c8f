//! The course is run: its files are written, its edits made, its commands called and their output compared.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::arguments;
use super::pages::Page;
use crate::command_line::{program, text};

#[test]
fn the_course_goes_as_it_says() {
    let page = Page::read("docs/course.md");
    let folder = tempfile::tempdir().expect("a folder for the course");
    let mut blocks = page.all_blocks().peekable();
    let mut before = page.text.as_str();
    let mut last_lines = BTreeMap::new();
    let mut counts = [0; 4];
    while let Some((language, block)) = blocks.next() {
        let (prose, rest) = before.split_once(block).expect("blocks stand in the text");
        before = rest;
        match language {
            "ron" => {
                counts[0] += 1;
                let name = named_file(prose);
                fs::write(folder.path().join(name), block).expect("the file is written");
            }
            "diff" => {
                counts[1] += 1;
                edit(&folder.path().join(named_file(prose)), block);
            }
            "sh" => {
                counts[2] += 1;
                let said = call(folder.path(), block);
                if let Some((_, expected)) = blocks.next_if(|(language, _)| *language == "text") {
                    counts[3] += 1;
                    compare(block, expected, &said);
                }
                let last = said.lines().last().unwrap_or_default().to_owned();
                let first = last_lines.entry(block).or_insert_with(|| last.clone());
                assert_eq!(*first, last, "the second time, `{block}` ended otherwise");
            }
            _ => panic!("a block of `{language}` has no meaning in the course"),
        }
    }
    assert!(counts.iter().all(|count| *count >= 3), "files, edits, commands, outputs: {counts:?}");
}

/// The file that the text before a block names last.
fn named_file(prose: &str) -> &str {
    let name = prose.rsplit('`').find(|code| code.starts_with("my_") && code.ends_with(".ron"));
    name.unwrap_or_else(|| panic!("no file is named in: {prose}"))
}

/// Makes a change that is written as a difference: lines that stay, `-` that go, `+` that come.
fn edit(path: &Path, difference: &str) {
    let side = |without: char| -> String {
        let lines = difference.lines().filter(|line| !line.starts_with(without));
        lines.map(|line| format!("{}\n", &line[1..])).collect()
    };
    let (old, new) = (side('+'), side('-'));
    let text = fs::read_to_string(path).expect("the file was written before");
    assert_eq!(text.matches(&old).count(), 1, "{}: there is not one place for:\n{old}", path.display());
    fs::write(path, text.replace(&old, &new)).expect("the file is written");
}

/// Runs a command in the folder and returns what it printed.
fn call(folder: &Path, block: &str) -> String {
    let command = block.trim();
    let arguments = arguments(command).unwrap_or_else(|| panic!("`{command}` is no command of the program"));
    let code = command.split_once("# exit code ").map_or(0, |(_, code)| code.parse().expect("a number"));
    let output = program(&arguments).current_dir(folder).output().expect("the program starts");
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(code), "`{command}`: {said}{}", text(&output.stderr));
    said
}

/// Whether each line is there, in this order; `…` stands for anything.
fn compare(command: &str, expected: &str, said: &str) {
    let mut lines = said.lines();
    for line in expected.lines() {
        assert!(
            lines.any(|other| fits(line, other)),
            "`{line}` is not where it should be in what `{command}` prints:\n{said}"
        );
    }
}

fn fits(pattern: &str, line: &str) -> bool {
    let mut parts = pattern.split('…').map(str::trim);
    let line = line.trim();
    let Some(mut rest) = parts.next().and_then(|start| line.strip_prefix(start)) else { return false };
    for part in parts {
        let Some((_, after)) = rest.split_once(part) else { return false };
        rest = after;
    }
    pattern.ends_with('…') || rest.is_empty()
}

#[test]
fn an_ellipsis_stands_for_anything() {
    assert!(fits("a … c", "a b c") && fits("… c", "a c") && fits("a …", "a b"));
    assert!(!fits("a … c", "a b") && !fits("a", "a b") && !fits("b", "a b"));
}
