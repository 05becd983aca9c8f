//! What kind of asset a file is, and reading it as a match would.

use crate::comms::radio::Radio;
use crate::data::{AssetFolder, AssetKind, DataError, Source, TopLevel, field_names};
use crate::game::{Choice, MatchFile, MatchPlan, checked, read_addresses, read_strategy_alone};
use crate::lab::experiment::{ExperimentFile, ExperimentPlan};
use crate::lab::scenario::{ScenarioFile, ScenarioPlan, ScenarioRef};
use crate::lab::tune::{TuningFile, TuningPlan};
use crate::pitch::Pitch;
use crate::robot::{RobotKind, Sensing};
use crate::strategy::StrategyFile;
use crate::vision::CameraCalibration;

/// The kind of a file: the one that has most of the fields in it. So a file with a fault is told from another, too.
///
/// # Errors
/// If the text cannot be told into fields, or may be of several kinds or of none.
pub fn kind_of(source: &Source) -> Result<AssetKind, DataError> {
    let written = match source.top_level()? {
        TopLevel::Struct(fields) => fields,
        TopLevel::Map(_) => return Ok(AssetKind::Addresses),
        TopLevel::Other => Vec::new(),
    };
    let known = AssetKind::ALL.map(|kind| {
        let fields = fields_of(kind);
        (written.iter().filter(|field| fields.contains(field)).count(), kind)
    });
    let most = known.iter().map(|(count, _)| *count).max().filter(|count| *count > 0);
    let mut best = known.iter().filter(|(count, _)| Some(*count) == most);
    match (best.next(), best.next()) {
        (Some((_, kind)), None) => Ok(*kind),
        _ => {
            let kinds = AssetKind::ALL.map(|kind| kind.to_string()).join(", ");
            Err(DataError::new(&source.path, format!("its fields do not say what it is; there are: {kinds}")))
        }
    }
}

/// The fields that files of a kind have at their outside; none for a table.
fn fields_of(kind: AssetKind) -> &'static [&'static str] {
    match kind {
        AssetKind::Strategy => field_names::<StrategyFile>(),
        AssetKind::Scenario => field_names::<ScenarioFile>(),
        AssetKind::Match => field_names::<MatchFile>(),
        AssetKind::Pitch => field_names::<Pitch>(),
        AssetKind::Robot => field_names::<RobotKind>(),
        AssetKind::Sensing => field_names::<Sensing>(),
        AssetKind::Camera => field_names::<CameraCalibration>(),
        AssetKind::Radio => field_names::<Radio>(),
        AssetKind::Experiment => field_names::<ExperimentFile>(),
        AssetKind::Tuning => field_names::<TuningFile>(),
        AssetKind::Addresses => &[],
    }
}

