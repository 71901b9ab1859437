//! What a list over the panes holds.

use ratatui::text::{Line, Span};

/// Rows of text below a list of scenes or claims.
pub(super) const TEXT: u16 = 8;

/// What is listed.
pub(super) struct Content {
    /// What is listed.
    pub title: &'static str,
    /// The rows.
    pub rows: Vec<Entry>,
    /// About the selected row, below the list.
    pub about: Vec<Line<'static>>,
    /// Rows for that.
    pub below: u16,
}

/// A line of a list.
pub(super) enum Entry {
    /// Groups the rows below it.
    Heading(&'static str),
    /// Can be selected.
    Row(Vec<Span<'static>>),
}
