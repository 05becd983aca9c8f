//! The pages for people say what is so: their commands, links, names and examples are those of the program, and the course
//! is run from start to end.

mod course;
mod names;
mod pages;

use touchline::data::{AssetKind, Source};
use touchline::lab::scenario::ScenarioPlan;
use touchline::strategy::Strategy;

use crate::command_line::{program, text};
use crate::support::{assets, digest_of, friendly};
use pages::{Page, pages};

#[test]
fn the_strategy_in_the_docs_can_be_played() {
    let page = Page::read("docs/strategy-language.md");
    let example = page.blocks("ron").next().expect("the page has an example");
    let source = Source::new("docs/strategy-language.md", example);
    let strategy = Strategy::parse(&assets(), &source, None).unwrap_or_else(|error| panic!("{error}"));
    let mut plan = friendly(1, 0.3);
    plan.teams[0].strategy = strategy.into();
    assert_ne!(digest_of(&plan), digest_of(&friendly(1, 0.3)));
}

#[test]
fn the_scenario_in_the_docs_passes() {
    let page = Page::read("docs/scenarios.md");
    let folder = tempfile::tempdir().expect("a folder for the test");
    let path = folder.path().join("example.ron");
    let example = page.blocks("ron").next().expect("the page has an example");
    std::fs::write(&path, example).expect("the folder can be written to");
    let report =
        ScenarioPlan::read(&assets(), &path.into()).unwrap_or_else(|error| panic!("{error}")).run(None);
    assert!(report.passed(), "{report}");
}

#[test]
fn the_results_are_those_of_the_shipped_designs() {
    let results = Page::read("RESULTS.md");
    for path in assets().files(AssetKind::Experiment).expect("there are some") {
        let design = std::fs::read(&path).expect("it can be read");
        let hash = format!("hash of the design {:016x}", xxhash_rust::xxh3::xxh3_64(&design));
        assert!(
            results.text.contains(&hash),
            "RESULTS.md has no chapter of {} as it is: {hash}",
            path.display()
        );
    }
}

/// What `cargo run --` and `cargo headless` run with these arguments, if a command of the docs is one of them.
fn arguments(command: &str) -> Option<Vec<&str>> {
    let command = command.split('#').next().unwrap_or_default().trim();
    let rest = command.strip_prefix("cargo run -- ").or_else(|| command.strip_prefix("cargo headless "))?;
    Some(rest.split_whitespace().collect())
}

#[test]
fn every_command_in_the_docs_is_one_of_the_program() {
    let mut count = 0;
    for page in pages() {
        for command in page.blocks("sh").flat_map(str::lines).chain(page.code()) {
            let Some(arguments) = arguments(command) else { continue };
            count += 1;
            // Arguments are read up to the `--help`, so the match is not played.
            let output = program(&arguments).arg("--help").output().expect("the program starts");
            assert!(output.status.success(), "{}: `{command}`: {}", page.path, text(&output.stderr));
            for pair in arguments.windows(2) {
                assert_is_an_asset(pair[0], pair[1], &page.path);
            }
        }
    }
    assert!(count > 30, "only {count} commands were found");
}

/// Whether the option, if it names an asset, names one that is shipped or a file of one's own.
fn assert_is_an_asset(option: &str, value: &str, page: &str) {
    let kind = match option {
        "--home" | "--away" => AssetKind::Strategy,
        "--match" => AssetKind::Match,
        "--radio" if value != "udp" => AssetKind::Radio,
        _ => return,
    };
    let is_own = value.starts_with("my_") || value == "lone_keeper.ron";
    assert!(is_own || assets().names(kind).iter().any(|name| name == value), "{page}: {option} {value}");
}
