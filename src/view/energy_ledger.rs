//! The energy ledger: a bar for the work of each source, over one turn of each cycle and along the
//! motion. What feeds points to the right, what brakes to the left; the number stands on the other side.
//!
//! Bars are fractions of the largest work of their owner, numbers are energies in the units of the model. While
//! the motion is played, a mark on each of its bars shows what has been done so far.

use ratatui::layout::Rect;

use super::Surface;
use super::pane::{self, FramedPicture};
use super::plot::{Canvas, rows};
use crate::numerics::real;
use crate::picture::energy_ledger::reading;
use crate::picture::{Dash, Mark, Picture, Role, Tick, Ticks, cycle_mark, cycle_name, cycle_role};
use crate::scene::{Point, Span, View, Window};
use crate::session::ledger::{LedgerLine, Owner};
use crate::words::significant;

const DIGITS: usize = 4;

const ERROR_DIGITS: usize = 2;

/// Gives each line of the ledger in `area` one or two whole rows, and its source to the axis.
pub fn seat(area: Rect, picture: &mut Picture, lines: &[LedgerLine]) {
    let seats = Seats::of(area, lines, picture.window);
    picture.upward = Some(seats.marks());
    picture.window = seats.window;
}

/// Draws a ledger whose lines have their seats.
pub fn draw(mut framed: FramedPicture, lines: &[LedgerLine], screen: &mut Surface) {
    let seats = Seats::of(framed.area, lines, framed.picture.window);
    framed.picture.title = View::EnergyLedger.spec().title.into();
    let mut plot = Canvas::new(&framed, screen);
    plot.upright(0.0, Role::Axis, Dash::Solid);
    let symbols = screen.look.symbols();
    for y in seats.left_out {
        plot.write(y, &format!("{} more", symbols.more), Role::Quiet);
    }
    for (y, entry) in seats.seen {
        match entry {
            LedgerLine::Title(Owner::Motion(..)) => plot.write(y, &reading(entry), Role::Title),
            LedgerLine::Title(Owner::Cycle(cycle)) => {
                let (name, mark) = (cycle_name(cycle.stable), cycle_mark(cycle.stable));
                let short =
                    format!("{} q_max {}", symbols.mark(mark), significant(cycle.q_max, DIGITS));
                let texts = [format!("{short}, {name}"), short];
                let text = pane::fitting(texts, plot.inner.width.into());
                plot.write(y, &text, cycle_role(cycle.stable));
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
    if let Some(cursor) = framed.picture.cursor {
        plot.cross(cursor);
    }
    plot.finish(screen);
}

/// Where the lines of a ledger stand.
struct Seats<'a> {
    /// About the window that was asked for, with one or two whole rows of the screen for each line.
    window: Window,
    /// The lines that are seen, each with the height of the middle of its first row.
    seen: Vec<(f64, &'a LedgerLine)>,
    /// The heights of the rows, at the top and at the bottom, that say that lines are left out there.
    left_out: Vec<f64>,
}

impl<'a> Seats<'a> {
    fn of(area: Rect, lines: &'a [LedgerLine], window: Window) -> Self {
        let rows = f64::from(rows(area).max(1));
        let y = whole_lines(window.y, rows);
        let half = 0.5 * y.width() / rows;
        let seats = lines.iter().enumerate().map(|(line, entry)| (-real(line) - half, entry));
        let mut seen: Vec<(f64, &LedgerLine)> = seats.collect();
        let above = seen.first().filter(|(seat, _)| *seat > y.to()).map(|_| y.to() - half);
        let below = seen.last().filter(|(seat, _)| *seat < y.from()).map(|_| y.from() + half);
        let left_out: Vec<f64> = above.into_iter().chain(below).collect();
        let is_free = |seat: f64| left_out.iter().all(|row| (row - seat).abs() > half);
        seen.retain(|(seat, _)| y.contains(*seat) && is_free(*seat));
        Seats { window: Window { y, ..window }, seen, left_out }
    }

    /// The sources at the axis.
    fn marks(&self) -> Ticks {
        let mark = |(seat, entry): &(f64, &LedgerLine)| {
            let label = match entry {
                LedgerLine::Work { source, .. } => *source,
                LedgerLine::Residual(_) => "error",
                LedgerLine::Title(_) => return None,
            };
            Some(Tick { fraction: self.window.y.fraction(*seat), label: label.to_owned() })
        };
        Ticks { base: None, ticks: self.seen.iter().filter_map(mark).collect() }
    }
}

/// About the same top, and as many heights as leave each line one or two whole rows.
fn whole_lines(y: Span, rows: f64) -> Span {
    let pitch = (rows / y.width()).floor().clamp(1.0, 2.0);
    let top = (y.to() * pitch).round() / pitch;
    Span::new(top - rows / pitch, top).unwrap_or(y)
}
