//! Calibrations as files among the assets.

use std::path::PathBuf;

use crate::app::whole_file::write_whole;
use crate::data::{AssetFolder, AssetKind, Source, in_one_line, ron_options};
use crate::vision::CameraCalibration;

/// Writes a calibration to the file of a name among the cameras, and says where that is.
///
/// # Errors
/// If there cannot be a file of the name, or it cannot be written; in one line.
pub fn save(assets: &AssetFolder, name: &str, calibration: &CameraCalibration) -> Result<PathBuf, String> {
    let path = path_of(assets, name)?;
    let refused = |error: &dyn std::fmt::Display| {
        in_one_line(&format!("{}: cannot be written: {error}", path.display()))
    };
    let text = ron_options()
        .to_string_pretty(calibration, ron::ser::PrettyConfig::default())
        .map_err(|error| refused(&error))?;
    let folder = path.parent().map_or(Ok(()), std::fs::create_dir_all);
    folder.and_then(|()| write_whole(&path, (text + "\n").as_bytes())).map_err(|error| refused(&error))?;
    Ok(path)
}

/// Reads the calibration of a name.
///
/// # Errors
/// If there is none, or it is damaged; in one line.
pub fn load(assets: &AssetFolder, name: &str) -> Result<CameraCalibration, String> {
    let source = Source::read(&path_of(assets, name)?).map_err(|error| error.to_string())?;
    source.parse_sound().map_err(|error| error.to_string())
}

/// Where the file of a name is. A name is one of a file among the cameras and no path, so that nothing else is overwritten.
fn path_of(assets: &AssetFolder, name: &str) -> Result<PathBuf, String> {
    let is_plain = |sign: char| sign.is_alphanumeric() || "_-".contains(sign);
    if name.is_empty() || !name.chars().all(is_plain) {
        return Err(format!("`{name}` cannot be the name of a camera: take letters, digits, _ and -"));
    }
    Ok(assets.root().join(AssetKind::Camera.folder()).join(format!("{name}.ron")))
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;

    #[test]
    fn a_saved_calibration_is_read_as_it_was() {
        let folder = tempfile::tempdir().expect("a folder");
        let assets = AssetFolder::new(folder.path());
        let calibration = samples::calibration();
        let path = save(&assets, "mine", &calibration).expect("it is written");
        assert_eq!(path, assets.file(AssetKind::Camera, "mine"));
        assert_eq!(load(&assets, "mine"), Ok(calibration));
    }

    #[test]
    fn what_cannot_be_written_or_read_is_one_line_and_names_its_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let assets = AssetFolder::new(folder.path());
        std::fs::write(folder.path().join("cameras"), "no folder").expect("a file");
        let told = save(&assets, "mine", &samples::calibration()).expect_err("there is no such folder");
        assert!(told.contains("mine.ron: cannot be written") && !told.contains('\n'), "{told}");
        let told = load(&assets, "mine").expect_err("there is no such file");
        assert!(told.contains("mine.ron") && !told.contains('\n'), "{told}");
    }

    #[test]
    fn a_name_leads_nowhere_but_to_the_cameras() {
        let folder = tempfile::tempdir().expect("a folder");
        let assets = AssetFolder::new(folder.path());
        for name in ["", "../strategies/mine", "/tmp/mine", "mine.ron", "a b"] {
            let told = save(&assets, name, &samples::calibration()).expect_err("it is no name");
            assert!(told.contains(&format!("`{name}`")), "{told}");
        }
    }
}
