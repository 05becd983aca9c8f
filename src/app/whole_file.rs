//! Writing a result to a file, whole or not at all.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// Says before a long calculation whether a file could be written after it.
///
/// # Errors
/// If it could not.
pub(super) fn check_writable(path: &Path) -> io::Result<()> {
    match Destination::of(path)? {
        Destination::Stream => Ok(()),
        Destination::File { path, .. } => draft_beside(&path).map(drop),
    }
}

/// Writes a file: under another name first, which becomes its own when all is written.
///
/// # Errors
/// If it cannot be written. Then what was there before is still there.
pub(super) fn write_whole(path: &Path, content: &[u8]) -> io::Result<()> {
    let Destination::File { path, known } = Destination::of(path)? else { return fs::write(path, content) };
    let mut draft = draft_beside(&path)?;
    // By way of the draft itself an error would name it, which is gone then.
    draft.as_file_mut().write_all(content)?;
    if let Some(known) = known {
        draft.as_file().set_permissions(known.permissions())?;
    }
    draft.as_file().sync_all()?;
    draft.persist(path).map(drop).map_err(|refused| refused.error)
}

enum Destination {
    /// A file to come, or one to replace, with what is known of it.
    File { path: PathBuf, known: Option<Metadata> },
    /// A device or a pipe, which takes what is written as it comes.
    Stream,
}

impl Destination {
    fn of(path: &Path) -> io::Result<Destination> {
        match fs::metadata(path) {
            Ok(known) if known.is_dir() => Err(ErrorKind::IsADirectory.into()),
            Ok(known) if known.is_file() => {
                OpenOptions::new().append(true).open(path)?;
                Ok(Destination::File { path: path.canonicalize()?, known: Some(known) })
            }
            Ok(_) => Ok(Destination::Stream),
            Err(error) if error.kind() == ErrorKind::NotFound => {
                Ok(Destination::File { path: path.to_owned(), known: None })
            }
            Err(error) => Err(error),
        }
    }
}

/// A file in the same folder that is gone when it is dropped.
fn draft_beside(path: &Path) -> io::Result<NamedTempFile> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    // As for any new file, the user's mask decides who may read it.
    tempfile::Builder::new().make_in(folder, |path| File::options().write(true).create_new(true).open(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_whole_and_nothing_is_left_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("report.xml");
        for content in ["first", "second, longer", "third"] {
            write_whole(&path, content.as_bytes()).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), content);
        }
        check_writable(&path).unwrap();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn what_cannot_be_written_is_known_beforehand() {
        let folder = tempfile::tempdir().unwrap();
        for path in [folder.path().to_owned(), folder.path().join("missing/report.xml")] {
            assert!(check_writable(&path).is_err(), "{}", path.display());
            assert!(write_whole(&path, b"x").is_err(), "{}", path.display());
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_replaced_file_keeps_its_place_behind_a_link_and_its_permissions() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (path, link) = (folder.path().join("report.xml"), folder.path().join("link.xml"));
        fs::write(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        symlink(&path, &link).unwrap();
        write_whole(&link, b"new").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
        assert!(link.is_symlink());
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
    }
}
