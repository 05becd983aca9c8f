//! Every number in a file of every kind, and any number in its place.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use touchline::data::{AssetFolder, AssetKind, DataError};
use touchline::game::{Choice, Match, MatchPlan};
use touchline::lab::kinds;
use touchline::lab::scenario::ScenarioPlan;
use touchline::ops;

use super::{SCENARIO, assert_on_pitch};
use crate::support::assets;

fn copy_assets(to: &Path) {
    for kind in AssetKind::ALL.into_iter().filter(|kind| *kind != AssetKind::Scenario) {
        fs::create_dir_all(to.join(kind.folder())).expect("a folder is made");
        for name in assets().names(kind) {
            let text = fs::read_to_string(assets().file(kind, &name)).expect("an asset can be read");
            fs::write(to.join(kind.folder()).join(format!("{name}.ron")), text)
                .expect("the asset is written");
        }
    }
}

/// Kind, name and match of files with all kinds of numbers; without a kind, the scenario.
const FILES: [(&str, &str, &str); 16] = [
    ("matches", "friendly", "friendly"),
    ("pitches", "middle_size_2001", "friendly"),
    ("robots", "cye", "friendly"),
    ("sensing", "cye_2001", "friendly"),
    ("radios", "good", "friendly"),
    ("strategies", "hammerheads_2001", "friendly"),
    ("strategies", "ball_chasers", "friendly"),
    ("robots", "cye", ""),
    ("strategies", "ball_chasers", ""),
    ("matches", "four_legged_2005", "four_legged_2005"),
    ("pitches", "four_legged_2005", "four_legged_2005"),
    ("robots", "aibo_ers7", "four_legged_2005"),
    ("sensing", "aibo_ers7", "four_legged_2005"),
    ("radios", "awful", "four_legged_2005"),
    ("strategies", "chaos_b3p", "four_legged_2005"),
    ("", "", ""),
];

/// The places of the numbers in a text, outside of comments and strings.
fn numbers(text: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start_of_line = 0;
    for line in text.split_inclusive('\n') {
        let code = line.split("//").next().unwrap_or(line);
        let mut at = 0;
        while at < code.len() {
            let rest = &code[at..];
            if let Some(inside) = rest.strip_prefix('"') {
                at += inside.find('"').map_or(rest.len(), |end| end + 2);
                continue;
            }
            let in_word = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '-');
            let length = rest
                .find(|c| !in_word(c))
                .unwrap_or(rest.len())
                .max(rest.chars().next().map_or(1, char::len_utf8));
            if rest[..length].parse::<f32>().is_ok() {
                found.push(start_of_line + at..start_of_line + at + length);
            }
            at += length;
        }
        start_of_line += line.len();
    }
    found
}

/// Any finite number, small and large ones alike, and those that people write.
fn finite() -> impl Strategy<Value = f32> {
    let sign = prop_oneof![Just(1.0_f32), Just(-1.0)];
    let size = prop_oneof![
        3 => (-40.0_f32..38.0).prop_map(|power| ops::powf(10.0, power)),
        3 => (-3.0_f32..3.5).prop_map(|power| ops::powf(10.0, power)),
        1 => Just(0.0),
        1 => Just(f32::MAX),
        1 => Just(f32::MIN_POSITIVE),
        2 => (0_u16..1000).prop_map(f32::from),
    ];
    (sign, size).prop_map(|(sign, size)| sign * size)
}

fn plan(
    assets: &AssetFolder,
    game: &str,
    strategy: Option<&str>,
    scenario: &Path,
) -> Result<MatchPlan, DataError> {
    if game.is_empty() {
        return Ok(ScenarioPlan::read(assets, &scenario.into())?.with_seed(1));
    }
    let radio = (game == "four_legged_2005").then(|| "awful".to_owned());
    let choice = Choice { file: Some(game.into()), radio, seed: 1, ..Choice::default() };
    MatchPlan::read(assets, &Choice { home: strategy.map(str::to_owned), ..choice })
}

