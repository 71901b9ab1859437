//! What the session asks of the file system and the clipboard.

use std::path::{Path, PathBuf};

use crossterm::Command;
use crossterm::clipboard::CopyToClipboard;

use crate::session::Notice;

/// Where copies go, since no terminal says whether it took one.
#[derive(Clone, Debug, Default)]
pub struct Files {
    /// The file that holds the last copy; `None`: none is kept.
    pub copies: Option<PathBuf>,
}

impl Files {
    /// The sequence that puts a text on the terminal's clipboard: OSC 52.
    #[must_use]
    pub fn clipboard(text: &str) -> String {
        let mut sequence = String::new();
        // A string takes any text: this cannot fail.
        let _ = CopyToClipboard::to_clipboard_from(text).write_ansi(&mut sequence);
        sequence
    }

    /// Keeps a copy, and says what became of it.
    #[must_use]
    pub fn copy(&self, text: &str) -> Notice {
        let sent = "sent to the terminal's clipboard".to_owned();
        match &self.copies {
            None => Notice { error: false, text: sent },
            Some(path) => {
                let Notice { error, text } = Files::write(path, text);
                Notice { error, text: format!("{sent}; {text}") }
            }
        }
    }

    /// Writes a file, and says how that ended.
    #[must_use]
    pub fn write(path: &Path, text: &str) -> Notice {
        let name = path.display();
        match std::fs::write(path, text) {
            Ok(()) => Notice { error: false, text: format!("written to {name}") },
            Err(why) => Notice { error: true, text: format!("{name} not written: {why}") },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_is_also_in_a_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("copy.txt");
        let files = Files { copies: Some(path.clone()) };
        let notice = files.copy("q = 1");
        assert!(!notice.error && notice.text.contains("copy.txt"), "{notice:?}");
        assert_eq!(std::fs::read_to_string(path).unwrap(), "q = 1");
        assert_eq!(Files::clipboard("q = 1"), "\x1b]52;c;cSA9IDE=\x1b\\");
    }

    #[test]
    fn a_file_that_cannot_be_written_is_told_by_name() {
        let folder = tempfile::tempdir().unwrap();
        let notice = Files::write(&folder.path().join("no/such/folder"), "");
        assert!(notice.error && notice.text.contains("no/such/folder"), "{notice:?}");
    }
}
