//! What a list over the panes holds.

use ratatui::text::{Line, Span};

/// Rows of text below a list of scenes or claims.
pub(super) const TEXT: u16 = 8;

pub(super) struct Content {
    pub title: &'static str,
    pub rows: Vec<ListLine>,
    /// About the selected row, below the list.
    pub about: Vec<Line<'static>>,
    pub below: u16,
}

pub(super) enum ListLine {
    /// Groups the rows below it.
    Heading(&'static str),
    Row(Vec<Span<'static>>),
}
