//! What a session asks of the outer rings; changing a session itself touches nothing outside.

use std::path::PathBuf;

use crate::session::message::Purpose;
use crate::session::replay::script::Script;

/// What a line has done, or one line that says why not.
pub type Done = Result<Vec<Effect>, String>;

/// What a session asks of the outer rings; `update` itself touches nothing.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// End the program with exit code 0.
    Quit,
    /// Stop the process as Ctrl-Z does; repaint when it continues.
    Suspend,
    /// Repaint everything (the screen may be disturbed).
    Repaint,
    /// Play these keys, as if they were typed, before anything else.
    Play(Script),
    /// The same with the keys of a register: what the user types meanwhile comes after them.
    PlayRegister(Script),
    /// Have the terminal report the mouse, or leave it alone.
    Mouse(bool),
    /// Put this text on the clipboard (OSC 52) and into a file beside the session.
    Copy(String),
    /// Do the same with the characters on the screen.
    CopyScreen,
    /// Write a file as a whole; the outcome comes back as a message line.
    Write {
        path: PathBuf,
        text: String,
        /// Whether a file that is there may be replaced.
        replace: bool,
    },
    /// Write what was pressed since the start as a keystroke file.
    Record {
        path: PathBuf,
        /// How many presses at the end are not part of it.
        forget: u32,
        /// Whether a file that is there may be replaced.
        replace: bool,
    },
    /// Write what plots show as a figure; the ending of the file says in which form. `Msg::Written` comes
    /// back when that has ended.
    Figure {
        path: PathBuf,
        /// The plot; `None`: all that are on show.
        plot: Option<usize>,
        /// Whether a file that is there may be replaced.
        replace: bool,
    },
    /// Stop writing a figure.
    StopWriting,
    /// Read a file; it comes back as `Msg::Read`.
    Read { path: PathBuf, purpose: Purpose },
    /// Put the kept file of an interrupted session aside, so that it is not offered again.
    PutAside(PathBuf),
    /// Write the rows of a scan to a file, in the form that its name ends with; a file of another scan
    /// is left alone. The outcome comes back as a message line.
    SaveScan {
        path: std::path::PathBuf,
        scan: std::sync::Arc<crate::study::scan::Scan>,
        /// Its rows, from the first point on.
        rows: Vec<crate::study::scan::ScanRow>,
    },
}
