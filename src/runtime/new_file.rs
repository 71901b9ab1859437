//! The one way in which a file gets new content: written beside the old file, synced, then renamed over it. So
//! the file is at any moment complete, as it was or as it is to be, also on a full disk.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::{Failure, system};
use tempfile::TempPath;

/// Maximum number of symbolic links that are followed one after the other, as in the system.
const LINKS: usize = 40;

/// The file beside another one that has this ending behind its name.
pub fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    name.into()
}

/// Who may read a file that was not there before.
#[derive(Clone, Copy, PartialEq)]
pub enum Readers {
    /// Whoever the user's umask allows.
    Usual,
    /// The user alone.
    Owner,
}

/// Content on its way into a file. Dropped before [`NewFile::end`], it leaves the file as it was.
pub struct NewFile {
    /// The file that is replaced, behind all symbolic links.
    path: PathBuf,
    /// The temporary file; `None` for a device or a pipe, which is written to directly.
    beside: Option<TempPath>,
    file: File,
}

impl NewFile {
    /// Begins to replace a file, or to write to a device or pipe. Fails if the file or its folder may not be
    /// written, or nobody reads from the pipe.
    pub fn begin(path: &Path, readers: Readers) -> io::Result<NewFile> {
        let path = behind_links(path)?;
        let old = match fs::metadata(&path) {
            Ok(old) => Some(old),
            Err(why) if why.kind() == ErrorKind::NotFound => None,
            Err(why) => return Err(why),
        };
        if !is_regular(&path) {
            return Ok(NewFile { file: system::device(&path)?, path, beside: None });
        }
        if old.is_some() {
            // The folder alone does not decide: a file that may not be written is not replaced either.
            OpenOptions::new().write(true).open(&path)?;
        }
        let is_usual = old.is_none() && readers == Readers::Usual;
        let (file, beside) = temporary(&path, if is_usual { 0o666 } else { 0o600 })?;
        let this = NewFile { path, beside: Some(beside), file };
        if let Some(old) = old {
            system::give(&this.file, &old);
            this.file.set_permissions(old.permissions())?;
        }
        Ok(this)
    }

    /// Gives the content its name. Fails with [`ErrorKind::AlreadyExists`] if the file holds something else and
    /// may not be replaced.
    pub fn end(mut self, replace: bool) -> io::Result<()> {
        let Some(beside) = self.beside.take() else { return self.file.flush() };
        if !replace && !is_free(&self.path, &beside)? {
            return Err(ErrorKind::AlreadyExists.into());
        }
        self.file.sync_all()?;
        beside.persist(&self.path)?;
        // The file is complete under either name; a folder that cannot be synced is no error.
        drop(File::open(folder(&self.path)).and_then(|folder| folder.sync_all()));
        Ok(())
    }
}

