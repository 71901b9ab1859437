//! Effects: what a session asks of the outer rings.

use std::path::{Path, PathBuf};

use crate::session::{Purpose, Script};

/// Nothing, or one line that says why a command was refused.
pub type Done = Result<(), String>;

/// An effect for the outer rings; `update` itself touches nothing outside the session.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// End the program with exit code 0.
    Quit,
    /// Stop the process as Ctrl-Z does; repaint when it continues.
    Suspend,
    /// Repaint everything, because the screen may be disturbed.
    Repaint,
    /// Play these keys, as if they were typed, before anything else.
    Play(Script),
    /// Turn mouse reports of the terminal on or off.
    Mouse(bool),
    /// Put this text on the clipboard (OSC 52) and into a file beside the session.
    Copy(String),
    /// Put the characters on the screen there, too.
    CopyScreen,
    /// Write a complete file; the outcome comes back as a notice.
    Write {
        path: PathBuf,
        text: String,
        /// Whether an existing file may be replaced.
        replace: bool,
    },
    /// Write all input since the start as a keystroke file.
    Record {
        path: PathBuf,
        /// Number of presses at the end that are left out.
        forget: u32,
        /// Whether an existing file may be replaced.
        replace: bool,
    },
    /// Write a figure of plots, in the format that the file's extension asks for. `Msg::Written` comes back at
    /// the end.
    Figure {
        path: PathBuf,
        /// The plot; `None` for all that are on show.
        plot: Option<usize>,
        /// Whether an existing file may be replaced.
        replace: bool,
    },
    /// Stop the figure in progress.
    StopWriting,
    /// Read a file; its text comes back as `Msg::Read`.
    Read { path: PathBuf, purpose: Purpose },
    /// Put the kept file of an interrupted session aside, so that it is not offered again.
    PutAside(PathBuf),
    /// Write the rows of a scan to a file, in the form given by its extension; a file of another scan is left
    /// alone. The outcome comes back as a notice.
    SaveScan {
        path: PathBuf,
        scan: std::sync::Arc<crate::scan::grid::Scan>,
        /// Its rows, beginning with the first point.
        rows: Vec<crate::scan::grid::ScanRow>,
    },
}

impl Effect {
    /// The file that it writes, if it writes one.
    pub fn writes(&self) -> Option<&Path> {
        match self {
            Effect::Write { path, .. }
            | Effect::Record { path, .. }
            | Effect::Figure { path, .. }
            | Effect::SaveScan { path, .. } => Some(path),
            _ => None,
        }
    }
}
