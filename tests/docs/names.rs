//! What the pages name is there: files, headings, types, tests, words of the languages.

use std::collections::BTreeSet;
use std::path::Path;

use super::pages::{Page, pages, root};

#[test]
fn every_link_leads_to_a_file_and_a_heading() {
    let mut missing = Vec::new();
    for page in pages() {
        for link in page.links().iter().filter(|link| !link.contains("://")) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { root().join(&page.path) } else { page.target(file) };
            let is_there = target.exists() && (heading.is_empty() || has_heading(&target, heading));
            if !is_there {
                missing.push(format!("{}: {link}", page.path));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
}

#[test]
fn the_contents_list_every_page() {
    let contents = Page::read("docs/README.md");
    let listed: Vec<_> = contents.links().iter().map(|link| contents.target(link)).collect();
    for page in pages().iter().filter(|page| page.path.starts_with("docs/") && page.path != contents.path) {
        assert!(listed.contains(&root().join(&page.path)), "{} is not in the contents", page.path);
    }
}

#[test]
fn every_cargo_command_is_one_of_cargos_or_an_alias() {
    let aliases =
        std::fs::read_to_string(root().join(".cargo/config.toml")).expect("the aliases can be read");
    let builtin = ["bench", "fuzz", "run", "test", "tree"];
    for page in pages() {
        for command in page.blocks("sh").flat_map(str::lines).chain(page.code()) {
            let name = command.strip_prefix("cargo ").and_then(|rest| rest.split_whitespace().next());
            let is_known = |name: &str| builtin.contains(&name) || aliases.contains(&format!("\n{name} = "));
            assert!(name.is_none_or(is_known), "{}: {command}", page.path);
        }
    }
}

fn has_heading(path: &Path, heading: &str) -> bool {
    let text = std::fs::read_to_string(path).expect("the page can be read");
    Page { path: String::new(), text }.anchors().iter().any(|anchor| anchor == heading)
}

#[test]
fn every_file_that_a_page_names_is_there() {
    let mut missing = Vec::new();
    for page in pages().iter().filter(|page| page.path != "CHANGELOG.md") {
        for code in page.code() {
            let top = code.split('/').next().unwrap_or_default();
            let is_path = code.contains('/') && !code.contains([' ', '<', '*']) && root().join(top).is_dir();
            if is_path && !root().join(code).exists() {
                missing.push(format!("{}: {code}", page.path));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
}

#[test]
fn every_name_in_a_page_is_one_of_the_code() {
    let known =
        words_of(&["src", "tests", "assets", "examples", "benches", "fuzz/fuzz_targets", ".cargo", ".ci"]);
    let mut unknown = Vec::new();
    for page in pages().iter().filter(|page| page.path != "CHANGELOG.md") {
        // Addresses, patterns and the ends of names name nothing.
        for code in
            page.code().filter(|code| !code.contains("//") && !code.contains('*') && !code.starts_with('_'))
        {
            let names = code.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            // Names of types have a capital and a small letter, those of tests and fields an underscore.
            let names = names.filter(|name| {
                let mixed = name.contains(char::is_uppercase) && name.contains(char::is_lowercase);
                (mixed || name.contains('_')) && !name.starts_with("my_") && *name != "lone_keeper"
            });
            unknown.extend(
                names.filter(|name| !known.contains(*name)).map(|name| format!("{}: {name}", page.path)),
            );
        }
    }
    assert!(unknown.is_empty(), "{unknown:#?}");
}

/// All words in the files of these folders, and the names of the files.
fn words_of(folders: &[&str]) -> BTreeSet<String> {
    let mut words = BTreeSet::new();
    let mut open: Vec<_> = folders.iter().map(|folder| root().join(folder)).collect();
    while let Some(path) = open.pop() {
        words.extend(path.file_stem().map(|name| name.to_string_lossy().into_owned()));
        if path.is_dir() {
            let entries = std::fs::read_dir(&path).expect("the folder can be read");
            open.extend(entries.map(|entry| entry.expect("the folder can be read").path()));
        } else if let Ok(text) = std::fs::read_to_string(&path) {
            words.extend(text.split(|c: char| !(c.is_alphanumeric() || c == '_')).map(str::to_owned));
        }
    }
    words
}

/// The test that shows a cell of `docs/protocols.md` is in the file that the link names.
#[test]
fn every_test_that_protocols_names_is_in_its_file() {
    let page = Page::read("docs/protocols.md");
    let file = |key: &str| {
        let line = page.text.lines().find_map(|line| line.strip_prefix(&format!("[{key}]: ")));
        std::fs::read_to_string(page.target(line.expect("the link has a target")))
            .expect("the file can be read")
    };
    let cells: Vec<_> = page.text.split("[`").skip(1).filter_map(|rest| rest.split_once("`][")).collect();
    assert!(cells.len() > 40, "{} tests are named", cells.len());
    for (test, rest) in cells {
        let key = rest.split(']').next().unwrap_or_default();
        assert!(file(key).contains(&format!("fn {test}()")), "{test} is not in [{key}]");
    }
}

/// The words that a file of the language has, as variants of its enums; the kind of a schema is no word.
fn variants(path: &str) -> Vec<String> {
    let text = std::fs::read_to_string(root().join(path)).expect("the file can be read");
    let text = text.split("#[cfg(test)]").next().unwrap_or_default();
    let enums = text.split("\npub enum ").skip(1).filter(|rest| !rest.starts_with("SchemaKind"));
    let enums = enums.filter_map(|rest| rest.split("\n}").next());
    let lines = enums.flat_map(|body| body.lines().skip(1)).filter_map(|line| line.strip_prefix("    "));
    let lines = lines.filter(|line| line.starts_with(char::is_uppercase));
    lines.filter_map(|line| line.split(|c: char| !c.is_alphanumeric()).next().map(str::to_owned)).collect()
}

#[test]
fn the_pages_of_the_languages_have_every_word() {
    let pages = ["docs/strategy-language.md", "docs/teamwork.md", "docs/scenarios.md"].map(Page::read);
    let code = pages.iter().flat_map(Page::code);
    let said: BTreeSet<_> = code.flat_map(|code| code.split(|c: char| !c.is_alphanumeric())).collect();
    for file in [
        "src/strategy/language.rs",
        "src/lab/scenario/condition.rs",
        "src/lab/scenario/event.rs",
        "src/comms/radio/faults.rs",
    ] {
        let variants = variants(file);
        assert!(variants.len() > 3, "{file} has only {variants:?}");
        let missing: Vec<_> = variants.iter().filter(|word| !said.contains(word.as_str())).collect();
        assert!(missing.is_empty(), "the pages lack {missing:?} of {file}");
    }
}
