//! Where the files are: the folder `assets` with one folder in it for each kind of file.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::error::DataError;

/// The environment variable that names the folder.
const VARIABLE: &str = "TOUCHLINE_ASSETS";

/// A folder with a folder for each kind of file, such as `strategies` and `pitches`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AssetFolder {
    root: PathBuf,
}

impl AssetFolder {
    /// The folder that was asked for or, without one, the first that exists of: the environment variable
    /// `TOUCHLINE_ASSETS`, then `assets` in the current folder, beside the program, in the package that cargo runs and
    /// in the package that the program was built from.
    ///
    /// # Errors
    ///
    /// If there is none, and if the explicit folder or that of the variable is not a folder: neither is passed over.
    pub fn find(explicit: Option<&Path>) -> Result<AssetFolder, DataError> {
        let program = std::env::current_exe().ok();
        let package = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
        let usual = [
            Some(PathBuf::from("assets")),
            program.as_deref().and_then(Path::parent).map(|folder| folder.join("assets")),
            package.map(|package| package.join("assets")),
            Some(Path::new(env!("CARGO_MANIFEST_DIR")).join("assets")),
        ];
        AssetFolder::first_of(explicit, std::env::var_os(VARIABLE), usual.into_iter().flatten().collect())
    }

    /// The folder at `root`, which need not exist.
    pub fn new(root: impl Into<PathBuf>) -> AssetFolder {
        AssetFolder { root: root.into() }
    }

    /// The folder itself.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// The file of a kind with a name: `hammerheads_2001` is `<root>/<kind>/hammerheads_2001.ron`, whereas a name that
    /// ends in `.ron` is a path and taken as it is. The file need not exist.
    pub fn file(&self, kind: &str, name: &str) -> PathBuf {
        if name.ends_with(".ron") {
            PathBuf::from(name)
        } else {
            self.root.join(kind).join(format!("{name}.ron"))
        }
    }

    /// The names of the files of a kind, sorted; none if the folder cannot be read.
    pub fn names(&self, kind: &str) -> Vec<String> {
        names_in(&self.root.join(kind), "ron")
    }

    fn first_of(
        explicit: Option<&Path>,
        variable: Option<OsString>,
        usual: Vec<PathBuf>,
    ) -> Result<AssetFolder, DataError> {
        if let Some(root) = explicit {
            return AssetFolder::existing(root, "no such folder");
        }
        if let Some(root) = variable.filter(|root| !root.is_empty()) {
            return AssetFolder::existing(
                Path::new(&root),
                &format!("no such folder, though {VARIABLE} names it"),
            );
        }
        if let Some(root) = usual.iter().find(|root| root.is_dir()) {
            return Ok(AssetFolder::new(root));
        }
        let tried: Vec<String> = usual.iter().map(|root| root.display().to_string()).collect();
        let message = format!("no such folder; tried: {}; {VARIABLE} may name another", tried.join(", "));
        Err(DataError::new("assets", message))
    }

    fn existing(root: &Path, otherwise: &str) -> Result<AssetFolder, DataError> {
        if root.is_dir() { Ok(AssetFolder::new(root)) } else { Err(DataError::new(root, otherwise)) }
    }
}

/// The names without extension of the files in a folder that have the extension, sorted; none if it cannot be read.
pub(super) fn names_in(folder: &Path, extension: &str) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut names: Vec<String> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|it| it == extension) && path.is_file())
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    names
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_bare_name_is_a_file_of_its_kind_and_a_path_is_taken_as_it_is() {
        let assets = AssetFolder::new("assets");
        assert_eq!(
            assets.file("strategies", "hammerheads_2001"),
            Path::new("assets/strategies/hammerheads_2001.ron")
        );
        assert_eq!(assets.file("strategies", "v1.5"), Path::new("assets/strategies/v1.5.ron"));
        assert_eq!(assets.file("strategies", "/tmp/mine.ron"), Path::new("/tmp/mine.ron"));
    }

    #[test]
    fn names_are_sorted_and_only_of_ron_files() {
        let folder = tempfile::tempdir().unwrap();
        let kind = folder.path().join("pitches");
        fs::create_dir_all(kind.join("folder.ron")).unwrap();
        for name in ["small.ron", "large.ron", "notes.txt", "ron"] {
            fs::write(kind.join(name), "()").unwrap();
        }
        let assets = AssetFolder::new(folder.path());
        assert_eq!(assets.names("pitches"), ["large", "small"]);
        assert_eq!(assets.names("robots"), Vec::<String>::new());
    }

    #[test]
    fn the_explicit_folder_comes_before_the_variable_and_that_before_the_usual_ones() {
        let folder = tempfile::tempdir().unwrap();
        let make = |name: &str| {
            let path = folder.path().join(name);
            fs::create_dir(&path).unwrap();
            path
        };
        let [explicit, variable, usual] = [make("explicit"), make("variable"), make("usual")];
        let all = vec![folder.path().join("absent"), usual.clone()];
        let find = |explicit: Option<&Path>, variable: Option<&Path>| {
            AssetFolder::first_of(explicit, variable.map(OsString::from), all.clone()).unwrap().root
        };
        assert_eq!(find(Some(&explicit), Some(&variable)), explicit);
        assert_eq!(find(None, Some(&variable)), variable);
        assert_eq!(find(None, None), usual);
        assert_eq!(find(None, Some(Path::new(""))), usual);
    }

    #[test]
    fn a_folder_that_was_asked_for_and_does_not_exist_is_an_error() {
        let here = vec![PathBuf::from(".")];
        let error = AssetFolder::first_of(Some(Path::new("/no/such")), None, here.clone()).unwrap_err();
        assert_eq!(error.to_string(), "/no/such: no such folder");
        let error = AssetFolder::first_of(None, Some("/no/such".into()), here).unwrap_err();
        assert_eq!(error.to_string(), "/no/such: no such folder, though TOUCHLINE_ASSETS names it");
    }

    #[test]
    fn without_any_folder_the_error_says_which_were_tried() {
        let error = AssetFolder::first_of(None, None, vec!["/no/a".into(), "/no/b".into()]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "assets: no such folder; tried: /no/a, /no/b; TOUCHLINE_ASSETS may name another"
        );
    }
}
