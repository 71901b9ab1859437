//! The energy ledger: a bar for the work of each source, over one turn of each cycle and along the
//! motion. What feeds points to the right, what brakes to the left; the number stands on the other side.
//!
//! Bars are fractions of the largest work of their owner, numbers are energies in the units of the model. While
//! the motion is played, a mark on each of its bars shows what has been done so far.

use ratatui::layout::Rect;

use super::Screen;
use super::pane::{self, Heading};
use super::plot::{Canvas, rows};
use crate::numerics::count::real;
use crate::picture::energy_ledger::{middle, reading};
use crate::picture::{CycleStyle, Dash, Mark, Picture, Role, Tick, Ticks, cycle_style};
use crate::scene::{Point, Span, View, Window};
use crate::session::ledger::{LedgerLine, Owner};
use crate::words::significant;

const DIGITS: usize = 4;

const ERROR_DIGITS: usize = 2;

pub fn draw(
    area: Rect,
    mut picture: Picture,
    mut heading: Heading,
    lines: &[LedgerLine],
    screen: &mut Screen,
) {
    let (window, marks) = marks(area, lines, picture.window);
    picture.window = window;
    picture.title = View::EnergyLedger.spec().title.into();
    heading.reading = picture.cursor.map(|cursor| {
        let near = |(line, _): &(usize, &LedgerLine)| (middle(*line) - cursor.y).abs() <= 0.5;
        let found = lines.iter().enumerate().find(near);
        found.map_or_else(String::new, |(_, entry)| reading(entry))
    });
    let mut plot = Canvas::new(area, &picture, Some(marks), &heading, screen);
    plot.upright(0.0, Role::Axis, Dash::Solid);
    let symbols = screen.look.symbols();
    let half = half_a_row(area, window);
    for y in left_out(lines.len(), window, half) {
        plot.write(y, &format!("{} more", symbols.more), Role::Quiet);
    }
    let seen = |(line, _): &(usize, &LedgerLine)| is_seen(*line, window, half, lines.len());
    for (line, entry) in lines.iter().enumerate().filter(seen) {
        let y = seat(line, half);
        match entry {
            LedgerLine::Title(Owner::Motion(..)) => plot.write(y, &reading(entry), Role::Title),
            LedgerLine::Title(Owner::Cycle(cycle)) => {
                let CycleStyle { mark, role, name, .. } = cycle_style(cycle.stable);
                let short =
                    format!("{} q_max {}", symbols.mark(mark), significant(cycle.q_max, DIGITS));
                let texts = [format!("{short}, {name}"), short];
                plot.write(y, &pane::fitting(texts, plot.inner().width.into()), role);
            }
            LedgerLine::Work { work, part, so_far, .. } => {
                let role = if *work < 0.0 { Role::Loss } else { Role::Gain };
                plot.curve([0.0, *part].map(|x| Point { x, y }), role, Dash::Thick);
                if let Some(so_far) = so_far {
                    plot.mark(Point { x: *so_far, y }, symbols.mark(Mark::Head), Role::Cursor);
                }
                plot.beside_zero(y, *work, DIGITS, *work < 0.0);
            }
            LedgerLine::Residual(part) => {
                plot.beside_zero(y, *part, ERROR_DIGITS, true);
            }
        }
    }
    if let Some(cursor) = picture.cursor {
        plot.cross(cursor);
    }
    plot.finish(screen);
}

/// The lines that are seen in `area`, each in whole rows, and the sources at the axis.
pub fn marks(area: Rect, lines: &[LedgerLine], window: Window) -> (Window, Ticks) {
    let window = Window { y: whole_lines(window.y, rows(area)), ..window };
    let half = half_a_row(area, window);
    let mark = |(line, entry): (usize, &LedgerLine)| {
        let fraction = window.y.fraction(seat(line, half));
        let label = match entry {
            LedgerLine::Work { source, .. } => *source,
            LedgerLine::Residual(_) => "error",
            LedgerLine::Title(_) => return None,
        };
        let is_seen = is_seen(line, window, half, lines.len());
        is_seen.then(|| Tick { fraction, label: label.to_owned() })
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
