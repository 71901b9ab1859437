//! What a list over the panes holds.

use ratatui::text::{Line, Span};

/// Rows of text below a list of scenes or claims.
pub(super) const TEXT: u16 = 8;

#[derive(Default)]
pub(super) struct ListContent {
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

impl ListContent {
    /// An empty list.
    pub fn new(title: &'static str) -> Self {
        ListContent { title, ..ListContent::default() }
    }

    /// Begins a group of rows, unless it has begun already.
    pub fn group(&mut self, heading: &'static str) {
        let last = self.rows.iter().rev().find_map(|row| match row {
            ListLine::Heading(heading) => Some(*heading),
            ListLine::Row(_) => None,
        });
        if last != Some(heading) {
            self.rows.push(ListLine::Heading(heading));
        }
    }

    pub fn row<const N: usize>(&mut self, cells: [Span<'static>; N]) {
        self.rows.push(ListLine::Row(cells.into()));
    }
}
