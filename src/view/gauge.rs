//! The gauge of a kick: a bar as long as the kick, with marks where the margin and the guaranteed margin are.

use ratatui::text::Span;

use super::{Look, margin};
use crate::numerics::{real, truncated};
use crate::picture::Role;
use crate::session::{Session, TriedKick};

/// Cells of the bar: as many as fit.
const CELLS: std::ops::RangeInclusive<usize> = 8..=24;

/// Digits of the numbers.
const DIGITS: usize = 4;

/// The gauge of the kick by which the motion on show starts, in at most so many columns; `None` where it starts by none, no
/// margin is known, or there is no room.
pub fn gauge(session: &Session, width: usize, look: &Look) -> Option<Vec<Span<'static>>> {
    let kick @ TriedKick { is_shift, size, border } = session.kick()?;
    let border = border?;
    let guaranteed = margin::guaranteed(session, is_shift);
    let told = |size: f64| margin::told(session, is_shift, [size, border], DIGITS);
    let name = if is_shift { " shift " } else { " kick " };
    let numbers = format!("  {} of {}", told(size), told(border));
    let more = guaranteed.map(|size| format!("{numbers}, {} guaranteed", told(size)));
    let mut texts = more.into_iter().chain([numbers]);
    let room = |text: &String| width.checked_sub(name.len() + text.chars().count());
    let (text, cells) = texts.find_map(|text| {
        let cells = room(&text).filter(|cells| cells >= CELLS.start())?;
        Some((text, cells.min(*CELLS.end())))
    })?;
    let bar = bar(kick, border, guaranteed, cells);
    let drawn = bar.chunk_by(|one, other| one == other).map(|run| {
        let (symbol, role) = run[0];
        look.span(look.symbols().gauge[symbol].to_string().repeat(run.len()), role)
    });
    let name = look.span(name, Role::Quiet);
    let text = look.span(text, Role::Text);
    Some(std::iter::once(name).chain(drawn).chain([text]).collect())
}

/// The symbols of the cells of a bar, by their places among those of the gauge, with their roles.
fn bar(kick: TriedKick, border: f64, guaranteed: Option<f64>, cells: usize) -> Vec<(usize, Role)> {
    /// The length of the bar, relative to the margin and to the kick.
    const ROOM: [f64; 2] = [1.25, 1.05];
    let whole = (ROOM[0] * border).max(ROOM[1] * kick.size);
    let place = |size: f64| truncated(real(cells) * size / whole).min(cells - 1);
    let mark = place(border).clamp(1, cells - 2);
    // The bar ends on the same side of the margin as the kick itself.
    let filled = 1 + place(kick.size);
    let filled = if kick.size < border {
        filled.min(mark)
    } else {
        filled.max(mark + 2)
    };
    let cell = |at: usize| match at {
        _ if at == mark => (3, Role::Unstable),
        _ if guaranteed.is_some_and(|size| at == place(size)) => (4, Role::Safe),
        _ if at + 1 == filled => (1, Role::Trajectory),
        _ if at < filled => (0, Role::Trajectory),
        _ => (2, Role::Axis),
    };
    (0..cells).map(cell).collect()
}
