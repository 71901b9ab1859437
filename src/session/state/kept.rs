//! Sessions that were interrupted and can be continued.

use std::path::PathBuf;

/// A session that was interrupted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Kept {
    pub path: PathBuf,
    /// How long ago it ended, in words.
    pub when: String,
    /// A summary of the session in one line.
    pub what: String,
}