/// The shipped assets in a folder of their own, with a scenario, and one of the files.
struct Copied {
    folder: tempfile::TempDir,
    file: (&'static str, &'static str, &'static str),
    text: String,
}

impl Copied {
    fn new(file: (&'static str, &'static str, &'static str)) -> Copied {
        let folder = tempfile::tempdir().expect("a temporary folder");
        copy_assets(folder.path());
        fs::write(folder.path().join("scenario.ron"), SCENARIO).expect("the scenario is written");
        let mut copied = Copied { folder, file, text: String::new() };
        copied.text = fs::read_to_string(copied.path()).expect("the file can be read");
        copied
    }

    fn path(&self) -> PathBuf {
        match self.file {
            ("", ..) => self.folder.path().join("scenario.ron"),
            (kind, name, _) => self.folder.path().join(kind).join(format!("{name}.ron")),
        }
    }

    /// Writes the file with another number in one place.
    fn write(&self, place: &Range<usize>, number: &str) {
        let changed = format!("{}{number}{}", &self.text[..place.start], &self.text[place.end..]);
        fs::write(self.path(), changed).expect("the file is written");
    }

    /// The match with another number in one place of the file.
    fn with(&self, place: &Range<usize>, number: &str) -> Result<MatchPlan, DataError> {
        self.write(place, number);
        let (kind, name, game) = self.file;
        let scenario = self.folder.path().join("scenario.ron");
        plan(&AssetFolder::new(self.folder.path()), game, (kind == "strategies").then_some(name), &scenario)
    }
}

#[test]
fn every_number_of_every_kind_of_file_has_a_bound() {
    for file in FILES {
        let copied = Copied::new(file);
        let places = numbers(&copied.text);
        assert!(places.len() >= 2, "{file:?}");
        for place in places {
            for number in ["1e30", "-1e30", "NaN"] {
                let Err(error) = copied.with(&place, number) else {
                    panic!(
                        "{file:?} was read with {number} for {}",
                        &copied.text[place.start - 30..place.end]
                    );
                };
                let error = error.to_string();
                let is_told = [number, "whole number", "out of bounds", "number of seeds"]
                    .iter()
                    .any(|word| error.contains(word));
                assert!(is_told && error.lines().count() == 1, "{error}");
                assert!(error.starts_with(&*copied.path().to_string_lossy()), "{error}");
            }
        }
    }
}

/// Files that are no match's: a camera, experiments and tunings, and eyes that are calibrated cameras.
#[test]
fn every_number_of_a_camera_an_experiment_or_a_tuning_has_a_bound() {
    use AssetKind::{Camera, Experiment, Sensing, Tuning};
    for (kind, name) in [
        (Camera, "aibo_ers7"),
        (Camera, "cye_2001"),
        (Sensing, "cye_2001_images"),
        (Experiment, "booking_and_contact"),
        (Experiment, "hammerheads"),
        (Experiment, "take_over"),
        (Tuning, "hammerheads_avoidance"),
        (Tuning, "booking"),
    ] {
        let copied = Copied::new((kind.folder(), name, ""));
        let there = AssetFolder::new(copied.folder.path());
        let places = numbers(&copied.text);
        assert!(places.len() >= 2, "{name}");
        for place in places {
            let line = copied.text[..place.start].matches('\n').count() + 1;
            let at = format!("{}:{line}:", copied.path().display());
            for number in ["1e30", "-1e30", "NaN"] {
                copied.write(&place, number);
                let Err(error) = kinds::read(&there, kind, &copied.path().into()) else {
                    panic!("{at} {name} was read with {number}");
                };
                let error = error.to_string();
                assert!(error.starts_with(&at) && error.lines().count() == 1, "{number}: {error}");
            }
        }
    }
}

proptest! {
    // The same numbers in every run.
    #![proptest_config(ProptestConfig { cases: 96, rng_seed: RngSeed::Fixed(2001), ..ProptestConfig::default() })]
    #[test]
    fn any_number_in_a_shipped_file_is_refused_or_played(
        file in prop::sample::select(&FILES[..]),
        place in any::<prop::sample::Index>(),
        number in finite(),
    ) {
        let copied = Copied::new(file);
        let places = numbers(&copied.text);
        let place = &places[place.index(places.len())];
        let whole = copied.text[place.clone()].parse::<u16>().is_ok() && (0.0..1e9).contains(&number);
        let number = if whole { number.trunc().to_string() } else { format!("{number:e}") };
        match copied.with(place, &number) {
            Err(error) => {
                let error = error.to_string();
                prop_assert_eq!(error.lines().count(), 1, "{}", error);
                prop_assert!(error.contains(".ron:"), "{}", error);
            }
            Ok(mut plan) => {
                // In play as soon as possible.
                plan.rules.ready_seconds = plan.rules.ready_seconds.min(0.5);
                plan.rules.set_seconds = plan.rules.set_seconds.min(0.5);
                let mut game = Match::new(&plan);
                for _ in 0..200 {
                    game.tick();
                    assert_on_pitch(&mut game);
                }
            }
        }
    }
}
