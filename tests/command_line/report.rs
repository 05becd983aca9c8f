//! `touchline report` as a person calls it.

use std::fs;
use std::path::Path;

use quick_xml::Reader;
use quick_xml::events::Event;

use super::experiment::{DESIGN, Stage};
use super::{program, text, touchline};

/// Claims that nobody doubts, but for which two seeds are too few.
const CLAIMED: &str = r#"metrics: [PacketsLost], claims: [
    (says: "Loss loses", source: "common sense", metric: PacketsLost, of: ["0.9"], than: ["0"], is: More),
    (says: "The rest arrives", source: "common sense", metric: PacketsLost, of: ["0"], is: Between(0.001, 0.2)),
]"#;

fn stage() -> Stage {
    Stage::new(&DESIGN.replace("metrics: [PacketsLost]", CLAIMED))
}

fn written(path: &Path) -> String {
    fs::read_to_string(path).expect("the report is written")
}

/// How often elements begin in a page, which is well-formed.
fn elements(page: &str, name: &str) -> usize {
    let mut reader = Reader::from_str(page);
    let (mut open, mut count) = (0_usize, 0);
    loop {
        match reader.read_event().expect("the page is well-formed") {
            Event::Start(start) => {
                open += 1;
                count += usize::from(start.name().as_ref() == name.as_bytes());
            }
            Event::End(_) => open -= 1,
            Event::Eof => break,
            _ => {}
        }
    }
    assert_eq!(open, 0, "every element ends");
    count
}

#[test]
fn a_report_has_what_was_played_the_figures_and_the_verdicts() {
    let stage = stage();
    let said = stage.play("out", &[]);
    let [folder, html, markdown] = ["out", "report.html", "report.md"].map(|name| stage.path(name));
    let paths = [&folder, &html, &markdown].map(|path| path.display().to_string());
    let call = ["report", &paths[0], "--html", &paths[1], "--markdown", &paths[2]];
    let output = touchline(&call);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(output.stdout.is_empty());

    let markdown = written(&markdown);
    let mean =
        said.lines().find_map(|line| line.trim().strip_prefix("packets_lost")).expect("a mean is printed");
    let mean = mean.split(']').next().expect("it has an interval").trim();
    for wanted in [
        &format!("```\ntouchline {}\n```", call.join(" ")),
        "## Does loss matter?",
        "2 treatments with the seeds 5 to 6, each once more with the teams on each other's sides: 8 of 8 matches.",
        &format!("touchline experiment {0}/design.ron --out {0}\n", paths[0]),
        "| Loss loses | common sense | packets lost: 0.9 against 0 | cannot be said | +0.",
        "| The rest arrives | common sense | packets lost: 0 | cannot be said | 0.",
        " with 2 seeds: they are too few or too even to tell the spread |",
        "### Packets lost",
        &format!("| 0 | 2 | {mean}] |"),
    ] {
        assert!(markdown.contains(wanted), "`{wanted}` is not in: {markdown}");
    }
    let page = written(&html);
    assert_eq!(elements(&page, "svg"), 2, "a curve and the spread");
    assert_eq!(elements(&page, "table"), markdown.lines().filter(|line| line.starts_with("|---")).count());
    assert!(page.contains("Loss loses"));
    for door in ["src=", "href=\"h", "url(", "@import", "<script"] {
        assert!(!page.contains(door), "{door}");
    }
    // Without a file the same is printed, but for the command.
    let printed = text(&touchline(&["report", &paths[0]]).stdout);
    let after = |text: &str| text.split_once("## ").expect("there is a chapter").1.to_owned();
    assert_eq!(after(&printed), after(&markdown));
}

#[test]
fn a_folder_without_an_experiment_is_refused_in_one_line() {
    let stage = stage();
    stage.play("out", &["--seeds", "1"]);
    let refused = |folder: &Path, named: &str| {
        let html = stage.path("report.html");
        let output =
            touchline(&["report", &folder.display().to_string(), "--html", &html.display().to_string()]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(named) && message.lines().count() == 1, "{message}");
        assert!(!html.exists());
    };
    refused(&stage.path("nowhere"), "holds no design.ron");
    let folder = stage.path("out");
    let table = written(&folder.join("rows.csv"));
    fs::write(folder.join("rows.csv"), table.lines().next().expect("a header").to_owned() + "\n")
        .expect("written");
    refused(&folder, "rows.csv: has no rows");
    fs::write(folder.join("rows.csv"), table.replacen(",0.1.0,", ",0.0.9,", 1)).expect("written");
    refused(&folder, "rows.csv:2: was played by version 0.0.9");
    fs::remove_file(folder.join("rows.csv")).expect("it is there");
    refused(&folder, "holds no rows.csv");
    fs::write(folder.join("design.ron"), "(name: 3").expect("written");
    refused(&folder, "design.ron:1:");
}

#[test]
fn several_experiments_are_played_in_turn_and_part_of_their_seeds_first() {
    let stage = stage();
    fs::write(stage.path("other.ron"), DESIGN.replace("first: 5", "first: 7")).expect("another design");
    let play = |more: &[&str]| {
        let call = [&["experiment", "loss.ron", "other.ron"], more].concat();
        let output = program(&call).current_dir(stage.path(".")).output().expect("the program starts");
        (output.status.code(), text(&output.stdout), text(&output.stderr))
    };
    let (code, said, _) = play(&["--seeds", "1"]);
    assert_eq!(code, Some(0));
    assert_eq!(said.matches("4 of 8 matches in ").count(), 2, "{said}");
    let first = written(&stage.path("other.results/rows.csv"));
    let report = |folder: &str| {
        let output = program(&["report", folder]).current_dir(stage.path(".")).output();
        text(&output.expect("the program starts").stdout)
    };
    let told = report("other.results");
    let wanted = "touchline experiment other.results/design.ron --seeds 1 --out other.results\n";
    assert!(told.contains(wanted), "{told}");
    let (_, said, _) = play(&[]);
    assert_eq!(said.matches("8 of 8 matches in ").count(), 2, "{said}");
    assert!(written(&stage.path("other.results/rows.csv")).starts_with(&first));
    for option in [["--out", "x"], ["--row", "1"]] {
        let (code, _, error) = play(&option);
        assert_eq!(code, Some(2));
        assert!(error.starts_with(&format!("{}: ", option[0])) && error.lines().count() == 1, "{error}");
    }
}
