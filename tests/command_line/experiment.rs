//! `touchline experiment` and `merge` as a person or a cluster calls them.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use touchline::data::{AssetKind, Source};
use touchline::lab::experiment::{DesignChange, ExperimentFile, FactorLevels, SeedBlocks};
use touchline::rng::{Dice, Seed};

use super::{text, touchline};
use crate::support::assets;

/// Two treatments, two seeds, both sides: eight matches of six seconds a half.
pub(super) const DESIGN: &str = r#"(
    name: "Does loss matter?",
    common: [HalfMinutes(0.1), Home("hammerheads_2001")],
    factors: [(name: "loss", levels: Values(file: "radios/good.ron", path: "loss.Independent[0]", values: [0, 0.9]))],
    blocks: (first: 5, number: 2),
    metrics: [PacketsLost],
)"#;

pub(super) struct Stage {
    folder: tempfile::TempDir,
}

impl Stage {
    pub fn new(design: &str) -> Stage {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("loss.ron"), design).expect("the design is written");
        Stage { folder }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn call(&self, command: &str, out: &str, more: &[&str]) -> Output {
        let [design, out] = [self.path("loss.ron"), self.path(out)].map(|path| path.display().to_string());
        touchline(&[&[command, &design, "--out", &out], more].concat())
    }

    pub fn play(&self, out: &str, more: &[&str]) -> String {
        let output = self.call("experiment", out, more);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stdout)
    }

    fn table(&self, out: &str) -> String {
        fs::read_to_string(self.path(out).join("rows.csv")).expect("there is a table")
    }
}

/// The fields of a column, by its name.
fn column<'a>(table: &'a str, name: &str) -> Vec<&'a str> {
    let mut lines = table.lines();
    let place = lines.next().and_then(|header| header.split(',').position(|column| column == name));
    let place = place.unwrap_or_else(|| panic!("no column {name}"));
    lines.map(|line| line.split(',').nth(place).expect("all lines are as long")).collect()
}

#[test]
fn every_treatment_is_played_with_every_seed_on_both_sides_and_the_tables_agree() {
    let stage = Stage::new(DESIGN);
    stage.play("out", &[]);
    let table = stage.table("out");
    assert_eq!(column(&table, "row"), ["0", "1", "2", "3", "4", "5", "6", "7"]);
    assert_eq!(column(&table, "seed"), ["5", "5", "5", "5", "6", "6", "6", "6"]);
    assert_eq!(column(&table, "loss"), ["0", "0", "0.9", "0.9", "0", "0", "0.9", "0.9"]);
    assert_eq!(column(&table, "swapped"), ["0", "1", "0", "1", "0", "1", "0", "1"]);
    assert!(column(&table, "strategy").iter().all(|name| *name == "hammerheads_2001"), "{table}");
    let lost: Vec<f64> =
        column(&table, "packets_lost").iter().map(|it| it.parse().expect("a share")).collect();
    assert!(
        lost[..2].iter().all(|share| *share < 0.2) && lost[2..4].iter().all(|share| *share > 0.7),
        "{lost:?}"
    );
    let parquet = fs::read(stage.path("out").join("rows.parquet")).expect("there is the other table");
    assert_eq!(parquet_column(&parquet, "seed"), column(&table, "seed"));
    assert_eq!(parquet_column(&parquet, "packets_lost"), column(&table, "packets_lost"));
    assert_eq!(parquet_column(&parquet, "digest"), column(&table, "digest"));
}

fn parquet_column(bytes: &[u8], name: &str) -> Vec<String> {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    let reader = SerializedFileReader::new(parquet_bytes(bytes)).expect("it is Parquet");
    let rows = reader.get_row_iter(None).expect("it has rows");
    let rows = rows.map(|row| row.expect("the row can be read"));
    let field = |row: parquet::record::Row| {
        let (_, field) = row.get_column_iter().find(|(column, _)| *column == name).expect("the column");
        match field {
            parquet::record::Field::Str(text) => text.clone(),
            parquet::record::Field::Double(number) => number.to_string(),
            other => other.to_string(),
        }
    };
    rows.map(field).collect()
}

fn parquet_bytes(bytes: &[u8]) -> fs::File {
    use std::io::Write;
    let mut file = tempfile::tempfile().expect("a file");
    file.write_all(bytes).expect("it takes the bytes");
    file
}

