//! Where the files are: the folder `assets` with one folder in it for each kind of file.

use std::ffi::{OsStr, OsString};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::error::DataError;
use super::kind::AssetKind;
use super::listing::names_in;
use super::source::Source;
use super::texts::{AssetTexts, ReadTexts};

/// The environment variable that names the folder.
const VARIABLE: &str = "TOUCHLINE_ASSETS";

/// A folder with a folder for each kind of file, such as `strategies` and `pitches`: on the disk, or the texts that were once
/// read from there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AssetFolder {
    root: PathBuf,
    /// Its files, if they are not on the disk.
    kept: Option<Arc<AssetTexts>>,
    /// Files that are other than there.
    changed: Arc<AssetTexts>,
    notes: ReadTexts,
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
        AssetFolder { root: root.into(), kept: None, changed: Arc::default(), notes: ReadTexts::default() }
    }

    /// The folder that was at `root` when these files were read: those that matter, in it and elsewhere.
    pub fn kept(root: impl Into<PathBuf>, texts: AssetTexts) -> AssetFolder {
        AssetFolder { kept: Some(Arc::new(texts)), ..AssetFolder::new(root) }
    }

    /// The same folder, and what is read from here on through it and its copies.
    pub fn noting(&self) -> (AssetFolder, ReadTexts) {
        let notes = ReadTexts::default();
        (AssetFolder { notes: notes.clone(), ..self.clone() }, notes)
    }

    /// The same folder, with these files in place of those that are there.
    pub fn with_texts(&self, texts: AssetTexts) -> AssetFolder {
        let changed = AssetTexts::clone(&self.changed).into_iter().chain(texts).collect();
        AssetFolder { changed: Arc::new(changed), ..self.clone() }
    }

    /// Reads a file, in the folder or elsewhere.
    ///
    /// # Errors
    /// As [`Source::read`].
    pub fn read(&self, path: &Path) -> Result<Source, DataError> {
        let source = match &self.kept {
            _ if self.changed.contains_key(path) => Source::new(path, &self.changed[path]),
            None => Source::read(path)?,
            Some(texts) => {
                let text =
                    texts.get(path).ok_or_else(|| DataError::new(path, "was not kept with the match"))?;
                Source::new(path, text)
            }
        };
        self.notes.note(&source.path, &source.text);
        Ok(source)
    }

    /// Whether there is such a file.
    pub fn has_file(&self, path: &Path) -> bool {
        let is_there = || self.kept.as_ref().map_or_else(|| path.is_file(), |texts| texts.contains_key(path));
        self.changed.contains_key(path) || is_there()
    }

    /// The folder itself.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// The file that a name stands for. A [path](is_path) is taken as it is; another name is that of a file of the kind,
    /// `hammerheads_2001` for `<root>/strategies/hammerheads_2001.ron`, or else of a file that is there under just that
    /// name. The file need not exist.
    pub fn file(&self, kind: AssetKind, name: &str) -> PathBuf {
        let among_assets = self.root.join(kind.folder()).join(format!("{name}.ron"));
        let here = Path::new(name);
        if is_path(name) || (self.has_file(here) && !self.has_file(&among_assets)) {
            here.to_owned()
        } else {
            among_assets
        }
    }

    /// The names of the files of a kind, sorted; none if the folder cannot be read.
    pub fn names(&self, kind: AssetKind) -> Vec<String> {
        let folder = self.root.join(kind.folder());
        let Some(texts) = &self.kept else { return names_in(&folder, "ron") };
        let stems =
            texts.keys().filter(|path| path.parent() == Some(&folder)).filter_map(|path| path.file_stem());
        stems.filter_map(|stem| stem.to_str().map(str::to_owned)).collect()
    }

    /// All files of a kind, sorted.
    ///
    /// # Errors
    ///
    /// If there is a folder for the kind and it cannot be read.
    pub fn files(&self, kind: AssetKind) -> Result<Vec<PathBuf>, DataError> {
        let folder = self.root.join(kind.folder());
        let read = || -> std::io::Result<Vec<PathBuf>> {
            std::fs::read_dir(&folder)?.map(|entry| Ok(entry?.path())).collect()
        };
        let mut paths = match read() {
            Err(error) if error.kind() == ErrorKind::NotFound => Vec::new(),
            read => read.map_err(|error| DataError::new(&folder, format!("cannot be read: {error}")))?,
        };
        paths.retain(|path| path.extension().is_some_and(is_ron) && !path.is_dir());
        paths.sort();
        Ok(paths)
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

/// Whether a name is a path, rather than an asset's name: it ends in `.ron`, in letters of any size, or names a folder.
pub fn is_path(name: &str) -> bool {
    name.contains(std::path::is_separator) || Path::new(name).extension().is_some_and(is_ron)
}

fn is_ron(extension: &OsStr) -> bool {
    extension.eq_ignore_ascii_case("ron")
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_bare_name_is_a_file_of_its_kind_and_a_path_is_taken_as_it_is() {
        let assets = AssetFolder::new("assets");
        let file = |name| assets.file(AssetKind::Strategy, name);
        assert_eq!(file("hammerheads_2001"), Path::new("assets/strategies/hammerheads_2001.ron"));
        assert_eq!(file("v1.5"), Path::new("assets/strategies/v1.5.ron"));
        for path in ["/tmp/mine.ron", "mine.RON", "mine.v2.Ron", "folder/mine", "./mine"] {
            assert_eq!(file(path), Path::new(path));
        }
    }

    #[test]
    fn a_file_that_is_here_under_a_bare_name_is_taken_unless_an_asset_has_the_name() {
        let folder = tempfile::tempdir().unwrap();
        let assets = AssetFolder::new(folder.path());
        // Cargo runs tests in the package's folder.
        assert_eq!(assets.file(AssetKind::Strategy, "Cargo.toml"), Path::new("Cargo.toml"));
        assert_eq!(assets.file(AssetKind::Strategy, "src"), folder.path().join("strategies/src.ron"));
        let asset = folder.path().join("strategies/Cargo.toml.ron");
        fs::create_dir(folder.path().join("strategies")).unwrap();
        fs::write(&asset, "()").unwrap();
        assert_eq!(assets.file(AssetKind::Strategy, "Cargo.toml"), asset);
    }

    #[test]
    fn names_are_sorted_and_only_of_ron_files() {
        let folder = tempfile::tempdir().unwrap();
        let kind = folder.path().join("pitches");
        fs::create_dir_all(kind.join("folder.ron")).unwrap();
        for name in ["small.ron", "large.ron", "LOUD.RON", "notes.txt", "ron"] {
            fs::write(kind.join(name), "()").unwrap();
        }
        fs::write(folder.path().join("robots"), "no folder").unwrap();
        let assets = AssetFolder::new(folder.path());
        assert_eq!(assets.names(AssetKind::Pitch), ["large", "small"]);
        assert_eq!(assets.names(AssetKind::Robot), Vec::<String>::new());
        let files = ["LOUD.RON", "large.ron", "small.ron"].map(|name| kind.join(name));
        assert_eq!(assets.files(AssetKind::Pitch), Ok(files.to_vec()));
        assert_eq!(assets.files(AssetKind::Radio), Ok(Vec::new()));
        let error = assets.files(AssetKind::Robot).unwrap_err();
        assert!(error.message.starts_with("cannot be read: "), "{error}");
    }

    #[test]
    fn a_changed_text_is_read_in_place_of_the_file_and_noted() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("radios/good.ron");
        fs::create_dir(folder.path().join("radios")).unwrap();
        fs::write(&path, "(loss: 0.1)").unwrap();
        let assets = AssetFolder::new(folder.path());
        let changed = assets.with_texts([(path.clone(), "(loss: 0.9)".to_owned())].into());
        let (changed, notes) = changed.noting();
        assert_eq!(changed.read(&path).unwrap().text, "(loss: 0.9)");
        assert_eq!(notes.texts()[&path], "(loss: 0.9)");
        assert_eq!(assets.read(&path).unwrap().text, "(loss: 0.1)");
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
