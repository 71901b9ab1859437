//! The rows of a scan as a table that scrolls with the row that is looked at.

use std::ops::Range;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

use super::{Look, pane};
use crate::picture::Role;
use crate::scan::measure::Value;
use crate::scan::sweep::Sweep;
use crate::session::scan::ScanOnShow;
use crate::words::measured::rounded;
use crate::words::significant;

const DIGITS: usize = 8;

/// Draws the names and the rows around the one that is looked at. The column that is plotted comes
/// first of those that are measured, and the others follow as far as they fit whole.
pub fn draw(area: Rect, scanned: &ScanOnShow, look: &Look, buffer: &mut Buffer) {
    let Some(room) = usize::from(area.height).checked_sub(1).filter(|room| *room > 0) else {
        return;
    };
    let first = pane::first_seen(scanned.at, scanned.rows.len(), room);
    let seen = first..scanned.rows.len().min(first + room);
    let columns = columns(scanned, seen.clone());
    let mut used = 0;
    let fits = |width: &usize| {
        used += width + 1;
        used < usize::from(area.width)
    };
    let widths: Vec<usize> = columns
        .iter()
        .map(|column| column.iter().map(|text| text.chars().count()).max().unwrap_or(0))
        .take_while(fits)
        .collect();
    // Columns that are left out have a mark in place of their names.
    let more = if widths.len() < columns.len() { look.symbols().more } else { "" };
    let line = |row: usize| {
        let cells = columns.iter().zip(&widths).map(|(column, width)| {
            let text = &column[row];
            format!("{text:>width$} ")
        });
        cells.collect::<Vec<_>>().concat()
    };
    let names = Line::styled(line(0) + more, look.style(Role::Title));
    pane::line(area, 0, names, look, buffer);
    for (row, index) in (1..).zip(seen) {
        let reason = &scanned.rows[index].reason;
        let role = match (index == scanned.at, reason) {
            (true, _) => Role::Selected,
            (false, Some(_)) => Role::Warning,
            (false, None) => Role::Text,
        };
        let text = line(usize::from(row)) + reason.as_deref().unwrap_or_default();
        pane::line(area, row, Line::styled(text, look.style(role)), look, buffer);
    }
}

/// The columns of these rows: each a name and its cells.
fn columns(scanned: &ScanOnShow, rows: Range<usize>) -> Vec<Vec<String>> {
    let (over, measured) = (scanned.scan.over(), scanned.scan.measured());
    let parameter = |(which, sweep): (usize, &Sweep)| {
        let value = |index: usize| sweep.value(scanned.scan.place(index)[which]);
        let cells = rows.clone().map(|index| significant(value(index), DIGITS));
        std::iter::once(sweep.symbol.spec().name.to_owned()).chain(cells).collect()
    };
    let found = |offset: usize| {
        let column = (scanned.column + offset) % measured.len();
        let value = |index: usize| scanned.rows[index].values.get(column);
        let cells = rows.clone().map(|index| rounded(*value(index).unwrap_or(&Value::Nothing)));
        std::iter::once(measured[column].to_owned()).chain(cells).collect()
    };
    over.iter().enumerate().map(parameter).chain((0..measured.len()).map(found)).collect()
}