#[test]
fn a_table_that_was_cut_off_is_completed_and_comes_out_the_same() {
    let stage = Stage::new(DESIGN);
    stage.play("out", &[]);
    let whole = stage.table("out");
    // As a crash leaves it: some rows, and the beginning of another.
    let kept: usize = whole.split_inclusive('\n').take(4).map(str::len).sum();
    fs::write(stage.path("out").join("rows.csv"), &whole[..kept + 40]).expect("it is cut");
    stage.play("out", &[]);
    assert_eq!(stage.table("out"), whole);
}

#[test]
fn parts_that_were_played_elsewhere_merge_to_the_whole() {
    let stage = Stage::new(DESIGN);
    stage.play("whole", &[]);
    stage.play("one", &["--shard", "1/2"]);
    stage.play("two", &["--shard", "2/2"]);
    assert_eq!(column(&stage.table("two"), "seed"), ["6"; 4]);
    let parts = ["one", "two"].map(|part| stage.path(part).display().to_string());
    let merged = stage.call("merge", "merged", &[&parts[0], &parts[1]]);
    assert_eq!(merged.status.code(), Some(0), "{}", text(&merged.stderr));
    assert_eq!(stage.table("merged"), stage.table("whole"));
    // One part after the other comes to the same.
    let missing = stage.call("merge", "half", &[&parts[0]]);
    assert_eq!(missing.status.code(), Some(0));
    assert!(text(&missing.stdout).contains("4 of 8 matches"), "{}", text(&missing.stdout));
    stage.call("merge", "half", &[&parts[1]]);
    assert_eq!(stage.table("half"), stage.table("whole"));
}

#[test]
fn parts_of_a_design_that_stops_by_itself_are_refused_before_anything_is_written() {
    let until = "until: Some(Width(metric: Goals, confidence: 0.9, width: 1)), metrics:";
    let stage = Stage::new(&DESIGN.replace("metrics:", until));
    let output = stage.call("experiment", "out", &["--shard", "1/2"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).starts_with("--shard: "), "{}", text(&output.stderr));
    assert!(!stage.path("out").exists());
}