/// Reads a file of a kind, and the files that it rests on; scenarios are to be played, each variant of its own.
///
/// # Errors
/// The first fault, with its place.
pub fn read(
    assets: &AssetFolder,
    kind: AssetKind,
    file: &ScenarioRef,
) -> Result<Vec<ScenarioPlan>, DataError> {
    let path = &file.path;
    match kind {
        AssetKind::Scenario => return ScenarioPlan::read_all(assets, file),
        AssetKind::Strategy => drop(read_strategy_alone(assets, path)?),
        AssetKind::Match => {
            MatchPlan::read_file(assets, path, &Choice::default())?;
        }
        AssetKind::Pitch => drop(checked::<Pitch>(assets, path)?),
        AssetKind::Robot => drop(checked::<RobotKind>(assets, path)?),
        AssetKind::Sensing => drop(checked::<Sensing>(assets, path)?),
        AssetKind::Camera => drop(checked::<CameraCalibration>(assets, path)?),
        AssetKind::Radio => drop(checked::<Radio>(assets, path)?),
        AssetKind::Experiment => drop(ExperimentPlan::read_file(assets, path)?),
        AssetKind::Tuning => drop(TuningPlan::read_file(assets, path)?),
        AssetKind::Addresses => drop(read_addresses(assets, path)?),
    }
    Ok(Vec::new())
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use proptest::prelude::*;
    use proptest::strategy::Strategy;

    use super::{AssetFolder, AssetKind, DataError, Source, read};

    fn kind_of(path: &Path) -> Result<AssetKind, DataError> {
        super::kind_of(&Source::read(path)?)
    }

    fn shipped() -> AssetFolder {
        AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"))
    }

    #[test]
    fn every_shipped_file_is_told_to_be_of_the_kind_of_its_folder() {
        for kind in AssetKind::ALL {
            for path in shipped().files(kind).unwrap() {
                assert_eq!(kind_of(&path), Ok(kind), "{}", path.display());
            }
        }
    }

    /// A shipped file with a piece of its text taken out, doubled, or replaced by a few bytes.
    fn mutated() -> impl Strategy<Value = (PathBuf, Vec<u8>)> {
        let files: Vec<PathBuf> =
            AssetKind::ALL.into_iter().flat_map(|kind| shipped().files(kind).unwrap()).collect();
        let piece = prop_oneof![
            prop::collection::vec(any::<u8>(), 0..4),
            "[\\[\\](){},:\"'\\\\#!/* \\n-]{1,3}|1e999|NaN|-0|0x|r#\"|\u{feff}|é"
                .prop_map(String::into_bytes),
        ];
        let places = (any::<prop::sample::Index>(), 0_usize..40, any::<prop::sample::Index>());
        (prop::sample::select(files), places, piece, 0..3).prop_map(|(path, (at, length, to), piece, way)| {
            let mut bytes = std::fs::read(&path).unwrap();
            let start = at.index(bytes.len());
            let range = start..(start + length).min(bytes.len());
            let removed: Vec<u8> = match way {
                0 => bytes.splice(range, piece).collect(),
                _ => bytes[range].to_vec(),
            };
            if way == 2 {
                let to = to.index(bytes.len() + 1);
                bytes.splice(to..to, removed);
            } else if way == 1 {
                bytes.splice(start..start, removed);
            }
            (path, bytes)
        })
    }

    proptest! {
        #[test]
        fn a_damaged_file_is_read_or_told_in_one_line_that_names_it((path, bytes) in mutated()) {
            let kind = kind_of(&path).unwrap();
            let folder = tempfile::tempdir().unwrap();
            let damaged = folder.path().join(path.file_name().unwrap());
            std::fs::write(&damaged, &bytes).unwrap();
            let lines = bytes.iter().filter(|byte| **byte == b'\n').count() + 1;
            // Its kind may have become another.
            let kinds = [kind_of(&damaged), Ok(kind)];
            for error in kinds.into_iter().filter_map(|kind| read(&shipped(), kind.ok()?, &damaged.clone().into()).err()) {
                prop_assert_eq!(error.to_string().lines().count(), 1);
                // A sound match may name a strategy that does not do for it.
                prop_assert!(error.path == damaged || error.path.starts_with(shipped().root()), "{}", error);
                prop_assert!(error.path != damaged || error.line.is_none_or(|line| line <= lines), "{}", error);
            }
        }
    }

    #[test]
    fn comments_strings_and_blanks_do_not_matter_and_a_fault_inside_does_not_either() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.ron");
        let kind = |text: &str| {
            std::fs::write(&path, text).unwrap();
            kind_of(&path).map_err(|error| error.message)
        };
        let strategy = "// expect: (\n(name: \"a\", description: \"expect: []\", players: [], machines: {)";
        assert_eq!(kind(strategy), Ok(AssetKind::Strategy));
        assert_eq!(kind("(name : \"a\", seconds : 1, expect : [oops])"), Ok(AssetKind::Scenario));
        assert_eq!(kind("(name: \"a\", latency: (, los: )"), Ok(AssetKind::Radio));
        assert_eq!(kind("{\"home 0\": 7"), Ok(AssetKind::Addresses));
        let kinds = "strategy, scenario, match, pitch, robot, sensing preset, camera, radio, experiment, tuning, table of addresses";
        let unknown = Err(format!("its fields do not say what it is; there are: {kinds}"));
        for text in ["(name: \"a\")", "()", "(colour: Red)", "[package]", "7"] {
            assert_eq!(kind(text), unknown, "{text}");
        }
        assert_eq!(kind(" "), Err("the file is empty".into()));
    }
}
