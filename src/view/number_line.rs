//! The number line of the selected row, below the rows of the parameter pane: the value between the ends of its range, and the
//! special points by their letters, with their values where there is room.

use ratatui::text::Line;

use super::Look;
use crate::numerics::real;
use crate::picture::Role;
use crate::session::Session;
use crate::words::{significant, with_unit};

/// The line; `None` if no number is selected.
pub fn line(session: &Session, width: usize, look: &Look) -> Option<Line<'static>> {
    let line = session.number_line()?;
    let [from, to] = line.range.ends().map(|end| format!(" {} ", significant(end, 3)));
    let length = width.saturating_sub(from.chars().count() + to.chars().count()).max(1);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a column")]
    let column = |value| (line.range.fraction(value) * real(length - 1)).round() as usize;
    let symbols = look.symbols();
    let mut cells = vec![look.span(symbols.axis[3].clone(), Role::Axis); length];
    let values = line.special.iter().map(|point| point.value).chain([line.value]);
    let taken: Vec<usize> = values.map(column).collect();
    for point in &line.special {
        let letter = point.kind.letter(point.cycle.as_ref());
        let told = format!("{letter} {}", with_unit(point.value, 4, line.knob.spec().unit));
        let place = column(point.value);
        let next = taken.iter().copied().filter(|other| *other > place).min().unwrap_or(length);
        let ends = |text: &str| place + text.chars().count();
        // A name is not cut: without room for it there is a tick.
        let text = match letter {
            _ if ends(&told) < next => &told,
            letter if ends(letter) <= next => letter,
            _ => &*symbols.axis[4],
        };
        for (cell, letter) in cells[place..].iter_mut().zip(text.chars()) {
            *cell = look.span(letter.to_string(), Role::Special);
        }
    }
    cells[column(line.value)] = look.span(symbols.cross[0].to_string(), Role::Current);
    let [from, to] = [from, to].map(|end| vec![look.span(end, Role::Axis)]);
    Some([from, cells, to].concat().into())
}
