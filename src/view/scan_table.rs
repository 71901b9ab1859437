//! The rows of a scan as a table that scrolls with the row that is looked at.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::look::{Look, Role};
use super::number::significant;
use super::pane;
use crate::export::scan::rounded;
use crate::session::scan::Scanned;
use crate::study::measure::Value;

/// Columns of a number.
const WIDTH: usize = 13;

/// Draws the names and the rows around the one that is looked at. The column that is plotted comes
/// first of those that are measured, and the others follow as far as they fit.
pub fn draw(area: Rect, scanned: &Scanned, look: &Look, buffer: &mut Buffer) {
    let Rect { x, y, width, height } = area;
    let Some(room) = usize::from(height).checked_sub(1).filter(|room| *room > 0) else { return };
    let over = scanned.scan.over();
    let measured = scanned.scan.measured();
    let places = usize::from(width) / (WIDTH + 1);
    let shown = places.saturating_sub(over.len()).min(measured.len()).max(1);
    let columns: Vec<usize> =
        (0..shown).map(|offset| (scanned.column + offset) % measured.len()).collect();
    let cell = |text: &str| format!("{:>WIDTH$} ", pane::cut(text, WIDTH, look));
    let names = over.iter().map(|sweep| sweep.symbol.spec().name);
    let names = names.chain(columns.iter().map(|column| measured[*column]));
    let titles: String = names.map(cell).collect();
    buffer.set_stringn(x, y, titles, width.into(), look.style(Role::Title));
    let first = scanned.at.saturating_sub(room / 2);
    let first = first.min(scanned.rows.len().saturating_sub(room));
    for (line, (index, row)) in
        (y + 1..area.bottom()).zip(scanned.rows.iter().enumerate().skip(first))
    {
        let place = scanned.scan.place(index);
        let values = over.iter().zip(place);
        let values = values.map(|(sweep, which)| significant(sweep.value(which), 8));
        let nothing = Value::Nothing;
        let found =
            columns.iter().map(|column| rounded(*row.values.get(*column).unwrap_or(&nothing)));
        let mut text: String = values.chain(found).map(|text| cell(&text)).collect();
        if let Some(reason) = &row.reason {
            text += reason;
        }
        let role = match (index == scanned.at, &row.reason) {
            (true, _) => Role::Selected,
            (false, Some(_)) => Role::Warning,
            (false, None) => Role::Text,
        };
        buffer.set_stringn(x, line, text, width.into(), look.style(role));
    }
}