impl Write for NewFile {
    fn write(&mut self, content: &[u8]) -> io::Result<usize> {
        self.file.write(content)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Writes a whole file. If `keep` is given, fails where the file holds something else: `keep` says how that can be
/// replaced. Also fails if the file cannot be written.
pub fn write(
    path: &Path,
    content: &[u8],
    readers: Readers,
    keep: Option<&str>,
) -> Result<(), Failure> {
    let written = NewFile::begin(path, readers)
        .and_then(|mut file| file.write_all(content).and_then(|()| file.end(keep.is_none())));
    written.map_err(|error| Failure::not_replaced(path, &error, keep))
}

/// Writes into a file that is open, from an offset in bytes on.
pub(super) fn write_at(mut file: &File, content: &[u8], at: u64) -> io::Result<()> {
    file.seek(SeekFrom::Start(at))?;
    file.write_all(content)
}

/// The path at the end of symbolic links, whether there is a file or not.
fn behind_links(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..LINKS {
        match fs::read_link(&path) {
            Ok(next) if !is_open(&path) => path = folder(&path).join(next),
            _ => return Ok(path),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// Whether a path is that of a regular file or of one that is not there yet, and not of a device or a pipe.
pub fn is_regular(path: &Path) -> bool {
    let is_device = |path: &Path| fs::metadata(path).is_ok_and(|found| !found.is_file());
    behind_links(path).is_ok_and(|path| !is_open(&path) && !is_device(&path))
}

/// Whether a path stands for what a process has open, as /dev/stdout does: that need not have a name, and is
/// written to where it is.
fn is_open(path: &Path) -> bool {
    path.starts_with("/proc") || path.starts_with("/dev/fd")
}

fn folder(path: &Path) -> &Path {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    folder.unwrap_or(Path::new("."))
}

/// Creates a file beside this one, under a name that is free and short enough.
fn temporary(path: &Path, mode: u32) -> io::Result<(File, TempPath)> {
    if path.file_name().is_none() {
        return Err(ErrorKind::IsADirectory.into());
    }
    let mut names = tempfile::Builder::new();
    names.prefix(".hopfscope.").suffix(".new");
    Ok(names.make_in(folder(path), |path| system::create(path, mode))?.into_parts())
}

/// Whether nothing is lost when the new content takes this path: the file is missing, empty, or holds the same.
fn is_free(path: &Path, beside: &Path) -> io::Result<bool> {
    match fs::metadata(path) {
        Ok(old) if old.len() == 0 => Ok(true),
        Ok(old) if old.len() != fs::metadata(beside)?.len() => Ok(false),
        Ok(_) => {
            let [old, new] = [File::open(path)?, File::open(beside)?].map(BufReader::new);
            let mut pairs = old.bytes().zip(new.bytes());
            pairs.try_fold(true, |same, (old, new)| Ok(same && old? == new?))
        }
        Err(why) if why.kind() == ErrorKind::NotFound => Ok(true),
        Err(why) => Err(why),
    }
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};

    use super::*;

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().mode() & 0o777
    }

    #[test]
    fn a_file_keeps_its_mode_and_a_link_stays_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let [file, link] = ["file", "link"].map(|name| folder.path().join(name));
        write(&file, b"one", Readers::Owner, Some("no")).unwrap();
        assert_eq!(mode(&file), 0o600);
        fs::set_permissions(&file, PermissionsExt::from_mode(0o644)).unwrap();
        symlink("file", &link).unwrap();
        write(&link, b"two", Readers::Owner, None).unwrap();
        assert_eq!((fs::read(&file).unwrap(), mode(&file)), (b"two".to_vec(), 0o644));
        assert_eq!(fs::read_link(&link).unwrap(), Path::new("file"));
        // A link to nothing leads to a new file.
        fs::remove_file(&file).unwrap();
        write(&link, b"three", Readers::Owner, Some("no")).unwrap();
        assert_eq!((fs::read(&file).unwrap(), mode(&file)), (b"three".to_vec(), 0o600));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
        fs::remove_file(&file).unwrap();
        symlink("link", &file).unwrap();
        assert!(write(&link, b"", Readers::Usual, None).is_err(), "a circle of links");
    }

    #[test]
    fn what_is_dropped_or_not_free_leaves_the_file_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        write(&path, b"old", Readers::Usual, Some("no")).unwrap();
        NewFile::begin(&path, Readers::Usual).unwrap().write_all(b"new").unwrap();
        let refused = write(&path, b"new", Readers::Usual, Some("no")).unwrap_err();
        assert!(refused.to_string().ends_with("already exists; no"), "{refused}");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        write(&path, b"old", Readers::Usual, Some("no")).unwrap();
        write(&path, b"new", Readers::Usual, None).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        write(Path::new("/dev/null"), b"new", Readers::Usual, Some("no")).unwrap();
        assert!(write(Path::new("/dev/full"), b"new", Readers::Usual, Some("no")).is_err());
        assert!(write(folder.path(), b"new", Readers::Usual, None).is_err());
    }
}
