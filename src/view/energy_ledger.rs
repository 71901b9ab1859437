//! The energy ledger: a bar for the work of each source, over one turn of each cycle and along the
//! motion. What feeds points to the right, what brakes to the left; the number stands on the other side.
//!
//! Bars are fractions of the largest work of their owner, numbers are energies in the units of the model. While
//! the motion is played, a mark on each of its bars shows what has been done so far.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::look::Look;
use super::paint::symbol;
use super::pane::Heading;
use super::plot::{Canvas, Names, rows};
use crate::numerics::count::real;
use crate::picture::energy_ledger::{AXIS, middle, reading};
use crate::picture::role::{CycleStyle, Dash, Role, cycle_style};
use crate::picture::ticks::{Tick, Ticks};
use crate::scene::{Point, Span, View, Window};
use crate::session::ledger::{LedgerLine, Owner};
use crate::session::{self, Pane, Session};
use crate::words::number::significant;

const DIGITS: usize = 4;

const ERROR_DIGITS: usize = 2;

pub fn draw(area: Rect, session: &Session, index: usize, look: &Look, buffer: &mut Buffer) {
    let session::Plot { window, cursor, .. } = session.plots[index];
    let lines = session.ledger();
    let (window, marks) = marks(area, session, window);
    let title = View::EnergyLedger.spec().title;
    let scales = Default::default();
    let names = Names { title, x: AXIS, y: "", scales, marks: Some(marks) };
    let mut heading = Heading::of(session, Pane::Plot(index));
    heading.reading = cursor.map(|cursor| {
        lines
            .iter()
            .enumerate()
            .find(|(line, _)| (middle(*line) - cursor.y).abs() <= 0.5)
            .map(|(_, entry)| reading(entry))
            .unwrap_or_default()
    });
    let mut plot = Canvas::new(area, window, names, &heading, look, buffer);
    plot.upright(0.0, Role::Axis, Dash::Solid);
    let symbols = look.symbols();
    let half = half_a_row(area, window);
    for y in left_out(lines.len(), window, half) {
        plot.write(y, &format!("{} more", symbols.more), Role::Quiet);
    }
    for (line, entry) in
        lines.iter().enumerate().filter(|(line, _)| is_seen(*line, window, half, lines.len()))
    {
        let y = seat(line, half);
        match entry {
            LedgerLine::Title(Owner::Motion(..)) => plot.write(y, &reading(entry), Role::Title),
            LedgerLine::Title(Owner::Cycle(cycle)) => {
                let CycleStyle { mark, role, name, .. } = cycle_style(cycle.stable);
                let short =
                    format!("{} q_max {}", symbol(mark, symbols), significant(cycle.q_max, DIGITS));
                let full = format!("{short}, {name}");
                let room = usize::from(plot.inner().width);
                let fits = full.chars().count() <= room;
                plot.write(y, if fits { &full } else { &short }, role);
            }
            LedgerLine::Work { work, part, so_far, .. } => {
                let role = if *work < 0.0 { Role::Loss } else { Role::Gain };
                plot.bar(Point { x: 0.0, y }, Point { x: *part, y }, role);
                if let Some(so_far) = so_far {
                    plot.mark(Point { x: *so_far, y }, symbols.head, Role::Cursor);
                }
                plot.beside_zero(y, *work, DIGITS, *work < 0.0);
            }
            LedgerLine::Residual(part) => {
                plot.beside_zero(y, *part, ERROR_DIGITS, true);
            }
        }
    }
    if let Some(cursor) = cursor {
        plot.cross(cursor);
    }
    plot.finish(buffer);
}

/// The lines that are seen in `area`, each in whole rows, and the sources at the axis.
pub fn marks(area: Rect, session: &Session, window: Window) -> (Window, Ticks) {
    let window = Window { y: whole_lines(window.y, rows(area)), ..window };
    let half = half_a_row(area, window);
    let lines = session.ledger();
    let mark = |(line, entry): (usize, &LedgerLine)| {
        let fraction = window.y.fraction(seat(line, half));
        let label = label(entry)?.to_owned();
        is_seen(line, window, half, lines.len()).then_some(Tick { fraction, label })
    };
    let ticks = lines.iter().enumerate().filter_map(mark).collect();
    (window, Ticks { base: None, ticks })
}

/// About the same top, and as many heights as leave each line one or two whole rows.
fn whole_lines(y: Span, rows: u16) -> Span {
    let rows = f64::from(rows.max(1));
    let pitch = (rows / y.width()).floor().clamp(1.0, 2.0);
    let top = (y.to() * pitch).round() / pitch;
    Span::new(top - rows / pitch, top).unwrap_or(y)
}

/// Half of the height of a row of `area`.
fn half_a_row(area: Rect, window: Window) -> f64 {
    0.5 * window.y.width() / f64::from(rows(area).max(1))
}

/// The height at which a line is drawn: the middle of its first row.
fn seat(line: usize, half: f64) -> f64 {
    -(real(line)) - half
}

/// Whether one of this many lines is seen: its first row is in the window, and does not say that others are not.
fn is_seen(line: usize, window: Window, half: f64, lines: usize) -> bool {
    let y = seat(line, half);
    let marks = left_out(lines, window, half);
    window.y.contains(y) && marks.iter().all(|row| (row - y).abs() > half)
}

/// The heights of the rows, at the top and at the bottom, that say that lines are left out there.
fn left_out(lines: usize, window: Window, half: f64) -> Vec<f64> {
    let Some(last) = lines.checked_sub(1) else { return Vec::new() };
    let above = seat(0, half) > window.y.to();
    let below = seat(last, half) < window.y.from();
    let rows = [(above, window.y.to() - half), (below, window.y.from() + half)];
    rows.into_iter().filter(|(is_there, _)| *is_there).map(|(_, row)| row).collect()
}

/// What stands at the axis.
fn label(entry: &LedgerLine) -> Option<&'static str> {
    match entry {
        LedgerLine::Work { source, .. } => Some(source),
        LedgerLine::Residual(_) => Some("error"),
        LedgerLine::Title(_) => None,
    }
}