#[test]
fn a_row_can_be_played_again_and_is_compared() {
    let stage = Stage::new(DESIGN);
    stage.play("out", &["--shard", "1/2"]);
    let said = stage.play("out", &["--row", "3"]);
    assert!(said.contains("the match is as it is in"), "{said}");
    assert!(said.lines().any(|line| line.starts_with("packets_lost ")), "{said}");
    let path = stage.path("out").join("rows.csv");
    let table = stage.table("out");
    let digest = column(&table, "digest")[3].to_owned();
    fs::write(&path, table.replace(&digest, "0123456789abcdef")).expect("it is changed");
    let output = stage.call("experiment", "out", &["--row", "3"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("row 3 has come out differently"), "{}", text(&output.stderr));
}

#[test]
fn what_belongs_to_another_experiment_or_other_files_is_refused_and_stays_as_it_is() {
    let stage = Stage::new(DESIGN);
    stage.play("out", &["--shard", "1/2"]);
    let before = stage.table("out");
    let refused = |stage: &Stage, named: &str| {
        let output = stage.call("experiment", "out", &[]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(named) && message.lines().count() == 1, "{message}");
        assert_eq!(stage.table("out"), before);
    };
    fs::write(stage.path("loss.ron"), DESIGN.replace("first: 5", "first: 6")).expect("another design");
    refused(&stage, "is another experiment");
    fs::write(stage.path("loss.ron"), DESIGN).expect("the design");
    let path = stage.path("out").join("rows.csv");
    let assets = column(&before, "assets")[0].to_owned();
    fs::write(&path, before.replace(&assets, "0000000000000001")).expect("other files");
    let before = stage.table("out");
    let output = stage.call("experiment", "out", &[]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        text(&output.stderr).contains("rows.csv:2: was played from other files"),
        "{}",
        text(&output.stderr)
    );
    assert_eq!(stage.table("out"), before);
}

/// A claim of what is lost, in a design.
fn claimed(is: &str, than: &str) -> String {
    let claim = format!(r#"(says: "a", source: "b", metric: PacketsLost, of: ["0"], {than}is: {is})"#);
    format!("metrics: [PacketsLost], claims: [{claim}]")
}

#[test]
fn a_design_that_cannot_be_is_refused_in_a_line_that_names_the_place() {
    for (was, is, named) in [
        ("radios/good.ron", "radios/none.ron", "no such file"),
        ("loss.Independent[0]", "loss.Independent[1]", "no number"),
        ("Home(\"hammerheads_2001\")", "Home(\"hammerhead\")", "common[1].Home"),
        ("number: 2", "number: 0", "blocks.number"),
        ("metrics: [PacketsLost]", "metrics: [Beauty]", "Beauty"),
        ("name: \"loss\"", "name: \"goals\"", "the name of a column"),
        ("HalfMinutes(0.1)", "Without(Home, BallBooking)", "common[0]"),
        (
            "HalfMinutes(0.1)",
            "Number(file: \"pitches/four_legged_2005.ron\", path: \"length\", to: 6.0)",
            "common[0].Number.file: makes no difference to any match",
        ),
        ("HalfMinutes(0.1)", "Event(at: 3, what: Crash(\"home 9\"))", "home 9"),
        (
            "metrics: [PacketsLost]",
            &claimed("Between(0.5, 0.1)", ""),
            "must begin below its end, not (0.5, 0.1)",
        ),
        ("metrics: [PacketsLost]", &claimed("Between(0.1, 0.5)", "than: [\"0\"], "), "claims[0].than"),
        ("metrics: [PacketsLost]", &claimed("Less", ""), "claims[0].than: must be a level of each factor"),
    ] {
        let design = DESIGN.replace(was, is);
        assert_ne!(design, DESIGN);
        let stage = Stage::new(&design);
        let output = stage.call("experiment", "out", &[]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(named) && message.contains("loss.ron:"), "{message}");
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(!Path::new(&stage.path("out")).exists());
    }
}

#[test]
fn every_shipped_experiment_can_be_played() {
    for path in assets().files(AssetKind::Experiment).expect("there are some") {
        let source = Source::read(&path).expect("it can be read");
        let mut design: ExperimentFile = source.parse_sound().expect("it is sound");
        design.common.push(DesignChange::HalfMinutes(0.02));
        if design.common.contains(&DesignChange::Match("four_legged_2005".into())) {
            // Robots that walk to their places take longer than all of the play.
            design.common.push(DesignChange::Number {
                file: "matches/four_legged_2005.ron".into(),
                path: "rules.ready_seconds".into(),
                to: 1.0,
            });
        }
        (design.until, design.blocks) = (None, SeedBlocks { first: 3, number: 1 });
        soon(&mut design);
        let stage =
            Stage::new(&touchline::data::ron_options().to_string(&design).expect("it can be written"));
        let said = stage.play("out", &[]);
        let table = stage.table("out");
        assert_eq!(column(&table, "row").len(), 2 * design.treatments(), "{}", path.display());
        assert!(column(&table, "error").iter().all(|error| error.is_empty()), "{table}");
        assert_eq!(said.matches(", 1 seeds").count(), design.treatments(), "{said}");
        let row = any_row(&table);
        let said = stage.play("out", &["--row", &row]);
        assert!(said.contains("the match is as it is in"), "{}, row {row}: {said}", path.display());
    }
}

/// What happens in minutes happens in seconds, before a miniature is over.
fn soon(design: &mut ExperimentFile) {
    for factor in &mut design.factors {
        let FactorLevels::Named(levels) = &mut factor.levels else { continue };
        for change in levels.iter_mut().flat_map(|level| &mut level.changes) {
            if let DesignChange::Event(event) = change {
                event.at /= 100.0;
            }
        }
    }
}

/// A row of a table, drawn by dice with the digest of its first match as their seed.
fn any_row(table: &str) -> String {
    let rows = column(table, "row");
    let digest = column(table, "digest")[0];
    let seed = Seed(u64::from_str_radix(digest, 16).expect("a digest is a number"));
    rows[Dice::new(seed, "any row", None).below(rows.len())].to_owned()
}

#[test]
fn a_design_that_stops_by_itself_plays_no_more_than_it_takes_and_goes_on_if_it_was_cut_off() {
    let until = "until: Some(Width(metric: Driven, confidence: 0.9, width: 500)), metrics:";
    let short = DESIGN.replace("HalfMinutes(0.1)", "HalfMinutes(0.03)");
    let design = short.replace("number: 2", "number: 99").replace("metrics:", until);
    let stage = Stage::new(&design);
    stage.play("out", &[]);
    let whole = stage.table("out");
    let seeds = column(&whole, "seed").len() / 4;
    assert_eq!(seeds, 50, "the first look is enough");
    let kept: usize = whole.split_inclusive('\n').take(4).map(str::len).sum();
    fs::write(stage.path("out").join("rows.csv"), &whole[..kept]).expect("it is cut");
    stage.play("out", &[]);
    assert_eq!(stage.table("out"), whole);
}
