//! The number line of the selected row, below the rows of the parameter pane: the value between the ends of its range, with
//! the letters of the special points; and below it their names and values.

use ratatui::text::Line;

use super::Look;
use crate::numerics::real;
use crate::picture::Role;
use crate::session::Session;
use crate::words::{joined, significant, with_unit};

/// The line, and what stands on it.
pub fn lines(session: &Session, width: usize, look: &Look) -> Vec<Line<'static>> {
    let Some(line) = session.number_line() else { return Vec::new() };
    let [from, to] = line.range.ends().map(|end| format!(" {} ", significant(end, 3)));
    let length = width.saturating_sub(from.chars().count() + to.chars().count()).max(1);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a column")]
    let column = |value| (line.range.fraction(value) * real(length - 1)).round() as usize;
    let symbols = look.symbols();
    let mut cells = vec![look.span(symbols.axis[3].to_string(), Role::Axis); length];
    let mut names = Vec::new();
    for point in &line.special {
        let [name, letter] =
            [point.kind.name(point.cycle.as_ref()), point.kind.letter(point.cycle.as_ref())];
        for (cell, letter) in cells[column(point.value)..].iter_mut().zip(letter.chars()) {
            *cell = look.span(letter.to_string(), Role::Special);
        }
        let value = with_unit(point.value, 4, line.knob.spec().unit);
        names.push(format!("{letter} {name} {value}"));
    }
    cells[column(line.value)] = look.span(symbols.cross[0].to_string(), Role::Current);
    let [from, to] = [from, to].map(|end| vec![look.span(end, Role::Quiet)]);
    let names = (!names.is_empty()).then(|| format!(" {}", joined(names, "  ")));
    let names = names.map(|names| look.span(names, Role::Special).into());
    std::iter::once([from, cells, to].concat().into()).chain(names).collect()
}
