//! Effects on the file system and the clipboard.

use std::path::{Component, Path, PathBuf};

use crossterm::Command;
use crossterm::clipboard::CopyToClipboard;

use super::{Readers, bounded, new_file};
use crate::fit::decoded;

/// The destination of copies besides the clipboard: terminals do not report whether they accept a copy.
#[derive(Default)]
pub struct Files {
    /// The file with the last copy; `None` if copies are not saved.
    pub copies: Option<PathBuf>,
    /// Whether a keystroke file that is played may write files.
    pub may_play_write: bool,
    /// The only folder in which it then may, if there is one.
    pub folder: Option<PathBuf>,
}

impl Files {
    /// The sequence that puts a text on the terminal's clipboard: OSC 52.
    pub fn clipboard(text: &str) -> String {
        let mut sequence = String::new();
        // Writing to a string cannot fail.
        let _ = CopyToClipboard::to_clipboard_from(text).write_ansi(&mut sequence);
        sequence
    }

    /// Saves a copy; says so, or why it is not saved.
    pub fn copy(&self, text: &str) -> Result<String, String> {
        /// Length in characters up to which the line quotes the text.
        const SHORT: usize = 60;
        let told = if text.chars().count() <= SHORT && !text.contains('\n') {
            text
        } else {
            ""
        };
        let sent = format!("{told} sent to the terminal's clipboard").trim_start().to_owned();
        let Some(path) = &self.copies else { return Ok(sent) };
        let told = |line| format!("{sent}; {line}");
        Files::write(path, text, true, Readers::Owner).map(told).map_err(told)
    }

    /// Where a file of this name is written, also when a keystroke file asks for it. Fails with one line if that lies outside
    /// of the folder to which all are written.
    pub fn place(&self, path: &Path) -> Result<PathBuf, String> {
        let Some(folder) = &self.folder else { return Ok(path.to_owned()) };
        if !path.components().all(|part| matches!(part, Component::Normal(_))) {
            return Err(format!(
                "{} not written: it is not in {}",
                path.display(),
                folder.display()
            ));
        }
        Ok(folder.join(path))
    }

    /// Whether a file may be written. Fails with one line if it exists and is not to be replaced, or is not a
    /// regular file.
    pub fn admit(path: &Path, replace: bool) -> Result<(), String> {
        let path = at_home(path);
        let name = path.display();
        match std::fs::metadata(&path) {
            Ok(found) if !found.is_file() => Err(format!("{name} is not a file")),
            Ok(_) if !replace => Err(format!("{name} already exists; add ! to overwrite")),
            _ => Ok(()),
        }
    }

    /// Writes a file; an existing one is replaced only on demand. Says so in one line, or fails with one.
    pub fn write(
        path: &Path,
        content: impl AsRef<[u8]>,
        replace: bool,
        readers: Readers,
    ) -> Result<String, String> {
        Files::admit(path, replace)?;
        let path = at_home(path);
        let written = new_file::write(&path, content.as_ref(), readers, None);
        written.map(|()| format!("written to {}", path.display())).map_err(|why| why.to_string())
    }

    /// The text of a file. Fails with one line that names the file and says why there is no text.
    pub fn read(path: &Path) -> Result<String, String> {
        let path = at_home(path);
        // A pipe without a writer would block the loop.
        if std::fs::metadata(&path).is_ok_and(|found| !found.is_file()) {
            return Err(format!("{}: not a file", path.display()));
        }
        bounded::bytes(&path).map(|bytes| decoded(&bytes)).map_err(|why| why.to_string())
    }

    /// Puts a kept session aside: it is not offered again, but remains until the next one is put aside.
    pub fn put_aside(path: &Path) {
        drop(std::fs::rename(path, path.with_file_name("last.toml")));
    }
}

/// A path in which a leading `~/` is the user's home, as in the shell.
pub(super) fn at_home(path: &Path) -> PathBuf {
    match (path.strip_prefix("~"), std::env::home_dir()) {
        (Ok(rest), Some(home)) => home.join(rest),
        _ => path.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_is_also_in_a_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("copy.txt");
        let files = Files { copies: Some(path.clone()), ..Files::default() };
        assert!(files.copy("q = 1").unwrap().contains("copy.txt"));
        assert_eq!(std::fs::read_to_string(path).unwrap(), "q = 1");
        assert_eq!(Files::clipboard("q = 1"), "\x1b]52;c;cSA9IDE=\x1b\\");
    }

    #[test]
    fn a_file_that_cannot_be_written_is_told_by_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("no/such/folder");
        let refused = Files::write(&path, "", true, Readers::Owner).unwrap_err();
        assert!(refused.contains("no/such/folder"), "{refused}");
    }

    #[test]
    fn a_file_that_is_there_is_replaced_only_on_demand_and_nothing_else_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("session.toml");
        let write = |text, replace| Files::write(&path, text, replace, Readers::Owner);
        assert!(write("one", false).is_ok());
        assert!(write("two", false).unwrap_err().contains("already exists"));
        assert_eq!(Files::read(&path).unwrap(), "one");
        assert!(write("two", true).is_ok());
        assert_eq!(Files::read(&path).unwrap(), "two");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        let device = Files::write(Path::new("/dev/null"), "two", true, Readers::Owner);
        assert_eq!(device.unwrap_err(), "/dev/null is not a file");
    }
}
